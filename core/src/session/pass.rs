//! One pass: every pixel of a film gets some more samples.

use crate::estimator::{Kernel, Settings};
use crate::film::{Film, NonFinite, Pixel, Tally};
use crate::scene::Scene;
use cpu_time::ThreadTime;
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};

/// Whether the submission that work belongs to is still the newest.
pub(super) struct StillWanted<'a> {
    pub current: &'a AtomicU64,
    pub generation: u64,
}

impl StillWanted<'_> {
    pub fn yes(&self) -> bool {
        self.current.load(Ordering::Acquire) == self.generation
    }
}

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

/// Adds samples `first..first + count` to every pixel; `None` if it was cancelled, which leaves the
/// film unusable. Rows are the unit of work, each owned by one thread at a time.
pub(super) fn run(
    scene: &Scene,
    kernel: Kernel,
    settings: &Settings,
    film: &mut Film,
    samples: std::ops::Range<u64>,
    wanted: &StillWanted,
) -> Option<Cost> {
    let rows = film.pixels.par_chunks_mut(film.width).enumerate().with_max_len(1);
    let costs: Option<Vec<Cost>> = rows
        .map(|(y, row)| {
            let clock = ThreadTime::now();
            let mut cost = Cost::default();
            for (x, pixel) in row.iter_mut().enumerate() {
                if x % 64 == 0 && !wanted.yes() {
                    return None;
                }
                add_samples(scene, kernel, settings, (x, y), pixel, samples.clone(), &mut cost.tally);
            }
            cost.cpu_seconds = clock.elapsed().as_secs_f64();
            Some(cost)
        })
        .collect();
    // Merged in the order of rows, so that the located samples do not depend on threads either.
    costs.map(|costs| costs.into_iter().fold(Cost::default(), Cost::merge))
}

fn add_samples(
    scene: &Scene,
    kernel: Kernel,
    settings: &Settings,
    (x, y): (usize, usize),
    pixel: &mut Pixel,
    samples: std::ops::Range<u64>,
    tally: &mut Tally,
) {
    let (x, y) = (x as u32, y as u32);
    for sample in samples {
        let estimate = kernel(scene, settings, x, y, sample);
        tally.paths += 1;
        tally.lookups += u64::from(estimate.lookups);
        if estimate.rgb.is_finite() {
            pixel.add(estimate.rgb.to_array());
        } else {
            tally.reject(NonFinite { x, y, sample });
        }
    }
}
