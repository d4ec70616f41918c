//! One view while it renders: its film, its limits, its next pass.

use super::Status;
use super::pass::Work;
use crate::estimator::{Kernel, Settings};
use crate::film::{Film, Snapshot, Tally};
use crate::scene::{RenderDoc, Scene};
use crate::transport::Wanted;
use rayon::ThreadPool;
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::sync::atomic::AtomicU64;
use std::time::Instant;

/// A pass lasts about this long, so that pausing and stepping answer soon.
const PASS_SECONDS: f64 = 0.15;

/// A view that renders.
pub(super) struct Active {
    pub generation: u64,
    pub current: Arc<AtomicU64>,
    pub scene: Arc<Scene>,
    pub kernel: Kernel,
    pub settings: Settings,
    pub pool: Arc<ThreadPool>,
    pub film: Film,
    pub spp: u32,
    pub limits: (Option<u32>, Option<f32>),
    pub paused: bool,
    pub steps: u32,
    pub last_pass: u32,
    pub seconds: f64,
    pub cpu_seconds: f64,
    /// CPU seconds by which views take turns; starts level with those that run already.
    pub turn: f64,
    pub tally: Tally,
}

impl Active {
    pub fn finished(&self) -> bool {
        self.limits.0.is_some_and(|spp| self.spp >= spp)
            || self.limits.1.is_some_and(|seconds| self.seconds >= f64::from(seconds))
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
        Work {
            scene: &self.scene,
            kernel: self.kernel,
            settings: &self.settings,
            wanted: Wanted::new(&self.current, self.generation),
        }
    }

    /// Samples of the next pass: as many as fit its time, at most twice the last, never past a limit.
    fn next_samples(&self) -> u32 {
        if self.paused || self.spp == 0 {
            return 1;
        }
        let per_sample = self.seconds / f64::from(self.spp);
        let left = self.limits.1.map_or(f64::INFINITY, |s| f64::from(s) - self.seconds);
        let fitting = (PASS_SECONDS.min(left) / per_sample).clamp(1.0, 4096.0) as u32;
        let count = fitting.min(self.last_pass * 2).max(1);
        self.limits.0.map_or(count, |spp| count.min(spp - self.spp))
    }

    pub fn snapshot(&self) -> Snapshot {
        let (mean, standard_error) = self.pool.install(|| Snapshot::images(&self.film));
        self.with_images(mean, standard_error, None)
    }

    pub fn with_images(
        &self,
        mean: Vec<[f32; 3]>,
        standard_error: Vec<[f32; 3]>,
        coarse: Option<u32>,
    ) -> Snapshot {
        Snapshot {
            generation: self.generation,
            width: self.film.width,
            height: self.film.height,
            mean,
            standard_error,
            spp: self.spp,
            coarse,
            seconds: self.seconds,
            cpu_seconds: self.cpu_seconds,
            tally: self.tally.clone(),
            threads: self.pool.current_num_threads(),
        }
    }

    /// A view that has not rendered yet.
    pub fn new(
        (generation, current): (u64, Arc<AtomicU64>),
        scene: Arc<Scene>,
        (kernel, settings): (Kernel, Settings),
        pool: Arc<ThreadPool>,
        limits: &RenderDoc,
    ) -> Self {
        Self {
            generation,
            current,
            kernel,
            settings,
            pool,
            film: Film::new(scene.width as usize, scene.height as usize),
            scene,
            spp: 0,
            limits: (limits.spp, limits.seconds),
            paused: false,
            steps: 0,
            last_pass: 1,
            seconds: 0.0,
            cpu_seconds: 0.0,
            turn: 0.0,
            tally: Tally::default(),
        }
    }

    /// Runs one pass; false if it was cancelled, which leaves the view unusable.
    pub fn advance(&mut self, rows_per_task: NonZeroUsize) -> bool {
        let count = self.next_samples();
        let began = Instant::now();
        let first = u64::from(self.spp);
        let samples = first..first + u64::from(count);
        // The film is lent to the pass; a cancelled one is not worth having back.
        let mut film = std::mem::replace(&mut self.film, Film::new(0, 0));
        let cost = self.pool.install(|| self.work().add_samples(&mut film, &samples, rows_per_task));
        self.film = film;
        let Some(cost) = cost else { return false };
        self.spp += count;
        self.last_pass = count;
        self.steps = self.steps.saturating_sub(1);
        self.seconds += began.elapsed().as_secs_f64();
        self.cpu_seconds += cost.cpu_seconds;
        self.turn += cost.cpu_seconds;
        self.tally.merge(&cost.tally);
        true
    }
}
