//! All threads of a session end with it. Threads are counted for the whole process, so that this must be the
//! only test of its program.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may panic")]

use majorant_core::session::{Status, ViewId};
use majorant_tests::session::{Watched, endless, job, small_doc};
use std::time::{Duration, Instant};

/// Number of threads of this process that belong to sessions, found by the prefix of their names.
fn threads() -> usize {
    let tasks = std::fs::read_dir("/proc/self/task").unwrap();
    // A thread may end between the listing and the reading of its name.
    let names = tasks.filter_map(|task| std::fs::read_to_string(task.unwrap().path().join("comm")).ok());
    names.filter(|name| name.starts_with("majorant-")).count()
}

/// Asserts the number of threads; waits until the system has removed ended threads from its list.
fn assert_threads(expected: usize, when: &str) {
    let began = Instant::now();
    while threads() != expected {
        assert!(began.elapsed() < Duration::from_secs(20), "{} threads, not {expected}, {when}", threads());
        std::thread::sleep(Duration::from_millis(2));
    }
}

#[test]
fn no_thread_outlives_its_session() {
    assert_eq!(threads(), 0);
    let view = ViewId(0);

    // Idle, rendering, finished, and in the middle of a path.
    let session = Watched::new();
    assert_threads(1, "when nothing was submitted");
    session.submit(view, job(&small_doc(3, 2), true));
    session.wait_finished(view);
    assert_threads(1 + 3, "when a view is finished");
    session.submit(ViewId(1), job(&endless(2), false));
    session.wait(ViewId(1), |state| state.status == Status::Rendering);
    assert_threads(1 + 3 + 2, "with a pool for each number of threads");
    session.remove(ViewId(1));
    drop(session);
    assert_threads(0, "after a session with a view removed in the middle of a pass");

    // Successive numbers of threads: unused pools are released.
    let session = Watched::new();
    for threads in 1..=6 {
        session.submit(view, job(&small_doc(threads, 1), false));
        session.wait_finished(view);
        assert_threads(1 + threads, "after the number of threads was changed");
    }
    drop(session);
    assert_threads(0, "after six numbers of threads");

    // Views are removed and sessions dropped while they are built, previewed and rendered.
    for round in 0..24 {
        let session = Watched::new();
        for i in 0..4 {
            let doc = if i % 2 == 0 { endless(1 + i) } else { small_doc(1 + i, 1 << 20) };
            session.submit(ViewId(i as u32), job(&doc, true));
        }
        std::thread::sleep(Duration::from_millis(round));
        if round % 2 == 0 {
            session.remove(ViewId(0));
            session.remove(ViewId(3));
        }
    }
    assert_threads(0, "after sessions dropped at arbitrary times");
}
