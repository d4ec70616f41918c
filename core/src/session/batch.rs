//! A render to its end on the caller's thread, with a clock: what benchmarks run.

use super::Probe;
use super::pass::Work;
use crate::film::{Film, Tally};
use crate::transport::Wanted;
use cpu_time::ProcessTime;
use rayon::ThreadPool;
use std::num::NonZeroUsize;
use std::time::Instant;

/// When a batch ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Budget {
    /// After so many seconds of wall-clock time; the last pass is made to fit.
    Seconds(f64),
    /// After so many samples per pixel.
    Samples(u32),
}

/// A film with all that it has cost.
#[derive(Clone, Debug)]
pub struct Batch {
    /// The picture.
    pub film: Film,
    /// Samples per pixel.
    pub spp: u32,
    /// Seconds from the first path to the last.
    pub wall_seconds: f64,
    /// CPU seconds of the whole process meanwhile: tracing, film, threads that wait.
    pub cpu_seconds: f64,
    /// Paths and look-ups.
    pub tally: Tally,
}

/// Renders with what `probe` traces on the threads of `pool`.
#[must_use]
pub fn render(probe: &Probe, pool: &ThreadPool, budget: Budget) -> Batch {
    let mut film = Film::new(probe.scene.width as usize, probe.scene.height as usize);
    let mut tally = Tally::default();
    let work = Work { probe, wanted: Wanted::ALWAYS };
    let (mut spp, mut pass) = (0u32, 1u32);
    let (began, cpu) = (Instant::now(), ProcessTime::now());
    while pass > 0 {
        let samples = u64::from(spp)..u64::from(spp + pass);
        // Nobody cancels it.
        let cost = pool.install(|| work.add_samples(&mut film, &samples, NonZeroUsize::MIN));
        let cost = cost.unwrap_or_default();
        tally.merge(&cost.tally);
        spp += pass;
        pass = match budget {
            Budget::Samples(limit) => (limit - spp).min(2 * pass),
            Budget::Seconds(limit) => {
                let elapsed = began.elapsed().as_secs_f64();
                let fitting = (limit - elapsed) / elapsed * f64::from(spp);
                // Half of what fits, so that a wrong guess does not overrun, but no end of tiny passes.
                let share = if fitting > 8.0 { 0.5 * fitting } else { fitting };
                (share.max(0.0) as u32).min(4 * spp)
            }
        };
    }
    let (wall_seconds, cpu_seconds) = (began.elapsed().as_secs_f64(), cpu.elapsed().as_secs_f64());
    Batch { film, spp, wall_seconds, cpu_seconds, tally }
}
