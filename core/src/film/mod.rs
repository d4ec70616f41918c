//! Film: running mean and variance of every pixel, and immutable snapshots.
//!
//! A pixel's samples are added in sample order by the worker thread that owns its row, so the film after N
//! samples per pixel does not depend on the number of threads, passes or pauses. Non-finite samples are
//! counted and located, but not added.

pub mod display;
mod pixel;
mod snapshot;

pub use pixel::Pixel;
pub use snapshot::{Images, Noise, NonFinite, Snapshot, Tally};

/// Accumulated pixels, row by row from the top.
#[derive(Clone, Debug)]
pub struct Film {
    /// Width in pixels.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
    /// `width · height` accumulators.
    pub pixels: Vec<Pixel>,
}

impl Film {
    /// Creates an empty film.
    #[must_use]
    pub fn new(width: usize, height: usize) -> Self {
        // Zeroed memory, which the operating system clears page by page on first access.
        Self { width, height, pixels: bytemuck::zeroed_vec(width * height) }
    }

    /// Reuses the memory of this film if the size matches: new memory costs the process more than clearing
    /// it, and for a large film neither should happen all at once. The pixels are not cleared; the thread
    /// that adds sample 0 resets them row by row.
    #[must_use]
    pub fn reused(self, width: usize, height: usize) -> Self {
        if (self.width, self.height) == (width, height) { self } else { Self::new(width, height) }
    }
}
