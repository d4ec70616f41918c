//! Progressive rendering of any number of views in the background.
//!
//! ```text
//!   submit(view, Job) ──► mailbox (latest wins) ──► coordinator thread ──► worker pool (rows)
//!   latest(view)      ◄── Arc<Snapshot>         ◄── end of every pass, then wake()
//! ```
//!
//! The coordinator owns every film; no other thread locks one. A submission cancels the running pass (checked
//! row by row) and starts a new generation; stale snapshots are never published. The caller's thread never
//! waits for rendering, and an idle session uses no CPU.

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

/// Identifier of a view within a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ViewId(pub u32);

/// A rendering job for one view. The session builds the scene from the document; views with the same scene
/// share it, and grids are kept between edits.
#[derive(Clone, Debug, PartialEq)]
pub struct Job {
    /// The document: scene, estimator, limits.
    pub doc: Arc<SceneDoc>,
    /// Whether a coarse preview precedes the first pass.
    pub preview: bool,
    /// Whether the view competes with others or is rendered in the background.
    pub role: Role,
}

/// Scheduling class of a view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Role {
    /// Gets the same share as every other contender, measured by the session's [`Fairness`].
    #[default]
    View,
    /// Gets about the time of one contender, and all of it once the contenders are done.
    Background,
}

/// Status of a view.
#[derive(Clone, Debug, PartialEq)]
pub enum Status {
    /// No job was submitted.
    Empty,
    /// Files are being read and the scene is being built.
    Building,
    /// Passes are running.
    Rendering,
    /// Paused by the user; single passes can be stepped.
    Paused,
    /// The view has ended; see [`Ending`].
    Finished,
    /// The scene could not be built or a worker panicked; the message names the cause and the remedy.
    Failed(String),
}

/// Consistent snapshot of the state of one view.
#[derive(Clone, Debug)]
pub struct ViewState {
    /// Generation of the newest submission.
    pub generation: u64,
    /// Current status.
    pub status: Status,
    /// Reason why it has ended, if it has.
    pub ending: Option<Ending>,
    /// Newest image; belongs to an older generation until the new one has its first image.
    pub snapshot: Option<Arc<Snapshot>>,
    /// File that is being read while the scene is built.
    pub loading: Option<Loading>,
    /// Generation that `notices`, `scene` and `probe` belong to; older than the newest until that is built.
    pub built: u64,
    /// Notices from building the scene, e.g. NaN voxels that were set to 0.
    pub notices: Vec<String>,
    /// Statistics of the scene that was built last.
    pub scene: Option<SceneInfo>,
    /// Seconds from the newest submission to its first image.
    pub first_picture_seconds: Option<f64>,
    /// Seconds from the newest submission until its predecessor was no longer traced; `None` if no view was
    /// rendering.
    pub cancelled_seconds: Option<f64>,
    /// Probe that replays any of the paths.
    pub probe: Option<Probe>,
}

/// Progressive rendering in the background. Dropping a session cancels its work, waits until it has stopped,
/// and ends its threads.
pub struct Session {
    mailbox: Arc<Mailbox>,
    coordinator: Option<JoinHandle<()>>,
}

impl Session {
    /// Starts an idle session that locates files through `library` and calls `wake` (from the coordinator
    /// thread) whenever a view has changed.
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

    /// Sets the quantity in which contenders are kept equal; time by default.
    pub fn set_fairness(&self, fairness: Fairness) {
        self.mailbox.send(Command::Fairness(fairness));
    }

    /// Restarts a view with the same job.
    pub fn restart(&self, view: ViewId) {
        self.mailbox.restart(view);
    }

    /// Pauses after the current pass, or resumes.
    pub fn set_paused(&self, view: ViewId, paused: bool) {
        self.mailbox.send(Command::Pause { view, paused });
    }

    /// Runs one pass of one sample per pixel while paused.
    pub fn step(&self, view: ViewId) {
        self.mailbox.send(Command::Step { view });
    }

    /// Newest state of a view.
    #[must_use]
    pub fn state(&self, view: ViewId) -> ViewState {
        self.mailbox.state(view)
    }

    /// Removes a view and cancels its work.
    pub fn remove(&self, view: ViewId) {
        self.mailbox.send(Command::Remove { view });
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        self.mailbox.shut_down();
        if let Some(thread) = self.coordinator.take() {
            // A panic of the coordinator has already been published as a failed view.
            let _ = thread.join();
        }
    }
}
