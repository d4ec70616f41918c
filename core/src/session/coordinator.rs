//! Coordinator thread, which owns the films and schedules the passes of all views.

use super::active::Active;
use super::job_cache::JobCache;
use super::mailbox::{Command, Mailbox};
use super::pass::Work;
use super::scheduler::Scheduler;
use super::{Job, Probe, Role, ViewId, preview};
use crate::estimator::{self, Settings};
use crate::film::{Film, Images};
use crate::io::Library;
use crate::transport::CancelToken;
use std::collections::{BTreeMap, BTreeSet};
use std::num::NonZeroUsize;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// Approximate number of paths of the first coarse image, one per block of pixels.
const COARSE_PATHS: usize = 8192;
/// A finer preview is rendered only if a whole pass would take longer than this.
const FINE_PREVIEW_SECONDS: f64 = 0.2;

/// Rows per task: one, so that workers stop soon and share the last rows of a pass.
const ROWS_PER_TASK: NonZeroUsize = NonZeroUsize::MIN;

/// Runs until the mailbox is closed.
pub(super) fn run(mailbox: &Mailbox, library: Library) {
    let mut coordinator = Coordinator {
        mailbox,
        cache: JobCache::new(library),
        views: BTreeMap::new(),
        paused: BTreeSet::new(),
        scheduler: Scheduler::default(),
        cancelled: BTreeMap::new(),
    };
    loop {
        let idle = !coordinator.views.values().any(Active::runnable);
        let Some(commands) = mailbox.take(idle) else { return };
        for command in commands {
            coordinator.execute(command);
        }
        coordinator.advance_next();
    }
}

struct Coordinator<'a> {
    mailbox: &'a Mailbox,
    cache: JobCache,
    views: BTreeMap<ViewId, Active>,
    /// Views that the user has paused; kept through edits and failures.
    paused: BTreeSet<ViewId>,
    scheduler: Scheduler,
    /// Films of views whose pass was cancelled, kept for their next job.
    cancelled: BTreeMap<ViewId, Film>,
}

