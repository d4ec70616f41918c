//! The film: running mean and variance of every pixel, and immutable snapshots of it.
//!
//! A pixel's samples are added in sample order by whoever owns its row, so the film after N samples
//! per pixel does not depend on threads, passes or pauses. Non-finite samples are counted and
//! located, never added and never hidden.

pub mod display;
mod pixel;
mod snapshot;

pub use pixel::Pixel;
pub use snapshot::{Images, Noise, NonFinite, Snapshot, Tally};

/// Accumulated pixels, row by row from the top.
#[derive(Clone, Debug)]
pub struct Film {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// `width · height` accumulators.
    pub pixels: Vec<Pixel>,
}

impl Film {
    /// An empty film.
    #[must_use]
    pub fn new(width: usize, height: usize) -> Self {
        // All zeros, which the system clears page by page when they are first touched.
        Self { width, height, pixels: bytemuck::zeroed_vec(width * height) }
    }

    /// A film in the memory of this one, if that has the size: memory that is new to the process costs more than clearing
    /// it does, and for a large film neither should happen in one go. Whoever adds sample 0 begins its rows anew.
    #[must_use]
    pub fn reused(self, width: usize, height: usize) -> Self {
        if (self.width, self.height) == (width, height) { self } else { Self::new(width, height) }
    }
}
