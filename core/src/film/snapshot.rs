//! What a session publishes: an immutable picture with its numbers.

use super::Film;

/// Where a non-finite sample arose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NonFinite {
    /// Column.
    pub x: u32,
    /// Row from the top.
    pub y: u32,
    /// Sample index within the pixel.
    pub sample: u64,
}

/// What rendering has cost so far, and what went wrong in it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// Paths traced.
    pub paths: u64,
    /// Evaluations of the medium's coefficients (density look-ups).
    pub lookups: u64,
    /// Samples that were not finite and were left out.
    pub non_finite: u64,
    /// The first few of them.
    pub located: Vec<NonFinite>,
}

impl Tally {
    const LOCATED: usize = 16;

    /// Counts a sample that was not finite.
    pub fn reject(&mut self, at: NonFinite) {
        self.non_finite += 1;
        if self.located.len() < Self::LOCATED {
            self.located.push(at);
        }
    }

    /// Adds another tally to this one.
    pub fn merge(&mut self, other: &Self) {
        self.paths += other.paths;
        self.lookups += other.lookups;
        self.non_finite += other.non_finite;
        let room = Self::LOCATED.saturating_sub(self.located.len());
        self.located.extend(other.located.iter().take(room));
    }
}

/// An immutable picture of a film, published at the end of a pass.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// Which submission it belongs to.
    pub generation: u64,
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Mean linear sRGB, row by row from the top.
    pub mean: Vec<[f32; 3]>,
    /// Standard error of the mean; infinite below two samples.
    pub standard_error: Vec<[f32; 3]>,
    /// Samples per pixel in it; 0 for a coarse preview.
    pub spp: u32,
    /// In a coarse preview, the edge in pixels of the blocks that share one sample.
    pub coarse: Option<u32>,
    /// Seconds of rendering, pauses left out.
    pub seconds: f64,
    /// CPU seconds of all workers.
    pub cpu_seconds: f64,
    /// Paths, look-ups, non-finite samples.
    pub tally: Tally,
    /// Worker threads.
    pub threads: usize,
}

impl Snapshot {
    /// Mean colour and standard error of every pixel of a film, at single precision.
    #[must_use]
    pub fn images(film: &Film) -> (Vec<[f32; 3]>, Vec<[f32; 3]>) {
        film.pixels
            .iter()
            .map(|p| {
                // A pixel all of whose samples were rejected has no value; it shows as one.
                let mean = if p.count == 0 { [f32::NAN; 3] } else { p.mean.map(|x| x as f32) };
                (mean, p.variance_of_mean().map(|v| v.sqrt() as f32))
            })
            .unzip()
    }

    /// The image's mean colour.
    #[must_use]
    pub fn mean_colour(&self) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for pixel in &self.mean {
            for (s, x) in sum.iter_mut().zip(pixel) {
                *s += f64::from(*x);
            }
        }
        sum.map(|s| s / self.mean.len().max(1) as f64)
    }
}
