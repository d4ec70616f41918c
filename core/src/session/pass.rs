//! One pass: every pixel of a film gets some more samples.

use crate::estimator::{Kernel, PathEstimate, PathIndex, Settings};
use crate::film::{Film, NonFinite, Pixel, Tally};
use crate::scene::Scene;
use crate::transport::Wanted;
use cpu_time::ThreadTime;
use rayon::prelude::*;
use std::num::NonZeroUsize;
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
    /// unusable. A task is a band of so many rows, owned by one thread at a time; the film does not
    /// depend on how many.
    pub fn add_samples(
        &self,
        film: &mut Film,
        samples: &Range<u64>,
        rows_per_task: NonZeroUsize,
    ) -> Option<Cost> {
        let (width, rows) = (film.width, rows_per_task.get());
        let bands = film.pixels.par_chunks_mut(width * rows).enumerate().with_max_len(1);
        let costs: Option<Vec<Cost>> = bands
            .map(|(band, pixels)| {
                let clock = ThreadTime::now();
                let mut tally = Tally::default();
                for (i, pixel) in pixels.iter_mut().enumerate() {
                    self.add_to_pixel((i % width, band * rows + i / width), pixel, samples, &mut tally);
                    // Asked after each pixel: the estimate of an unwanted path must not be kept.
                    if !self.wanted.yes() {
                        return None;
                    }
                }
                Some(Cost { tally, cpu_seconds: clock.elapsed().as_secs_f64() })
            })
            .collect();
        // Merged from the top, so that the located samples do not depend on threads either.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimator;
    use crate::io::Library;
    use crate::scene::{SceneDoc, build};
    use glam::Vec3;

    const SAMPLES: u64 = 6;

    /// Every third path of a row has no value.
    fn now_and_then_nan(_: &Scene, _: &Settings, at: PathIndex, _: Wanted<'_>) -> PathEstimate {
        let value = if (at.x + at.y).is_multiple_of(3) { f32::NAN } else { at.sample as f32 };
        PathEstimate { rgb: Vec3::splat(value), lookups: u64::from(at.x) }
    }

    /// A film of 11 rows after passes that end at these samples, with what it has cost.
    fn film(kernel: Kernel, ends: &[u64], rows_per_task: usize) -> (Vec<Pixel>, Tally) {
        let mut doc = SceneDoc::default();
        (doc.film.width, doc.film.height) = (7, 11);
        let scene = build(&doc, &mut Library::default()).unwrap();
        let settings = Settings::new(&doc.estimator, 3);
        let work = Work { scene: &scene, kernel, settings: &settings, wanted: Wanted::ALWAYS };
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
