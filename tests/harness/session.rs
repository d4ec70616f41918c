//! A session whose view states can be waited for without polling.

use majorant_core::film::Snapshot;
use majorant_core::io::{Library, embedded, scene_file};
use majorant_core::scene::SceneDoc;
use majorant_core::session::{Job, Role, Session, Status, ViewId, ViewState};
use std::ops::Deref;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, sync_channel};
use std::time::Duration;

const PATIENCE: Duration = Duration::from_secs(120);

/// A small embedded scene with a grid, with the given numbers of threads and samples per pixel.
pub fn small_doc(threads: usize, spp: u64) -> SceneDoc {
    let text = embedded::find("first-light").unwrap().toml;
    let mut doc = scene_file::parse(text, "first-light").unwrap();
    (doc.film.width, doc.film.height) = (61, 37);
    doc.render.threads = Some(threads);
    (doc.render.spp, doc.render.seconds) = (Some(spp), None);
    doc
}

/// A scene in which a single path takes hours: an optical depth of 250 000 with albedo 1, and the camera in
/// the centre.
pub fn endless(threads: usize) -> SceneDoc {
    let text = "
        majorant = 1
        [camera]
        origin = [0.0, 0.0, 0.0]
        target = [0.0, 0.0, -1.0]
        [film]
        width = 61
        height = 37
        [medium]
        extinction = 250000.0
        albedo = 1.0
        [[lights]]
        kind = \"environment\"";
    let mut doc = scene_file::parse(text, "endless").unwrap();
    doc.render.threads = Some(threads);
    doc
}

/// Creates a job for a document.
pub fn job(doc: &SceneDoc, preview: bool) -> Job {
    Job { doc: Arc::new(doc.clone()), preview, role: Role::View }
}

/// A session with a channel that signals changes.
pub struct Watched {
    session: Session,
    woken: Receiver<()>,
}

impl Deref for Watched {
    type Target = Session;
    fn deref(&self) -> &Session {
        &self.session
    }
}

impl Watched {
    pub fn new() -> Self {
        let (wake, woken) = sync_channel(1);
        let session = Session::new(Library::default(), move || {
            let _ = wake.try_send(());
        });
        Self { session: session.unwrap(), woken }
    }

    /// Waits until the state of a view satisfies a condition.
    pub fn wait(&self, view: ViewId, wanted: impl Fn(&ViewState) -> bool) -> ViewState {
        loop {
            let state = self.session.state(view);
            if wanted(&state) {
                return state;
            }
            if let Status::Failed(message) = &state.status {
                panic!("{message}");
            }
            self.woken
                .recv_timeout(PATIENCE)
                .unwrap_or_else(|_| panic!("the session sent no signal: {state:?}"));
        }
    }

    /// Waits until the snapshot of the newest submission of a view satisfies a condition.
    pub fn wait_picture(&self, view: ViewId, wanted: impl Fn(&Status, &Snapshot) -> bool) -> Arc<Snapshot> {
        let current = |state: &ViewState| {
            state.snapshot.clone().filter(|s| s.generation == state.generation && wanted(&state.status, s))
        };
        current(&self.wait(view, |state| current(state).is_some())).unwrap()
    }

    /// Waits until a view has reached its limit.
    pub fn wait_finished(&self, view: ViewId) -> Arc<Snapshot> {
        self.wait_picture(view, |status, _| *status == Status::Finished)
    }
}

impl Default for Watched {
    fn default() -> Self {
        Self::new()
    }
}

/// Renders a document in an undisturbed session.
pub fn finished(doc: &SceneDoc) -> Arc<Snapshot> {
    let session = Watched::new();
    session.submit(ViewId(0), job(doc, false));
    session.wait_finished(ViewId(0))
}

/// Asserts that two snapshots are equal bit by bit.
pub fn assert_same(a: &Snapshot, b: &Snapshot) {
    assert_eq!(a.spp, b.spp);
    let bits = |s: &Snapshot| -> Vec<u32> {
        s.mean.iter().chain(&s.standard_error).flatten().map(|x| x.to_bits()).collect()
    };
    assert!(bits(a) == bits(b), "the images differ");
    assert_eq!(a.tally, b.tally);
}
