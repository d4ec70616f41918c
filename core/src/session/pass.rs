//! One pass: every pixel of a film gets some more samples.

use crate::estimator::{Kernel, PathEstimate, PathIndex, Settings};
use crate::film::{Film, NonFinite, Pixel, Tally};
use crate::scene::Scene;
use crate::transport::Wanted;
use cpu_time::ThreadTime;
use rayon::prelude::*;
use std::ops::Range;

/// What a pass has cost.
#[derive(Default)]
pub(super) struct Cost {
    pub tally: Tally,
    pub cpu_seconds: f64,
}

impl Cost {
    fn merge(mut self, other: Self) -> Self {
        self.tally.merge(&other.tally);
        self.cpu_seconds += other.cpu_seconds;
        self
    }
}

/// Everything that the paths of one submission are traced with.
#[derive(Clone, Copy)]
pub(super) struct Work<'a> {
    pub scene: &'a Scene,
    pub kernel: Kernel,
    pub settings: &'a Settings,
    pub wanted: Wanted<'a>,
}

impl Work<'_> {
    pub fn path(&self, x: usize, y: usize, sample: u64) -> PathEstimate {
        // Film sizes fit 32 bits by validation.
        let at = PathIndex { x: x as u32, y: y as u32, sample };
        (self.kernel)(self.scene, self.settings, at, self.wanted)
    }

    /// Adds samples to every pixel of a film; `None` if it was cancelled, which leaves the film
    /// unusable. Rows are the unit of work, each owned by one thread at a time.
    pub fn add_samples(&self, film: &mut Film, samples: &Range<u64>) -> Option<Cost> {
        let rows = film.pixels.par_chunks_mut(film.width).enumerate().with_max_len(1);
        let costs: Option<Vec<Cost>> = rows
            .map(|(y, row)| {
                let clock = ThreadTime::now();
                let mut tally = Tally::default();
                for (x, pixel) in row.iter_mut().enumerate() {
                    self.add_to_pixel((x, y), pixel, samples, &mut tally);
                    // Asked after each pixel: the estimate of an unwanted path must not be kept.
                    if !self.wanted.yes() {
                        return None;
                    }
                }
                Some(Cost { tally, cpu_seconds: clock.elapsed().as_secs_f64() })
            })
            .collect();
        // Merged in the order of rows, so that the located samples do not depend on threads either.
        costs.map(|costs| costs.into_iter().fold(Cost::default(), Cost::merge))
    }

    fn add_to_pixel(
        &self,
        (x, y): (usize, usize),
        pixel: &mut Pixel,
        samples: &Range<u64>,
        tally: &mut Tally,
    ) {
        for sample in samples.clone() {
            let estimate = self.path(x, y, sample);
            tally.paths += 1;
            tally.lookups += estimate.lookups;
            if estimate.rgb.is_finite() {
                pixel.add(estimate.rgb.to_array());
            } else {
                tally.reject(NonFinite { x: x as u32, y: y as u32, sample });
            }
        }
    }
}
