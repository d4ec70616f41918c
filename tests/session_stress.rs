//! Sessions under random requests: every view ends with the image of an undisturbed session, bit by bit.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may panic")]

use majorant_core::film::Snapshot;
use majorant_core::math::Sampler;
use majorant_core::scene::Limits;
use majorant_core::scene::{Mode, SceneDoc};
use majorant_core::session::{Status, ViewId};
use majorant_tests::session::{Watched, assert_same, finished, job, small_doc};
use std::sync::Arc;
use std::time::Duration;

const SPP: u64 = 8;
const VIEWS: u32 = 3;
const REQUESTS: u32 = 150;

/// Documents that differ in everything that a session caches between jobs, with their images.
fn documents() -> Vec<(SceneDoc, Arc<Snapshot>)> {
    let vary = |threads: usize, change: &dyn Fn(&mut SceneDoc)| {
        let mut doc = small_doc(threads, SPP);
        (doc.film.width, doc.film.height) = (37, 23);
        change(&mut doc);
        let image = finished(&doc);
        (doc, image)
    };
    vec![
        vary(1, &|_| {}),
        vary(2, &|doc| doc.estimator.id = "nee".into()),
        vary(3, &|doc| (doc.estimator.mode, doc.render.seed) = (Mode::Rgb, 7)),
        vary(8, &|doc| {
            doc.film.width = 20;
            doc.medium_mut().scale *= 0.5;
        }),
    ]
}

/// Asserts that a view has a snapshot of its last submission, or the one that it had at that time.
fn assert_not_stale(session: &Watched, view: ViewId, before: Option<&Arc<Snapshot>>) {
    let state = session.state(view);
    let newest = state.snapshot.as_ref().is_some_and(|s| s.generation == state.generation);
    let kept = state.snapshot.as_ref().map(Arc::as_ptr) == before.map(Arc::as_ptr);
    assert!(newest || kept, "{view:?} has a snapshot of a replaced job");
    assert!(newest || state.status != Status::Finished, "{view:?} is finished without a snapshot");
}

/// Sends random requests to a session; returns the index of the document last submitted to each view.
fn storm(session: &Watched, documents: &[(SceneDoc, Arc<Snapshot>)], seed: u64) -> Vec<Option<usize>> {
    let mut random = Sampler::new(seed, 0, 0);
    let mut below = |n: u32| (random.next_1d() * n as f32) as u32;
    let mut given = vec![None; VIEWS as usize];
    let mut before = vec![None; VIEWS as usize];
    for _ in 0..REQUESTS {
        let index = below(VIEWS);
        let view = ViewId(index);
        let generation = session.state(view).generation;
        match below(10) {
            0 | 1 => session.set_paused(view, below(2) == 0),
            2 | 3 => session.step(view),
            4 => session.restart(view),
            5 | 6 => session.set_limits(view, Limits::samples(1 + u64::from(below(SPP as u32)))),
            7 | 8 => {
                let chosen = below(documents.len() as u32) as usize;
                session.submit(view, job(&documents[chosen].0, below(2) == 0));
                given[index as usize] = Some(chosen);
            }
            _ => {
                session.remove(view);
                given[index as usize] = None;
                assert_eq!(session.state(view).status, Status::Empty);
            }
        }
        if session.state(view).generation != generation {
            before[index as usize] = session.state(view).snapshot;
        }
        // Most requests follow immediately, some during a build, a preview or a pass.
        if below(3) == 0 {
            std::thread::sleep(Duration::from_micros(u64::from(below(6000))));
        }
        for (view, before) in (0..).map(ViewId).zip(&before) {
            assert_not_stale(session, view, before.as_ref());
        }
    }
    given
}

#[test]
fn storms_of_requests_leave_every_image_as_it_was() {
    let documents = documents();
    for seed in 0..8 {
        let session = Watched::new();
        let given = storm(&session, &documents, seed);
        for (view, chosen) in (0..).map(ViewId).zip(given) {
            let chosen = chosen.unwrap_or_else(|| {
                session.submit(view, job(&documents[0].0, true));
                0
            });
            session.set_paused(view, false);
            session.set_limits(view, Limits::samples(SPP));
            let image = session.wait_picture(view, |status, s| *status == Status::Finished && s.spp == SPP);
            assert_same(&image, &documents[chosen].1);
        }
    }
}

/// Views and whole sessions are dropped while they are built, previewed and rendered; the remaining view is
/// not affected.
#[test]
fn views_may_be_dropped_at_any_moment() {
    let documents = documents();
    for round in 0..12 {
        let session = Watched::new();
        for i in 0..16 {
            session.submit(ViewId(i), job(&documents[i as usize % 4].0, true));
        }
        std::thread::sleep(Duration::from_millis(3 * round));
        for i in 1..16 {
            session.remove(ViewId(i));
        }
        // Every other session is dropped while its last view is unfinished.
        if round % 2 == 0 {
            assert_same(&session.wait_finished(ViewId(0)), &documents[0].1);
            assert_eq!(session.state(ViewId(5)).status, Status::Empty);
        }
    }
}
