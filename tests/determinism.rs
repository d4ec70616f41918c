//! The image after N samples depends only on scene, settings, seed and N, bit by bit.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may panic")]

use majorant_core::scene::Limits;
use majorant_core::scene::{MaterialDoc, ObjectDoc, SceneDoc, ShapeDoc};
use majorant_core::session::{Status, ViewId};
use majorant_core::spectrum::SpectrumDoc;
use majorant_tests::session::{Watched, assert_same, endless, finished, job, small_doc};

const VIEW: ViewId = ViewId(0);

#[test]
fn threads_do_not_matter() {
    let one = finished(&small_doc(1, 9));
    for threads in [2, 3, 8] {
        assert_same(&one, &finished(&small_doc(threads, 9)));
    }
    assert_eq!(one.tally.paths, 61 * 37 * 9);
    assert!(one.tally.lookups > 0 && one.tally.non_finite == 0);
}

#[test]
fn the_seed_does() {
    let mut other = small_doc(2, 2);
    other.render.seed = 1;
    assert_ne!(finished(&small_doc(2, 2)).mean, finished(&other).mean);
}

#[test]
fn pauses_steps_and_raised_limits_do_not_matter() {
    let whole = finished(&small_doc(2, 12));
    let session = Watched::new();
    session.submit(VIEW, job(&small_doc(2, 3), true));
    session.wait_finished(VIEW);
    session.set_paused(VIEW, true);
    session.set_limits(VIEW, Limits::samples(12));
    session.step(VIEW);
    session.wait_picture(VIEW, |_, s| s.spp == 4);
    session.step(VIEW);
    session.step(VIEW);
    session.wait_picture(VIEW, |_, s| s.spp == 6);
    assert_eq!(session.state(VIEW).status, Status::Paused);
    session.set_paused(VIEW, false);
    assert_same(&whole, &session.wait_finished(VIEW));
}

/// The image does not depend on how its samples are divided into limits.
#[test]
fn limits_raised_step_by_step_do_not_matter() {
    let whole = finished(&small_doc(2, 12));
    for pieces in [&[1, 12][..], &[11, 12], &[2, 3, 5, 8, 12], &[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]] {
        let session = Watched::new();
        session.submit(VIEW, job(&small_doc(2, pieces[0]), false));
        for spp in pieces {
            session.set_limits(VIEW, Limits::samples(*spp));
            session.wait_picture(VIEW, |_, s| s.spp == *spp);
        }
        assert_same(&whole, &session.wait_finished(VIEW));
    }
}

#[test]
fn a_restart_keeps_the_limits_that_were_set_last() {
    let session = Watched::new();
    session.submit(VIEW, job(&small_doc(2, 2), false));
    session.set_limits(VIEW, Limits::samples(5));
    session.wait_picture(VIEW, |_, s| s.spp == 5);
    session.restart(VIEW);
    assert_same(&session.wait_finished(VIEW), &finished(&small_doc(2, 5)));
}

#[test]
fn an_edit_cancels_starts_over_and_keeps_generations_apart() {
    let session = Watched::new();
    let mut long = small_doc(2, 1 << 20);
    (long.film.width, long.film.height) = (640, 400);
    let first = session.submit(VIEW, job(&long, true));
    session.wait_picture(VIEW, |_, s| s.generation == first);
    let second = session.submit(VIEW, job(&small_doc(2, 4), false));
    assert!(second > first);
    let snapshot = session.wait_finished(VIEW);
    assert_eq!(snapshot.generation, second);
    assert_same(&snapshot, &finished(&small_doc(2, 4)));
}

#[test]
fn views_share_a_session() {
    let session = Watched::new();
    session.submit(ViewId(7), job(&small_doc(2, 6), false));
    let mut other = small_doc(2, 5);
    other.estimator.id = "nee".into();
    session.submit(VIEW, job(&other, false));
    session.wait_finished(VIEW);
    assert_eq!(session.wait_finished(ViewId(7)).spp, 6);
    session.remove(ViewId(7));
    assert_eq!(session.state(ViewId(7)).status, Status::Empty);
}

#[test]
fn a_scene_that_cannot_be_built_fails_and_the_session_lives_on() {
    let session = Watched::new();
    let mut bad = small_doc(2, 1);
    bad.medium_mut().density = majorant_core::scene::DensityDoc::Grid(majorant_core::scene::GridRef {
        file: "missing.vdb".into(),
        grid: None,
    });
    session.submit(VIEW, job(&bad, true));
    let failed = session.wait(VIEW, |state| matches!(state.status, Status::Failed(_)));
    let Status::Failed(message) = failed.status else { unreachable!() };
    assert!(message.contains("missing.vdb") && message.contains("medium.density"), "{message}");
    session.submit(VIEW, job(&small_doc(2, 1), true));
    session.wait_finished(VIEW);
}

/// Submits a scene in which one path takes hours, and waits until it is rendering.
fn submit_endless(session: &Watched, endless: &SceneDoc) {
    session.submit(VIEW, job(endless, false));
    session.wait(VIEW, |state| state.status == Status::Rendering);
}

/// Scenes with nearly endless paths, by collisions and by surface reflections.
fn endless_scenes() -> [SceneDoc; 2] {
    let dense = endless(2);
    // A closed white room without a medium: the path has no collisions.
    let mut room = dense.clone();
    room.medium_mut().extinction = SpectrumDoc::Constant(0.0);
    room.objects.push(ObjectDoc {
        material: MaterialDoc::Diffuse { albedo: SpectrumDoc::Constant(1.0) },
        ..ObjectDoc::new(ShapeDoc::Box { center: [0.0; 3], size: [3.0; 3], rotate_deg: [0.0; 3] })
    });
    [dense, room]
}

#[test]
fn endless_paths_are_cancelled_by_an_edit_and_by_closing() {
    for mut endless in endless_scenes() {
        for id in ["nee", "uni-nee-mis", "independent"] {
            let session = Watched::new();
            endless.estimator.id = id.into();
            submit_endless(&session, &endless);
            session.submit(VIEW, job(&small_doc(2, 1), true));
            session.wait_finished(VIEW);
            submit_endless(&session, &endless);
            // Dropping the session waits until its work is cancelled.
        }
    }
}

#[test]
fn a_paused_view_stays_paused_through_edits_and_failures() {
    let session = Watched::new();
    session.set_paused(VIEW, true);
    session.submit(VIEW, job(&small_doc(2, 9), true));
    let mut broken = small_doc(2, 9);
    broken.estimator.id = "none".into();
    session.submit(VIEW, job(&broken, true));
    for spp in [9, 8] {
        session.submit(VIEW, job(&small_doc(2, spp), true));
        session.step(VIEW);
        session.wait_picture(VIEW, |status, s| *status == Status::Paused && s.spp == 1);
    }
}
