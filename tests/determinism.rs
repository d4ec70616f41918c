//! The image after N samples depends on scene, settings, seed and N alone, bit by bit.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may panic")]

use majorant_core::film::Snapshot;
use majorant_core::io::{Library, embedded, scene_file};
use majorant_core::scene::SceneDoc;
use majorant_core::session::{Job, Session, Status, ViewId};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, sync_channel};
use std::time::Duration;

const VIEW: ViewId = ViewId(0);
const PATIENCE: Duration = Duration::from_secs(120);

fn doc(threads: usize, spp: u32) -> SceneDoc {
    let text = embedded::find("first-light").unwrap().toml;
    let mut doc = scene_file::parse(text, "first-light").unwrap();
    (doc.film.width, doc.film.height) = (61, 37);
    doc.render.threads = Some(threads);
    (doc.render.spp, doc.render.seconds) = (Some(spp), None);
    doc
}

fn session() -> (Session, Receiver<()>) {
    let (wake, woken) = sync_channel(1);
    let session = Session::new(Library::default(), move || {
        let _ = wake.try_send(());
    });
    (session.unwrap(), woken)
}

/// Waits until the view has a state that `wanted` accepts.
fn wait(
    session: &Session,
    woken: &Receiver<()>,
    wanted: impl Fn(&Status, Option<&Snapshot>) -> bool,
) -> Arc<Snapshot> {
    loop {
        let state = session.state(VIEW);
        if let Status::Failed(message) = &state.status {
            panic!("{message}");
        }
        if let Some(snapshot) = &state.snapshot
            && snapshot.generation == state.generation
            && wanted(&state.status, Some(snapshot))
        {
            return Arc::clone(snapshot);
        }
        woken.recv_timeout(PATIENCE).expect("the session went silent");
    }
}

fn finished(doc: SceneDoc) -> Arc<Snapshot> {
    let (session, woken) = session();
    session.submit(VIEW, Job { doc: Arc::new(doc), preview: false });
    wait(&session, &woken, |status, _| *status == Status::Finished)
}

fn assert_same(a: &Snapshot, b: &Snapshot) {
    assert_eq!(a.spp, b.spp);
    let bits = |s: &Snapshot| -> Vec<u32> {
        s.mean.iter().chain(&s.standard_error).flatten().map(|x| x.to_bits()).collect()
    };
    assert!(bits(a) == bits(b), "the images differ");
    assert_eq!(a.tally, b.tally);
}

#[test]
fn threads_do_not_matter() {
    let one = finished(doc(1, 9));
    assert_same(&one, &finished(doc(3, 9)));
    assert_eq!(one.tally.paths, 61 * 37 * 9);
    assert!(one.tally.lookups > 0 && one.tally.non_finite == 0);
}

#[test]
fn the_seed_does() {
    let mut other = doc(2, 2);
    other.render.seed = 1;
    assert_ne!(finished(doc(2, 2)).mean, finished(other).mean);
}

#[test]
fn pauses_steps_and_raised_limits_do_not_matter() {
    let whole = finished(doc(2, 12));
    let (session, woken) = session();
    session.submit(VIEW, Job { doc: Arc::new(doc(2, 3)), preview: true });
    wait(&session, &woken, |status, _| *status == Status::Finished);
    session.set_paused(VIEW, true);
    session.set_limits(VIEW, Some(12), None);
    session.step(VIEW);
    wait(&session, &woken, |_, s| s.is_some_and(|s| s.spp == 4));
    session.step(VIEW);
    session.step(VIEW);
    wait(&session, &woken, |_, s| s.is_some_and(|s| s.spp == 6));
    assert_eq!(session.state(VIEW).status, Status::Paused);
    session.set_paused(VIEW, false);
    let pieced = wait(&session, &woken, |status, _| *status == Status::Finished);
    assert_same(&whole, &pieced);
}

#[test]
fn an_edit_cancels_starts_over_and_keeps_generations_apart() {
    let (session, woken) = session();
    let mut long = doc(2, 1 << 20);
    (long.film.width, long.film.height) = (640, 400);
    let first = session.submit(VIEW, Job { doc: Arc::new(long), preview: true });
    wait(&session, &woken, |_, s| s.is_some_and(|s| s.generation == first));
    let second = session.submit(VIEW, Job { doc: Arc::new(doc(2, 4)), preview: false });
    assert!(second > first);
    let snapshot = wait(&session, &woken, |status, _| *status == Status::Finished);
    assert_eq!(snapshot.generation, second);
    assert_same(&snapshot, &finished(doc(2, 4)));
}

