//! Cancellation that reaches into a path.
//!
//! In a dense medium of albedo 1 a single path may have millions of collisions; it asks now and then
//! whether anybody still waits for it.

use std::sync::atomic::{AtomicU64, Ordering};

/// Whether a piece of work is still wanted: it is while a shared counter still shows its generation.
#[derive(Clone, Copy, Debug)]
pub struct CancelToken<'a>(Option<(&'a AtomicU64, u64)>);

impl<'a> CancelToken<'a> {
    /// Work that nobody cancels.
    pub const NEVER: CancelToken<'static> = CancelToken(None);

    /// Work of one generation.
    #[must_use]
    pub fn new(current: &'a AtomicU64, generation: u64) -> Self {
        Self(Some((current, generation)))
    }

    /// Whether it is still wanted.
    #[must_use]
    pub fn is_active(&self) -> bool {
        self.0.is_none_or(|(current, generation)| current.load(Ordering::Relaxed) == generation)
    }
}
