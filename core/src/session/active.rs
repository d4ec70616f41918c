//! State of one view while it renders: film, limits and next pass.

use super::pass::Work;
use super::stopping::{Ending, ErrorTarget, ending};
use super::{Probe, Role, Status};
use crate::film::{Film, Images, Snapshot, Tally};
use crate::scene::Limits;
use crate::transport::CancelToken;
use rayon::ThreadPool;
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::sync::atomic::AtomicU64;
use std::time::Instant;

/// Target duration of a pass; short, so that pausing and stepping respond quickly.
const PASS_SECONDS: f64 = 0.15;

/// A view that is being rendered.
pub(super) struct Active {
    pub generation: u64,
    pub current: Arc<AtomicU64>,
    pub probe: Probe,
    pub pool: Arc<ThreadPool>,
    pub film: Film,
    pub spp: u64,
    pub limits: Limits,
    pub role: Role,
    /// Fingerprint of the image that the view converges to.
    pub target: String,
    pub paused: bool,
    pub steps: u32,
    pub last_pass: u64,
    pub seconds: f64,
    pub cpu_seconds: f64,
    pub tally: Tally,
    /// Error at the planned points, recorded if there is a limit on the error.
    error: ErrorTarget,
    cost: CostScatter,
}

/// Scatter of the CPU seconds per sample between passes, as sums over passes.
#[derive(Clone, Copy, Debug, Default)]
struct CostScatter {
    passes: f64,
    samples: f64,
    seconds: f64,
    /// Σ seconds²/samples.
    squares: f64,
}

impl CostScatter {
    fn add(&mut self, samples: u64, seconds: f64) {
        let samples = samples as f64;
        self.passes += 1.0;
        self.samples += samples;
        self.seconds += seconds;
        self.squares += seconds * seconds / samples;
    }

    /// Relative standard error of the cost per sample; infinite before the second pass.
    fn relative_error(&self) -> f64 {
        if self.passes < 2.0 || self.seconds <= 0.0 {
            return f64::INFINITY;
        }
        let scatter = (self.squares - self.seconds * self.seconds / self.samples).max(0.0);
        (scatter / (self.passes - 1.0) / self.samples).sqrt() * self.samples / self.seconds
    }
}

impl Active {
    pub fn finished(&self) -> bool {
        self.ending().is_some()
    }

    /// Reason why the view has ended, if it has.
    pub fn ending(&self) -> Option<Ending> {
        ending(&self.limits, (self.spp, self.seconds, self.cpu_seconds), &self.error)
    }

    pub fn runnable(&self) -> bool {
        !self.finished() && (!self.paused || self.steps > 0)
    }

    pub fn status(&self) -> Status {
        if self.finished() {
            Status::Finished
        } else if self.paused && self.steps == 0 {
            Status::Paused
        } else {
            Status::Rendering
        }
    }

