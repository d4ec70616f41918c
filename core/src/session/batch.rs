//! Synchronous rendering on the thread of the caller, with timing; used by benchmarks.

use super::Probe;
use super::pass::Work;
use crate::film::{Film, Tally};
use crate::transport::CancelToken;
use cpu_time::ProcessTime;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::num::NonZeroUsize;
use std::time::Instant;

/// End condition of a batch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Budget {
    /// Wall-clock seconds; the last pass is shortened to fit. Every pixel gets at least one sample.
    Seconds(f64),
    /// Samples per pixel; may be 0.
    Samples(u64),
}

/// A film with the cost of rendering it.
#[derive(Clone, Debug)]
pub struct Batch {
    /// The rendered film.
    pub film: Film,
    /// Samples per pixel.
    pub spp: u64,
    /// Seconds from the first path to the last.
    pub wall_seconds: f64,
    /// CPU seconds of the whole process in this time: tracing, film and waiting threads.
    pub cpu_seconds: f64,
    /// Paths and look-ups.
    pub tally: Tally,
    /// Probe that replays the paths, including majorants that were raised on the way.
    pub probe: Probe,
}

/// Renders with `probe` on the threads of `pool`, as a session would.
#[must_use]
pub fn render(probe: &Probe, pool: &ThreadPool, budget: Budget) -> Batch {
    let mut probe = probe.afresh();
    let mut film = Film::new(probe.scene.width as usize, probe.scene.height as usize);
    let mut tally = Tally::default();
    let (mut spp, mut pass) = (0u64, 1u64);
    if let Budget::Samples(limit) = budget {
        pass = pass.min(limit);
    }
    let (began, cpu) = (Instant::now(), ProcessTime::now());
    while pass > 0 {
        pass = pass.min(probe.until_raise(spp));
        let work = Work { probe: &probe, cancel: CancelToken::NEVER };
        // `CancelToken::NEVER` is never cancelled.
        let cost = pool.install(|| work.add_samples(&mut film, &(spp..spp + pass), NonZeroUsize::MIN));
        let cost = cost.unwrap_or_default();
        tally.merge(&cost.tally);
        spp += pass;
        probe.raise_majorants(spp);
        pass = match budget {
            Budget::Samples(limit) => limit.saturating_sub(spp).min(2 * pass),
            Budget::Seconds(limit) => {
                let elapsed = began.elapsed().as_secs_f64();
                let fitting = (limit - elapsed) / elapsed * spp as f64;
                // Half of the samples that fit, so that a wrong estimate does not overrun; all of them when
                // few are left, to avoid many tiny passes.
                let share = if fitting > 8.0 { 0.5 * fitting } else { fitting };
                (share.max(0.0) as u64).min(4 * spp)
            }
        };
    }
    let (wall_seconds, cpu_seconds) = (began.elapsed().as_secs_f64(), cpu.elapsed().as_secs_f64());
    Batch { film, spp, wall_seconds, cpu_seconds, tally, probe }
}

/// Returns the probe with which a film of this many samples per pixel is traced. Where the samples raise the
/// majorants, the samples before the last raise are traced to reproduce it, on `threads` threads or one per
/// core; otherwise nothing is traced.
///
/// # Errors
/// When the operating system refuses a thread.
pub fn probe_of_film(probe: &Probe, threads: Option<usize>, samples: u64) -> std::io::Result<Probe> {
    match samples.saturating_sub(1).checked_ilog2() {
        Some(raises) if probe.scene.is_progressive() => {
            let pool = ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).build();
            let pool = pool.map_err(std::io::Error::other)?;
            Ok(render(probe, &pool, Budget::Samples(1 << raises)).probe)
        }
        _ => Ok(probe.clone()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimator::{PathEstimate, PathIndex, Settings, find};
    use crate::io::Library;
    use crate::scene::{Scene, SceneDoc, WhenExceeded, build};
    use crate::transport::PathContext;
    use std::sync::Arc;

    fn pool() -> ThreadPool {
        ThreadPoolBuilder::new().num_threads(2).build().unwrap()
    }

    fn doc() -> SceneDoc {
        let mut doc = SceneDoc::default();
        (doc.film.width, doc.film.height) = (6, 5);
        doc
    }

    fn number(_: &Scene, _: &Settings, at: PathIndex, _: PathContext<'_>) -> PathEstimate {
        PathEstimate { rgb: glam::Vec3::splat(at.sample as f32), lookups: 1, exceeded: 0 }
    }

    fn numbered(scene: Scene) -> Probe {
        Probe::new(Arc::new(scene), number, Settings::new(&SceneDoc::default().estimator, 0))
    }

    #[test]
    fn a_budget_of_samples_gives_as_many_even_if_none() {
        let probe = numbered(build(&doc(), &mut Library::default()).unwrap());
        for limit in [0, 1, 2, 3, 7, 8, 100] {
            let batch = render(&probe, &pool(), Budget::Samples(limit));
            assert_eq!((batch.spp, batch.tally.paths), (limit, limit * 30));
            assert!(batch.film.pixels.iter().all(|p| p.count == limit && p.lookups == limit));
        }
    }

    #[test]
    fn a_budget_of_no_or_nonsensical_time_gives_one_sample() {
        let probe = numbered(build(&doc(), &mut Library::default()).unwrap());
        for seconds in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
            assert_eq!(render(&probe, &pool(), Budget::Seconds(seconds)).spp, 1, "{seconds}");
        }
    }

    #[test]
    fn a_film_without_pixels_is_rendered_at_once() {
        for (width, height) in [(0, 5), (6, 0), (0, 0)] {
            let mut scene = build(&doc(), &mut Library::default()).unwrap();
            (scene.width, scene.height) = (width, height);
            let batch = render(&numbered(scene), &pool(), Budget::Samples(9));
            assert_eq!((batch.spp, batch.tally.paths, batch.film.pixels.len()), (9, 0, 0));
        }
    }

    /// The paths replayed by a raised probe are those of the film, also if a probe is rendered twice, and if
    /// only the samples before the last raise were traced.
    #[test]
    fn a_batch_raises_majorants_and_its_probe_replays_every_sample() {
        let mut doc = doc();
        doc.medium_mut().majorant.factor = 0.1;
        doc.medium_mut().majorant.when_exceeded = WhenExceeded::Progressive;
        let scene = Arc::new(build(&doc, &mut Library::default()).unwrap());
        let kernel = find("uni-nee-mis").unwrap().kernel;
        let probe = Probe::new(scene, kernel, Settings::new(&doc.estimator, 0));
        const SPP: u64 = 21;
        let film = render(&probe, &pool(), Budget::Samples(SPP));
        assert_eq!(render(&probe, &pool(), Budget::Samples(SPP)).film.pixels, film.film.pixels);
        assert!(film.tally.exceeded > 0 && !film.probe.before.is_empty(), "nothing was raised");
        let of_film = probe_of_film(&probe, Some(2), SPP).unwrap();
        for replayed in [&film.probe, &of_film] {
            for (i, pixel) in film.film.pixels.iter().enumerate() {
                let mut again = crate::film::Pixel::default();
                for sample in replayed.samples((i as u32 % 6, i as u32 / 6), 0..SPP, CancelToken::NEVER) {
                    again.lookups += sample.lookups;
                    again.add(sample.rgb);
                }
                assert_eq!(again, *pixel);
            }
        }
    }
}
