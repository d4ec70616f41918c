//! State shared by callers and the coordinator: commands, view states, and one cancellation flag per view.

use super::active::Active;
use super::{Ending, Job, Status, ViewId, ViewState};
use crate::film::Snapshot;
use crate::io::Progress;
use crate::scene::{Fairness, Limits};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// A request to the coordinator.
#[derive(Debug)]
pub(super) enum Command {
    Start { view: ViewId, generation: u64, job: Job },
    Limits { view: ViewId, limits: Limits },
    Fairness(Fairness),
    Pause { view: ViewId, paused: bool },
    Step { view: ViewId },
    Remove { view: ViewId },
}

/// One view as callers see it.
struct Public {
    state: ViewState,
    job: Option<Job>,
    submitted: Instant,
    /// Newest generation; a pass of an older one stops at its next row.
    current: Arc<AtomicU64>,
}

impl Public {
    fn new() -> Self {
        Self {
            state: ViewState {
                generation: 0,
                status: Status::Empty,
                ending: None,
                snapshot: None,
                loading: None,
                built: 0,
                notices: Vec::new(),
                scene: None,
                first_picture_seconds: None,
                cancelled_seconds: None,
                probe: None,
            },
            job: None,
            submitted: Instant::now(),
            current: Arc::new(AtomicU64::new(0)),
        }
    }
}

impl ViewState {
    fn set(&mut self, status: Status, ending: Option<Ending>) {
        (self.status, self.ending) = (status, ending);
    }
}

#[derive(Default)]
struct Inner {
    commands: Vec<Command>,
    views: BTreeMap<ViewId, Public>,
    generations: u64,
    closed: bool,
}

pub(super) struct Mailbox {
    inner: Mutex<Inner>,
    arrived: Condvar,
    wake: Box<dyn Fn() + Send + Sync>,
    /// Loading progress of the files that the coordinator reads.
    progress: Progress,
}

impl Mailbox {
    pub fn new(wake: Box<dyn Fn() + Send + Sync>, progress: Progress) -> Self {
        Self { inner: Mutex::default(), arrived: Condvar::new(), wake, progress }
    }

