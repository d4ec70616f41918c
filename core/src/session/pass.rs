//! A pass, which adds samples to every pixel of a film.

use super::Probe;
use crate::estimator::PathEstimate;
use crate::film::{Film, NonFinite, Pixel, Tally};
use crate::transport::CancelToken;
use cpu_time::ThreadTime;
use rayon::prelude::*;
use std::num::NonZeroUsize;
use std::ops::Range;

/// Cost of a pass.
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

/// Probe and cancellation token of one submission.
#[derive(Clone, Copy)]
pub(super) struct Work<'a> {
    pub probe: &'a Probe,
    pub cancel: CancelToken<'a>,
}

/// Samples of a row that are traced before they are added to the film.
const BUFFERED_SAMPLES: u64 = 16;

impl Work<'_> {
    pub fn path(&self, x: usize, y: usize, sample: u64) -> PathEstimate {
        // Film sizes fit 32 bits by validation.
        self.probe.path(x as u32, y as u32, sample, self.cancel)
    }

    /// Adds samples to every pixel of a film. Returns `None` if it was cancelled, which leaves the film
    /// unusable.
    ///
    /// A task is a band of `rows_per_task` rows and is processed by one thread; the film does not depend on
    /// the size of the band. Only path tracing is charged; film statistics are not.
    pub fn add_samples(
        &self,
        film: &mut Film,
        samples: &Range<u64>,
        rows_per_task: NonZeroUsize,
    ) -> Option<Cost> {
        let (width, rows) = (film.width, rows_per_task.get());
        if film.pixels.is_empty() {
            return Some(Cost::default());
        }
        let bands = film.pixels.par_chunks_mut(width * rows).enumerate().with_max_len(1);
        let costs: Option<Vec<Cost>> = bands
            .map_init(Vec::new, |traced, (band, pixels)| {
                let mut cost = Cost::default();
                for (i, row) in pixels.chunks_mut(width).enumerate() {
                    self.add_to_row(band * rows + i, row, samples, traced, &mut cost)?;
                }
                Some(cost)
            })
            .collect();
        // Merged from the top, so that the located samples do not depend on the number of threads.
        costs.map(|costs| costs.into_iter().fold(Cost::default(), Cost::merge))
    }

    fn add_to_row(
        &self,
        y: usize,
        row: &mut [Pixel],
        samples: &Range<u64>,
        traced: &mut Vec<PathEstimate>,
        cost: &mut Cost,
    ) -> Option<()> {
        let mut first = samples.start;
        if first == 0 {
            // The memory may hold the pixels of another film.
            row.fill(Pixel::default());
        }
        while first < samples.end {
            let some = first..samples.end.min(first + BUFFERED_SAMPLES);
            let clock = ThreadTime::now();
            traced.clear();
            for x in 0..row.len() {
                traced.extend(some.clone().map(|sample| self.path(x, y, sample)));
                // Checked after each pixel: the estimate of a cancelled path must not be kept.
                if !self.cancel.is_active() {
                    return None;
                }
            }
            cost.cpu_seconds += clock.elapsed().as_secs_f64();
            let each = (some.end - some.start) as usize;
            for (x, (pixel, estimates)) in row.iter_mut().zip(traced.chunks(each)).enumerate() {
                for (sample, estimate) in some.clone().zip(estimates) {
                    cost.tally.paths += 1;
                    cost.tally.lookups += estimate.lookups;
                    cost.tally.exceeded += estimate.exceeded;
                    pixel.lookups += estimate.lookups;
                    if estimate.rgb.is_finite() {
                        pixel.add(estimate.rgb.to_array());
                    } else {
                        cost.tally.reject(NonFinite { x: x as u32, y: y as u32, sample });
                    }
                }
            }
            first = some.end;
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimator::{self, Kernel, PathIndex, Settings};
    use crate::io::Library;
    use crate::scene::{Scene, SceneDoc, build};
    use crate::transport::PathContext;
    use glam::Vec3;
    use std::sync::Arc;

    const SAMPLES: u64 = 6;

    /// Every third path of a row has no finite value.
    fn now_and_then_nan(_: &Scene, _: &Settings, at: PathIndex, _: PathContext<'_>) -> PathEstimate {
        let value = if (at.x + at.y).is_multiple_of(3) { f32::NAN } else { at.sample as f32 };
        PathEstimate { rgb: Vec3::splat(value), lookups: u64::from(at.x), exceeded: 0 }
    }

    /// A film of 11 rows after passes that end at these samples, with its tally.
    fn film(kernel: Kernel, ends: &[u64], rows_per_task: usize) -> (Vec<Pixel>, Tally) {
        let mut doc = SceneDoc::default();
        (doc.film.width, doc.film.height) = (7, 11);
        let scene = build(&doc, &mut Library::default()).unwrap();
        let settings = Settings::new(&doc.estimator, 3);
        let probe = Probe::new(Arc::new(scene), kernel, settings);
        let work = Work { probe: &probe, cancel: CancelToken::NEVER };
        let mut film = Film::new(7, 11);
        let mut tally = Tally::default();
        let mut first = 0;
        for end in ends {
            let rows = NonZeroUsize::new(rows_per_task).unwrap();
            tally.merge(&work.add_samples(&mut film, &(first..*end), rows).unwrap().tally);
            first = *end;
        }
        (film.pixels, tally)
    }

    fn kernels() -> [Kernel; 2] {
        [estimator::find("uni-nee-mis").unwrap().kernel, now_and_then_nan]
    }

    #[test]
    fn a_film_does_not_depend_on_the_size_of_tasks() {
        for kernel in kernels() {
            let by_row = film(kernel, &[SAMPLES], 1);
            assert_eq!(by_row.1.paths, 7 * 11 * SAMPLES);
            for rows in [2, 5, 11, 1000] {
                assert_eq!(film(kernel, &[SAMPLES], rows), by_row, "{rows} rows a task");
            }
        }
    }

    /// Every way to split the samples into passes; only the choice of located samples may differ.
    #[test]
    fn a_film_does_not_depend_on_how_its_samples_are_split() {
        for kernel in kernels() {
            let whole = film(kernel, &[SAMPLES], 1);
            for cuts in 0..1u32 << (SAMPLES - 1) {
                let ends: Vec<u64> =
                    (1..=SAMPLES).filter(|s| *s == SAMPLES || cuts >> (s - 1) & 1 == 1).collect();
                let (pixels, tally) = film(kernel, &ends, 3);
                assert_eq!(pixels, whole.0, "passes that end at {ends:?}");
                let counts = |t: &Tally| (t.paths, t.lookups, t.non_finite, t.located.len());
                assert_eq!(counts(&tally), counts(&whole.1), "passes that end at {ends:?}");
            }
        }
    }
}