impl Coordinator<'_> {
    fn execute(&mut self, command: Command) {
        match command {
            Command::Start { view, generation, job } => self.start(view, generation, &job),
            Command::Remove { view } => {
                self.views.remove(&view);
                self.paused.remove(&view);
                self.cancelled.remove(&view);
            }
            Command::Limits { view, limits } => self.change(view, |v| v.limits = limits),
            Command::Fairness(fairness) => self.scheduler.fairness = fairness,
            Command::Pause { view, paused } => {
                if paused {
                    self.paused.insert(view);
                } else {
                    self.paused.remove(&view);
                }
                self.change(view, |v| {
                    v.paused = paused;
                    v.steps = 0;
                });
            }
            Command::Step { view } => self.change(view, |v| v.steps += 1),
        }
    }

    fn change(&mut self, id: ViewId, f: impl FnOnce(&mut Active)) {
        if let Some(view) = self.views.get_mut(&id) {
            f(view);
            self.mailbox.publish_status(id, view);
        }
    }

    /// Runs the next pass of the view chosen by the scheduler.
    fn advance_next(&mut self) {
        let Some((id, most)) = self.scheduler.next(&self.views) else { return };
        let contenders = self.views.values().filter(|v| v.runnable() && v.role == Role::View).count();
        let Some(view) = self.views.get_mut(&id) else { return };
        let before = view.cpu_seconds;
        // A panicking worker must not end the session.
        let pass =
            catch_unwind(AssertUnwindSafe(|| view.advance(ROWS_PER_TASK, most).then(|| view.snapshot())));
        self.scheduler.note(view.role, view.cpu_seconds - before, contenders);
        match pass {
            Ok(Some(snapshot)) => {
                self.mailbox.publish_snapshot(id, snapshot, (view.status(), view.ending()));
                if view.raise_majorants() {
                    self.mailbox.publish_probe(id, view);
                }
            }
            Ok(None) => {
                let film = self.views.remove(&id).map(|view| view.film);
                self.cancelled.insert(id, film.unwrap_or(Film::new(0, 0)));
            }
            Err(panic) => {
                let generation = view.generation;
                self.views.remove(&id);
                self.fail(id, generation, internal_error(&*panic));
            }
        }
    }

    fn fail(&self, id: ViewId, generation: u64, message: String) {
        self.mailbox.publish_failure(id, generation, message);
    }

    fn start(&mut self, id: ViewId, generation: u64, job: &Job) {
        let (broken_off, ended) = (self.cancelled.remove(&id), self.views.remove(&id));
        if broken_off.is_some() || ended.as_ref().is_some_and(Active::runnable) {
            self.mailbox.note_cancelled(id, generation);
        }
        let film = broken_off.or(ended.map(|view| view.film)).unwrap_or(Film::new(0, 0));
        // A newer generation replaces this one: a closing session must not build every queued job.
        if !CancelToken::new(&self.mailbox.current(id), generation).is_active() {
            return;
        }
        let built = catch_unwind(AssertUnwindSafe(|| self.activate(id, generation, job)))
            .unwrap_or_else(|panic| Err(internal_error(&*panic)));
        let mut view = match built {
            Ok(view) => view,
            Err(message) => return self.fail(id, generation, message),
        };
        self.mailbox.publish_built(id, &view);
        if job.preview {
            let shown = catch_unwind(AssertUnwindSafe(|| self.show_preview(id, &view)));
            if let Err(panic) = shown {
                return self.fail(id, generation, internal_error(&*panic));
            }
        }
        // The film takes tens of megabytes; the first image does not wait for its allocation.
        view.load(film);
        self.views.insert(id, view);
    }

    fn activate(&mut self, id: ViewId, generation: u64, job: &Job) -> Result<Active, String> {
        let doc = &job.doc;
        let pool = self.cache.pool(doc.render.threads)?;
        // The worker threads of the view read its files, so that no more threads run than requested, and none
        // of the global pool that would outlive the session.
        let scene = pool.install(|| self.cache.scene(doc))?;
        let entry = estimator::find(&doc.estimator.id)
            .ok_or_else(|| format!("`{}` is not an estimator", doc.estimator.id))?;
        let settings = Settings::new(&doc.estimator, doc.render.seed);
        let current = self.mailbox.current(id);
        let probe = Probe::new(scene, entry.kernel, settings).afresh();
        let mut view = Active::new((generation, current), probe, pool, doc.render.limits());
        (view.role, view.target) = (job.role, self.cache.target(doc));
        view.paused = self.paused.contains(&id);
        Ok(view)
    }

    /// Publishes a coarse image at once, and finer ones while the first whole pass would take long.
    fn show_preview(&self, id: ViewId, view: &Active) {
        let probe = view.probe.aside();
        let work = Work { probe: &probe, ..view.work() };
        let pixels = view.probe.scene.width as usize * view.probe.scene.height as usize;
        let blocks = pixels.div_ceil(COARSE_PATHS);
        let mut stride = blocks.isqrt().max(4).next_power_of_two();
        loop {
            let began = Instant::now();
            let image = view.pool.install(|| preview::render(&work, stride));
            let Some(image) = image else { return };
            let standard_error = vec![[f32::INFINITY; 3]; image.len()];
            let images = Images { mean: image, standard_error, noise: Vec::new() };
            let snapshot = view.with_images(images, Some(stride as u32));
            self.mailbox.publish_snapshot(id, snapshot, (view.status(), view.ending()));
            let whole_pass = began.elapsed().as_secs_f64() * (stride * stride) as f64;
            if stride <= 2 || whole_pass < FINE_PREVIEW_SECONDS {
                return;
            }
            stride /= 2;
        }
    }
}

