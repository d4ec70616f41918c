//! What a session publishes: an immutable picture with its numbers.

use super::{Film, Pixel};
use rayon::prelude::*;

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
    /// Of those, at collisions where the extinction exceeded the majorant.
    pub exceeded: u64,
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
        self.exceeded += other.exceeded;
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
    /// What else is known about every pixel's noise; empty for a coarse preview.
    pub noise: Vec<Noise>,
    /// Samples per pixel in it; 0 for a coarse preview.
    pub spp: u64,
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
    /// Relative standard error of `cpu_seconds`, from its scatter over passes; infinite before the second.
    pub cost_error: f64,
    /// Names the image that the samples converge to; empty if nobody asked for it.
    pub target: String,
}

/// A pixel's noise beyond its standard error. Variances are means over the three channels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Noise {
    /// The part of the variance of the mean that is perpendicular to grey.
    pub chroma_variance: f32,
    /// Third central moment of the mean's grey.
    pub third_moment: f32,
    /// Standard error of the variance of the mean.
    pub variance_error: f32,
    /// Samples in the mean.
    pub samples: u64,
    /// Look-ups of the medium for all of them.
    pub lookups: f32,
}

/// What a film shows, at single precision.
#[derive(Clone, Debug, Default)]
pub struct Images {
    /// Mean linear sRGB.
    pub mean: Vec<[f32; 3]>,
    /// Its standard error.
    pub standard_error: Vec<[f32; 3]>,
    /// What else is known about its noise.
    pub noise: Vec<Noise>,
}

impl Snapshot {
    /// Root mean square of the standard error over the size of the image's mean: how noisy the whole is. Pixels without a
    /// finite value are left out; infinite where the mean is zero, or no pixel has a value.
    #[must_use]
    pub fn relative_error(&self) -> f64 {
        let (mut variance, mut mean, mut known) = (0.0, 0.0, 0u64);
        for (m, e) in self.mean.iter().flatten().zip(self.standard_error.iter().flatten()) {
            if m.is_finite() && e.is_finite() {
                (variance, mean, known) = (variance + f64::from(*e).powi(2), mean + f64::from(*m), known + 1);
            }
        }
        if mean == 0.0 { f64::INFINITY } else { (variance * known as f64).sqrt() / mean.abs() }
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

impl Images {
    /// Reads a film, on the threads of the pool that it is called in.
    #[must_use]
    pub fn of(film: &Film) -> Self {
        let (mean, (standard_error, noise)) =
            film.pixels.par_iter().with_min_len(4096).map(|p| (shown(p), (error(p), noise(p)))).unzip();
        Self { mean, standard_error, noise }
    }
}

fn shown(p: &Pixel) -> [f32; 3] {
    // A pixel all of whose samples were rejected has no value; it shows as one.
    if p.count == 0 { [f32::NAN; 3] } else { p.mean.map(|x| x as f32) }
}

fn error(p: &Pixel) -> [f32; 3] {
    p.variance_of_mean().map(|v| v.sqrt() as f32)
}

fn noise(p: &Pixel) -> Noise {
    Noise {
        chroma_variance: p.chroma_variance_of_mean() as f32,
        third_moment: p.third_moment_of_mean() as f32,
        variance_error: p.variance_of_variance().sqrt() as f32,
        samples: p.count,
        lookups: p.lookups as f32,
    }
}