#[test]
fn views_share_a_session() {
    let (session, woken) = session();
    session.submit(ViewId(7), Job { doc: Arc::new(doc(2, 6)), preview: false });
    let mut other = doc(2, 5);
    other.estimator.id = "nee".into();
    session.submit(VIEW, Job { doc: Arc::new(other), preview: false });
    wait(&session, &woken, |status, _| *status == Status::Finished);
    while session.state(ViewId(7)).status != Status::Finished {
        woken.recv_timeout(PATIENCE).expect("the session went silent");
    }
    assert_eq!(session.state(ViewId(7)).snapshot.unwrap().spp, 6);
    session.remove(ViewId(7));
    assert_eq!(session.state(ViewId(7)).status, Status::Empty);
}

#[test]
fn a_scene_that_cannot_be_built_fails_and_the_session_lives_on() {
    let (session, woken) = session();
    let mut bad = doc(2, 1);
    bad.medium.density = majorant_core::scene::DensityDoc::Grid(majorant_core::scene::GridRef {
        file: "missing.vdb".into(),
        grid: None,
    });
    session.submit(VIEW, Job { doc: Arc::new(bad), preview: true });
    let message = loop {
        if let Status::Failed(message) = session.state(VIEW).status {
            break message;
        }
        woken.recv_timeout(PATIENCE).expect("the session went silent");
    };
    assert!(message.contains("missing.vdb") && message.contains("medium.density"), "{message}");
    session.submit(VIEW, Job { doc: Arc::new(doc(2, 1)), preview: true });
    wait(&session, &woken, |status, _| *status == Status::Finished);
}

/// Submits a scene in which one path takes hours and waits until it renders.
fn submit_endless(session: &Session, woken: &Receiver<()>, endless: SceneDoc) {
    session.submit(VIEW, Job { doc: Arc::new(endless), preview: false });
    while session.state(VIEW).status != Status::Rendering {
        if let Status::Failed(message) = session.state(VIEW).status {
            panic!("{message}");
        }
        woken.recv_timeout(PATIENCE).expect("the session went silent");
    }
}

fn endless_scenes() -> Vec<SceneDoc> {
    let parse = |text: &str| {
        let mut doc = scene_file::parse(text, "endless").unwrap();
        doc.render.threads = Some(2);
        doc
    };
    vec![
        // Half a million mean free paths of albedo 1, the camera in the middle.
        parse(
            "majorant = 1
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
            kind = \"environment\"",
        ),
        // A closed white room without any medium: no collision is ever looked up.
        parse(
            "majorant = 1
            [camera]
            origin = [0.0, 0.0, 0.0]
            target = [0.0, 0.0, -1.0]
            [film]
            width = 61
            height = 37
            [medium]
            extinction = 0.0
            [[lights]]
            kind = \"environment\"
            [[objects]]
            kind = \"box\"
            center = [0.0, 0.0, 0.0]
            size = [3.0, 3.0, 3.0]
            albedo = 1.0",
        ),
    ]
}

#[test]
fn endless_paths_are_cancelled_by_an_edit_and_by_closing() {
    for endless in endless_scenes() {
        for id in ["nee", "uni-nee-mis", "independent"] {
            let (session, woken) = session();
            let mut endless = endless.clone();
            endless.estimator.id = id.into();
            submit_endless(&session, &woken, endless.clone());
            session.submit(VIEW, Job { doc: Arc::new(doc(2, 1)), preview: true });
            wait(&session, &woken, |status, _| *status == Status::Finished);
            submit_endless(&session, &woken, endless);
            // Dropping the session joins its threads.
        }
    }
}

#[test]
fn a_paused_view_stays_paused_through_edits_and_failures() {
    let (session, woken) = session();
    session.set_paused(VIEW, true);
    session.submit(VIEW, Job { doc: Arc::new(doc(2, 9)), preview: true });
    let mut broken = doc(2, 9);
    broken.estimator.id = "none".into();
    session.submit(VIEW, Job { doc: Arc::new(broken), preview: true });
    for spp in [9, 8] {
        let generation = session.submit(VIEW, Job { doc: Arc::new(doc(2, spp)), preview: true });
        session.step(VIEW);
        wait(&session, &woken, |status, s| {
            *status == Status::Paused && s.is_some_and(|s| s.generation == generation && s.spp == 1)
        });
    }
}
