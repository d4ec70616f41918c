//! Progressive rendering of any number of views in the background.
//!
//! ```text
//!   submit(view, Job) ──► mailbox (latest wins) ──► coordinator thread ──► worker pool (rows)
//!   latest(view)      ◄── Arc<Snapshot>         ◄── end of every pass, then wake()
//! ```
//!
//! The coordinator owns every film; nobody else ever locks one. A submission cancels the pass that
//! runs (checked row by row) and starts a new generation; stale snapshots are never published.
//! The caller's thread never waits for rendering, and an idle session uses no CPU.

mod active;
mod batch;
mod coordinator;
mod job_cache;
mod mailbox;
mod pass;
mod preview;
mod probe;
mod scheduler;
mod stopping;

use crate::film::Snapshot;
use crate::io::{Library, Loading};
use crate::scene::{Fairness, Limits, SceneDoc, SceneInfo};
pub use batch::{Batch, Budget, probe_of_film, render};
use mailbox::{Command, Mailbox};
pub use probe::{PixelSample, Probe};
use std::sync::Arc;
use std::thread::JoinHandle;
pub use stopping::Ending;

/// Names a view of a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ViewId(pub u32);

/// What one view shall show. The scene is frozen from the document by the session; views that
/// agree in it share one frozen scene, and grids are kept between edits.
#[derive(Clone, Debug, PartialEq)]
pub struct Job {
    /// The document: scene, estimator, limits.
    pub doc: Arc<SceneDoc>,
    /// Whether a coarse picture comes before the first pass.
    pub preview: bool,
    /// Whether it competes with the others, or is rendered beside them.
    pub role: Role,
}

/// How a view takes turns with the others.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Role {
    /// Gets as much as every other contender, by the session's [`Fairness`].
    #[default]
    Contender,
    /// Gets about one contender's share of the time, and all of it once the contenders are done.
    Background,
}

/// What a view is doing.
#[derive(Clone, Debug, PartialEq)]
pub enum Status {
    /// Nothing was submitted yet.
    Empty,
    /// Files are read and the scene is frozen.
    Building,
    /// Passes run.
    Rendering,
    /// Paused by the user; a pass can be stepped.
    Paused,
    /// A limit was reached.
    Finished,
    /// The scene could not be built or a worker panicked; the message names the cause and the cure.
    Failed(String),
}

/// A consistent look at one view.
#[derive(Clone, Debug)]
pub struct ViewState {
    /// The newest submission.
    pub generation: u64,
    /// What it is doing.
    pub status: Status,
    /// Why it is finished, if it is.
    pub ending: Option<Ending>,
    /// The newest picture; it may belong to an older generation until the new one has a first picture.
    pub snapshot: Option<Arc<Snapshot>>,
    /// The file that is read while the scene is built.
    pub loading: Option<Loading>,
    /// The submission that `notices`, `scene` and `probe` belong to: an older one until the newest is built.
    pub built: u64,
    /// What building repaired or wants to be known, e.g. NaN voxels that were set to 0.
    pub notices: Vec<String>,
    /// Numbers about the newest scene that was built.
    pub scene: Option<SceneInfo>,
    /// Seconds from the newest submission to its first picture.
    pub first_picture_seconds: Option<f64>,
    /// Seconds from the newest submission until no worker traced the one before; none if nothing was rendering.
    pub cancelled_seconds: Option<f64>,
    /// Traces any of its paths again.
    pub probe: Option<Probe>,
}

/// Progressive renders in the background. Dropping it cancels the work, waits until it has stopped, and
/// ends its threads.
pub struct Session {
    mailbox: Arc<Mailbox>,
    coordinator: Option<JoinHandle<()>>,
}

impl Session {
    /// Starts an idle session that finds files through `library` and calls `wake` (from its own
    /// thread) whenever there is something new to see.
    ///
    /// # Errors
    /// When the operating system refuses a thread.
    pub fn new(library: Library, wake: impl Fn() + Send + Sync + 'static) -> std::io::Result<Self> {
        let mailbox = Arc::new(Mailbox::new(Box::new(wake), library.progress().clone()));
        let theirs = Arc::clone(&mailbox);
        let coordinator = std::thread::Builder::new()
            .name("majorant-coordinator".into())
            .spawn(move || coordinator::run(&theirs, library))?;
        Ok(Self { mailbox, coordinator: Some(coordinator) })
    }

    /// Replaces what a view renders and returns the new generation. Never blocks on rendering.
    pub fn submit(&self, view: ViewId, job: Job) -> u64 {
        self.mailbox.submit(view, job)
    }

    /// Raises or lowers a view's limits without starting over.
    pub fn set_limits(&self, view: ViewId, limits: Limits) {
        self.mailbox.send(Command::Limits { view, limits });
    }

    /// What contenders get as much of as each other: time, unless it is set.
    pub fn set_fairness(&self, fairness: Fairness) {
        self.mailbox.send(Command::Fairness(fairness));
    }

    /// Starts a view over with the same job.
    pub fn restart(&self, view: ViewId) {
        self.mailbox.restart(view);
    }

    /// Pauses after the pass that runs, or goes on.
    pub fn set_paused(&self, view: ViewId, paused: bool) {
        self.mailbox.send(Command::Pause { view, paused });
    }

    /// While paused: runs one pass of one sample per pixel.
    pub fn step(&self, view: ViewId) {
        self.mailbox.send(Command::Step { view });
    }

    /// The newest state of a view.
    #[must_use]
    pub fn state(&self, view: ViewId) -> ViewState {
        self.mailbox.state(view)
    }

    /// Forgets a view and cancels its work.
    pub fn remove(&self, view: ViewId) {
        self.mailbox.send(Command::Remove { view });
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        self.mailbox.shut_down();
        if let Some(thread) = self.coordinator.take() {
            // A panicked coordinator has already reported itself as a failed view.
            let _ = thread.join();
        }
    }
}