    /// Locks the state. Every critical section leaves `Inner` consistent, so a poisoned lock remains usable.
    fn lock(&self) -> MutexGuard<'_, Inner> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub fn submit(&self, view: ViewId, job: Job) -> u64 {
        self.submit_locked(&mut self.lock(), view, job)
    }

    fn submit_locked(&self, inner: &mut Inner, view: ViewId, job: Job) -> u64 {
        inner.generations += 1;
        let generation = inner.generations;
        let public = inner.views.entry(view).or_insert_with(Public::new);
        public.state.generation = generation;
        public.state.status = Status::Building;
        public.state.ending = None;
        public.state.first_picture_seconds = None;
        public.state.cancelled_seconds = None;
        public.submitted = Instant::now();
        public.job = Some(job.clone());
        public.current.store(generation, Ordering::Release);
        // The latest job wins: an older start that was not yet taken is dropped.
        inner.commands.retain(|c| !matches!(c, Command::Start { view: v, .. } if *v == view));
        inner.commands.push(Command::Start { view, generation, job });
        self.arrived.notify_one();
        generation
    }

    /// Submits the job of a view again. One lock covers both steps, so that no newer job is lost and no
    /// removed view reappears.
    pub fn restart(&self, view: ViewId) {
        let mut inner = self.lock();
        let job = inner.views.get(&view).and_then(|p| p.job.clone());
        if let Some(job) = job {
            self.submit_locked(&mut inner, view, job);
        }
    }

    pub fn send(&self, command: Command) {
        let mut inner = self.lock();
        match &command {
            Command::Remove { view } => {
                if let Some(public) = inner.views.remove(view) {
                    public.current.store(u64::MAX, Ordering::Release);
                }
            }
            Command::Limits { view, limits } => {
                if let Some(job) = inner.views.get_mut(view).and_then(|p| p.job.as_mut()) {
                    Arc::make_mut(&mut job.doc).render.set_limits(*limits);
                }
            }
            _ => {}
        }
        inner.commands.push(command);
        self.arrived.notify_one();
    }

    pub fn shut_down(&self) {
        let mut inner = self.lock();
        inner.closed = true;
        for public in inner.views.values() {
            public.current.store(u64::MAX, Ordering::Release);
        }
        self.arrived.notify_one();
    }

    pub fn state(&self, view: ViewId) -> ViewState {
        let inner = self.lock();
        let mut state = inner.views.get(&view).map_or_else(|| Public::new().state, |p| p.state.clone());
        if state.status == Status::Building {
            state.loading = self.progress.loading();
        }
        state
    }

    /// Takes the pending commands; if `wait`, blocks until there is one. `None` means shut down.
    pub fn take(&self, wait: bool) -> Option<Vec<Command>> {
        let mut inner = self.lock();
        while wait && inner.commands.is_empty() && !inner.closed {
            inner = self.arrived.wait(inner).unwrap_or_else(PoisonError::into_inner);
        }
        if inner.closed { None } else { Some(std::mem::take(&mut inner.commands)) }
    }

    /// Atomic that holds the newest generation of a view.
    pub fn current(&self, view: ViewId) -> Arc<AtomicU64> {
        self.lock()
            .views
            .get(&view)
            .map_or_else(|| Arc::new(AtomicU64::new(u64::MAX)), |p| Arc::clone(&p.current))
    }

    /// Changes the public state of a view if `generation` is still its newest, then calls `wake`.
    fn publish(&self, view: ViewId, generation: u64, change: impl FnOnce(&mut Public)) {
        {
            let mut inner = self.lock();
            match inner.views.get_mut(&view) {
                Some(public) if public.state.generation == generation => change(public),
                _ => return,
            }
        }
        (self.wake)();
    }

    /// Publishes the failure of a view.
    pub fn publish_failure(&self, view: ViewId, generation: u64, message: String) {
        self.publish(view, generation, |p| p.state.set(Status::Failed(message), None));
    }

    /// Publishes the status of a view.
    pub fn publish_status(&self, view: ViewId, active: &Active) {
        self.publish(view, active.generation, |p| p.state.set(active.status(), active.ending()));
    }

    /// Records that no generation before `generation` is being traced any more.
    pub fn note_cancelled(&self, view: ViewId, generation: u64) {
        if let Some(public) = self.lock().views.get_mut(&view)
            && public.state.generation == generation
        {
            public.state.cancelled_seconds = Some(public.submitted.elapsed().as_secs_f64());
        }
    }

    /// Publishes the notices and information of a newly built scene.
    pub fn publish_built(&self, view: ViewId, active: &Active) {
        self.publish(view, active.generation, |p| {
            p.state.set(active.status(), active.ending());
            p.state.built = active.generation;
            p.state.notices.clone_from(&active.probe.scene.notices);
            p.state.scene = Some(active.probe.scene.info.clone());
            p.state.probe = Some(active.probe.aside());
        });
    }

    /// Publishes the probe that applies from now on.
    pub fn publish_probe(&self, view: ViewId, active: &Active) {
        self.publish(view, active.generation, |p| p.state.probe = Some(active.probe.aside()));
    }

    /// Publishes an image together with its status.
    pub fn publish_snapshot(
        &self,
        view: ViewId,
        snapshot: Snapshot,
        (status, ending): (Status, Option<Ending>),
    ) {
        self.publish(view, snapshot.generation, |p| {
            let waited = p.submitted.elapsed().as_secs_f64();
            p.state.first_picture_seconds.get_or_insert(waited);
            p.state.set(status, ending);
            p.state.snapshot = Some(Arc::new(snapshot));
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::SceneDoc;
    use crate::session::Role;
    use std::sync::atomic::AtomicBool;

    fn job(seed: u64) -> Job {
        let mut doc = SceneDoc::default();
        doc.render.seed = seed;
        Job { doc: Arc::new(doc), preview: false, role: Role::View }
    }

    #[test]
    fn a_restart_meanwhile_loses_no_newer_job_and_brings_no_view_back() {
        let (mailbox, view) = (Mailbox::new(Box::new(|| {}), Progress::default()), ViewId(0));
        let newest = || mailbox.lock().views.get(&view).and_then(|p| p.job.clone());
        let done = AtomicBool::new(false);
        std::thread::scope(|scope| {
            scope.spawn(|| {
                while !done.load(Ordering::Relaxed) {
                    mailbox.restart(view);
                }
            });
            for seed in 0..5000 {
                mailbox.submit(view, job(seed));
                let kept = (0..20).all(|_| newest() == Some(job(seed)));
                mailbox.send(Command::Remove { view });
                let gone = (0..20).all(|_| newest().is_none());
                mailbox.take(false);
                if !(kept && gone) {
                    done.store(true, Ordering::Relaxed);
                    panic!("job {seed}: kept {kept}, gone {gone}");
                }
            }
            done.store(true, Ordering::Relaxed);
        });
    }
}