    pub fn work(&self) -> Work<'_> {
        Work { probe: &self.probe, cancel: CancelToken::new(&self.current, self.generation) }
    }

    /// Samples of the next pass: as many as fit its target duration, at most twice the previous pass, never
    /// beyond a limit.
    fn next_samples(&self) -> u64 {
        if self.paused || self.spp == 0 {
            return 1;
        }
        let left = |limit: Option<f32>, had: f64| {
            let per_sample = had / self.spp as f64;
            limit.map_or(f64::INFINITY, |limit| (f64::from(limit) - had) / per_sample)
        };
        let per_sample = self.seconds / self.spp as f64;
        let fitting = (PASS_SECONDS / per_sample)
            .min(left(self.limits.seconds, self.seconds))
            .min(left(self.limits.cpu_seconds, self.cpu_seconds))
            .clamp(1.0, 4096.0) as u64;
        let count = fitting.min(self.last_pass.saturating_mul(2)).max(1);
        let count = self.limits.spp.map_or(count, |spp| count.min(spp - self.spp));
        // With a limit on the error, the sample counts at which the error is evaluated must not depend on
        // time.
        let count = match self.limits.relative_error {
            Some(_) => count.min(ErrorTarget::until_point(self.spp)),
            None => count,
        };
        count.min(self.probe.until_raise(self.spp))
    }

    /// Raises the majorants if this is due; returns whether any was raised.
    pub fn raise_majorants(&mut self) -> bool {
        self.probe.raise_majorants(self.spp)
    }

    pub fn snapshot(&mut self) -> Snapshot {
        let images = self.pool.install(|| Images::of(&self.film));
        let snapshot = self.with_images(images, None);
        if self.limits.relative_error.is_some() {
            self.error.note(&snapshot);
        }
        snapshot
    }

    pub fn with_images(&self, images: Images, coarse: Option<u32>) -> Snapshot {
        Snapshot {
            generation: self.generation,
            width: self.probe.scene.width as usize,
            height: self.probe.scene.height as usize,
            mean: images.mean,
            standard_error: images.standard_error,
            noise: images.noise,
            spp: self.spp,
            coarse,
            seconds: self.seconds,
            cpu_seconds: self.cpu_seconds,
            tally: self.tally.clone(),
            threads: self.pool.current_num_threads(),
            cost_error: self.cost.relative_error(),
            target: self.target.clone(),
        }
    }

    /// Creates a view without samples and without a film.
    pub fn new(
        (generation, current): (u64, Arc<AtomicU64>),
        probe: Probe,
        pool: Arc<ThreadPool>,
        limits: Limits,
    ) -> Self {
        Self {
            generation,
            current,
            film: Film::new(0, 0),
            probe,
            pool,
            spp: 0,
            limits,
            role: Role::View,
            target: String::new(),
            paused: false,
            steps: 0,
            last_pass: 1,
            seconds: 0.0,
            cpu_seconds: 0.0,
            tally: Tally::default(),
            error: ErrorTarget::default(),
            cost: CostScatter::default(),
        }
    }

    /// Attaches the film, in the memory of an earlier film if possible.
    pub fn load(&mut self, film: Film) {
        self.film = film.reused(self.probe.scene.width as usize, self.probe.scene.height as usize);
    }

    /// Runs one pass of at most `most` samples. Returns false if it was cancelled, which leaves the view
    /// unusable.
    pub fn advance(&mut self, rows_per_task: NonZeroUsize, most: u64) -> bool {
        let count = self.next_samples().min(most).max(1);
        let began = Instant::now();
        let samples = self.spp..self.spp + count;
        // The film is moved into the pass; after cancellation only its memory can be reused.
        let mut film = std::mem::replace(&mut self.film, Film::new(0, 0));
        let cost = self.pool.install(|| self.work().add_samples(&mut film, &samples, rows_per_task));
        self.film = film;
        let Some(cost) = cost else { return false };
        self.spp += count;
        self.last_pass = count;
        self.steps = self.steps.saturating_sub(1);
        self.seconds += began.elapsed().as_secs_f64();
        self.cpu_seconds += cost.cpu_seconds;
        self.cost.add(count, cost.cpu_seconds);
        self.tally.merge(&cost.tally);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::CostScatter;

    #[test]
    fn the_cost_of_even_passes_is_known_and_that_of_uneven_ones_is_not() {
        let scatter = |passes: &[(u64, f64)]| {
            let mut cost = CostScatter::default();
            for (samples, seconds) in passes {
                cost.add(*samples, *seconds);
            }
            cost.relative_error()
        };
        assert!(scatter(&[(4, 1.0)]).is_infinite());
        assert!(scatter(&[(1, 0.5), (2, 1.0), (4, 2.0)]) < 1e-6);
        // Two passes of 1 and 3 seconds: mean 2 ± 1.
        assert!((scatter(&[(1, 1.0), (1, 3.0)]) - 0.5).abs() < 1e-12);
    }
}
