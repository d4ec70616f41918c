//! Immutable snapshots of a film, as published by a session.

use super::{Film, Pixel};
use rayon::prelude::*;

/// Location of a non-finite sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NonFinite {
    /// Column.
    pub x: u32,
    /// Row from the top.
    pub y: u32,
    /// Sample index within the pixel.
    pub sample: u64,
}

/// Cost and errors of rendering so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// Paths traced.
    pub paths: u64,
    /// Evaluations of the medium's coefficients (density look-ups).
    pub lookups: u64,
    /// Evaluations at collisions where the extinction exceeded the majorant, included in `lookups`.
    pub exceeded: u64,
    /// Non-finite samples, which were rejected.
    pub non_finite: u64,
    /// Locations of the first non-finite samples.
    pub located: Vec<NonFinite>,
}

impl Tally {
    const LOCATED: usize = 16;

    /// Counts a non-finite sample.
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

/// An immutable image of a film, published at the end of a pass.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// Generation of the submission that it belongs to.
    pub generation: u64,
    /// Width in pixels.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
    /// Mean linear sRGB, row by row from the top.
    pub mean: Vec<[f32; 3]>,
    /// Standard error of the mean; infinite below two samples.
    pub standard_error: Vec<[f32; 3]>,
    /// Further noise statistics per pixel; empty for a coarse preview.
    pub noise: Vec<Noise>,
    /// Samples per pixel; 0 for a coarse preview.
    pub spp: u64,
    /// Edge length in pixels of the blocks that share one sample, in a coarse preview.
    pub coarse: Option<u32>,
    /// Seconds of rendering, without pauses.
    pub seconds: f64,
    /// CPU seconds summed over all worker threads.
    pub cpu_seconds: f64,
    /// Paths, look-ups and non-finite samples.
    pub tally: Tally,
    /// Number of worker threads.
    pub threads: usize,
    /// Relative standard error of `cpu_seconds`, from its variation over passes; infinite before the second
    /// pass.
    pub cost_error: f64,
    /// Identifier of the image that the samples converge to; empty if not requested.
    pub target: String,
}

/// Noise statistics of a pixel besides its standard error. Variances are means over the three channels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Noise {
    /// Part of the variance of the mean that is perpendicular to grey.
    pub chroma_variance: f32,
    /// Third central moment of the mean's grey.
    pub third_moment: f32,
    /// Standard error of the variance of the mean.
    pub variance_error: f32,
    /// Number of samples.
    pub samples: u64,
    /// Look-ups of the medium for all samples.
    pub lookups: f32,
}

/// Images of a film in single precision.
#[derive(Clone, Debug, Default)]
pub struct Images {
    /// Mean linear sRGB.
    pub mean: Vec<[f32; 3]>,
    /// Standard error of the mean.
    pub standard_error: Vec<[f32; 3]>,
    /// Further noise statistics.
    pub noise: Vec<Noise>,
}

impl Snapshot {
    /// Root mean square of the standard error, relative to the mean of the image. Pixels without a finite
    /// value are excluded; infinite where the mean is zero, or no pixel has a value.
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

    /// Mean colour of the image.
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
    /// Converts a film, on the threads of the current pool.
    #[must_use]
    pub fn of(film: &Film) -> Self {
        let (mean, (standard_error, noise)) =
            film.pixels.par_iter().with_min_len(4096).map(|p| (shown(p), (error(p), noise(p)))).unzip();
        Self { mean, standard_error, noise }
    }
}

fn shown(p: &Pixel) -> [f32; 3] {
    // A pixel whose samples were all rejected has no value and becomes NaN.
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
