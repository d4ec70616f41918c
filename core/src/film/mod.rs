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
        Self { width, height, pixels: vec![Pixel::default(); width * height] }
    }

    /// An empty film, in the memory of this one if that has the size: memory that is new to the process costs several
    /// times what clearing it does.
    #[must_use]
    pub fn renewed(mut self, width: usize, height: usize) -> Self {
        if (self.width, self.height) != (width, height) {
            return Self::new(width, height);
        }
        self.pixels.fill(Pixel::default());
        self
    }
}