fn internal_error(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|s| (*s).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    let text = text.unwrap_or_else(|| "no message".into());
    format!("The renderer stopped on an internal error: {text}. Edit the scene to start again.")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimator::{Kernel, PathEstimate, PathIndex};
    use crate::scene::{Limits, Scene, SceneDoc};
    use crate::session::{Ending, Status};
    use crate::transport::PathContext;
    use std::sync::Arc;

    fn breaks(_: &Scene, _: &Settings, at: PathIndex, _: PathContext<'_>) -> PathEstimate {
        panic!("no estimate for pixel {} {}", at.x, at.y)
    }

    fn not_a_number(_: &Scene, _: &Settings, at: PathIndex, _: PathContext<'_>) -> PathEstimate {
        let value = if at.x == 1 && at.sample == 0 { f32::NAN } else { 0.5 };
        PathEstimate { rgb: glam::Vec3::splat(value), lookups: 1, exceeded: 0 }
    }

    /// A coordinator with one view of 3 × 2 pixels, traced by `kernel`.
    fn with_kernel(mailbox: &Mailbox, kernel: Kernel) -> (Coordinator<'_>, ViewId) {
        let mut doc = SceneDoc::default();
        (doc.film.width, doc.film.height) = (3, 2);
        let id = ViewId(0);
        let generation =
            mailbox.submit(id, Job { doc: Arc::new(doc.clone()), preview: false, role: Role::View });
        let mut cache = JobCache::new(Library::default());
        let scene = cache.scene(&doc).unwrap();
        let pool = cache.pool(Some(2)).unwrap();
        let settings = Settings::new(&doc.estimator, 0);
        let current = mailbox.current(id);
        let probe = Probe::new(scene, kernel, settings);
        let mut view = Active::new((generation, current), probe, pool, doc.render.limits());
        view.load(Film::new(0, 0));
        let views = BTreeMap::from([(id, view)]);
        let scheduler = Scheduler::default();
        let (paused, cancelled) = (BTreeSet::new(), BTreeMap::new());
        (Coordinator { mailbox, cache, views, paused, scheduler, cancelled }, id)
    }

    #[test]
    fn a_panicking_worker_becomes_a_status_and_the_coordinator_continues() {
        let mailbox = Mailbox::new(Box::new(|| {}), Library::default().progress().clone());
        let (mut coordinator, id) = with_kernel(&mailbox, breaks);
        coordinator.advance_next();
        let Status::Failed(message) = mailbox.state(id).status else { panic!("it should have failed") };
        assert!(message.contains("no estimate for pixel"), "{message}");
        // No view is left to advance, and the next job starts normally.
        coordinator.advance_next();
        let job = Job { doc: Arc::new(SceneDoc::default()), preview: false, role: Role::View };
        let generation = mailbox.submit(id, job.clone());
        coordinator.start(id, generation, &job);
        assert_eq!(mailbox.state(id).status, Status::Rendering);
    }

    #[test]
    fn samples_that_are_not_finite_are_counted_and_located() {
        let mailbox = Mailbox::new(Box::new(|| {}), Library::default().progress().clone());
        let (mut coordinator, id) = with_kernel(&mailbox, not_a_number);
        coordinator.advance_next();
        let first = mailbox.state(id).snapshot.unwrap();
        assert_eq!(first.tally.non_finite, 2);
        let places: Vec<_> = first.tally.located.iter().map(|n| (n.x, n.y, n.sample)).collect();
        assert_eq!(places, [(1, 0, 0), (1, 1, 0)]);
        // A pixel without any finite value is shown as NaN until its first finite sample.
        assert!(first.mean[1][0].is_nan() && first.mean[0] == [0.5; 3]);
        coordinator.advance_next();
        let later = mailbox.state(id).snapshot.unwrap();
        assert_eq!((later.mean[1], later.tally.non_finite), ([0.5; 3], 2));
    }

    fn black(_: &Scene, _: &Settings, _: PathIndex, _: PathContext<'_>) -> PathEstimate {
        PathEstimate { rgb: glam::Vec3::ZERO, lookups: 1, exceeded: 0 }
    }

    fn nowhere_finite(_: &Scene, _: &Settings, _: PathIndex, _: PathContext<'_>) -> PathEstimate {
        PathEstimate { rgb: glam::Vec3::INFINITY, lookups: 1, exceeded: 0 }
    }

    fn noisy(_: &Scene, _: &Settings, at: PathIndex, _: PathContext<'_>) -> PathEstimate {
        let pixel = u64::from(at.x + 3 * at.y);
        let value = crate::math::Sampler::new(1, pixel, at.sample).next_optical_depth();
        PathEstimate { rgb: glam::Vec3::splat(value), lookups: 1, exceeded: 0 }
    }

    /// With the error as the only limit, every image ends, after a number of samples that does not depend on
    /// their division into passes.
    #[test]
    fn an_error_as_the_only_limit_ends_every_picture() {
        let cases: [(Kernel, Ending); 3] =
            [(black, Ending::Black), (nowhere_finite, Ending::NotFinite), (noisy, Ending::RelativeError)];
        for (kernel, expected) in cases {
            let ends = [1, 3, u64::MAX].map(|most| {
                let mailbox = Mailbox::new(Box::new(|| {}), Library::default().progress().clone());
                let (mut coordinator, id) = with_kernel(&mailbox, kernel);
                let error = Limits { relative_error: Some(0.1), ..Limits::default() };
                let view = coordinator.views.get_mut(&id).unwrap();
                view.limits = error;
                for _ in 0..5000 {
                    let view = coordinator.views.get_mut(&id).unwrap();
                    if view.finished() {
                        break;
                    }
                    assert!(view.advance(ROWS_PER_TASK, most));
                    view.snapshot();
                }
                coordinator.execute(Command::Limits { view: id, limits: error });
                let (spp, state) = (coordinator.views[&id].spp, mailbox.state(id));
                assert_eq!((state.status, state.ending), (Status::Finished, Some(expected)));
                spp
            });
            assert_eq!(ends, [ends[0]; 3], "{expected:?}");
            assert!(ends[0] >= 16);
        }
    }

    /// Passes, raises and planned points continue beyond 32 bits.
    #[test]
    fn a_view_goes_on_beyond_32_bits_of_samples() {
        let mailbox = Mailbox::new(Box::new(|| {}), Library::default().progress().clone());
        for limits in [
            Limits::samples((1 << 32) + 5),
            Limits { relative_error: Some(1e-9), ..Limits::samples((1 << 32) + 5) },
        ] {
            let (mut coordinator, id) = with_kernel(&mailbox, noisy);
            let view = coordinator.views.get_mut(&id).unwrap();
            (view.limits, view.spp, view.last_pass) = (limits, (1 << 32) - 3, 2);
            (view.seconds, view.cpu_seconds) = (1.0, 1.0);
            for _ in 0..20 {
                coordinator.advance_next();
            }
            let state = mailbox.state(id);
            assert_eq!((state.status, state.ending), (Status::Finished, Some(Ending::Samples)));
            let snapshot = state.snapshot.unwrap();
            assert_eq!(
                (snapshot.spp, snapshot.tally.paths, snapshot.noise[0].samples),
                ((1 << 32) + 5, 48, 8)
            );
        }
    }

    #[test]
    fn a_superseded_start_is_not_built() {
        let (mailbox, id) = (Mailbox::new(Box::new(|| {}), Library::default().progress().clone()), ViewId(0));
        let job = Job { doc: Arc::new(SceneDoc::default()), preview: true, role: Role::View };
        let cache = JobCache::new(Library::default());
        let mut coordinator = Coordinator {
            mailbox: &mailbox,
            cache,
            views: BTreeMap::new(),
            paused: BTreeSet::new(),
            scheduler: Scheduler::default(),
            cancelled: BTreeMap::new(),
        };
        let superseded = mailbox.submit(id, job.clone());
        let removed = mailbox.submit(id, job.clone());
        coordinator.start(id, superseded, &job);
        assert!(coordinator.views.is_empty());
        mailbox.send(Command::Remove { view: id });
        coordinator.start(id, removed, &job);
        assert!(coordinator.views.is_empty());
        let closed = mailbox.submit(id, job.clone());
        mailbox.shut_down();
        coordinator.start(id, closed, &job);
        assert!(coordinator.views.is_empty());
    }
}
