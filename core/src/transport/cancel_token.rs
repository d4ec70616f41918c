//! Cancellation of a path while it is traced.
//!
//! In a dense medium of albedo 1 a single path may have millions of collisions, so the path itself checks
//! periodically whether it has been cancelled.

use std::sync::atomic::{AtomicU64, Ordering};

/// Cancellation token of a work item, which is active while a shared counter equals its generation.
#[derive(Clone, Copy, Debug)]
pub struct CancelToken<'a>(Option<(&'a AtomicU64, u64)>);

impl<'a> CancelToken<'a> {
    /// Token that is never cancelled.
    pub const NEVER: CancelToken<'static> = CancelToken(None);

    /// Creates the token of one generation.
    #[must_use]
    pub fn new(current: &'a AtomicU64, generation: u64) -> Self {
        Self(Some((current, generation)))
    }

    /// Whether the generation is still current.
    #[must_use]
    pub fn is_active(&self) -> bool {
        self.0.is_none_or(|(current, generation)| current.load(Ordering::Relaxed) == generation)
    }
}
