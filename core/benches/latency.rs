//! Latency of an edit at 960 × 540: until all workers have stopped on the old scene, and until the first
//! image.
#![allow(missing_docs, reason = "criterion's macros make undocumented functions")]

mod common;

use criterion::{Criterion, criterion_group, criterion_main};
use majorant_core::io::Library;
use majorant_core::session::{Job, Role, Session, ViewId};
use std::sync::Arc;
use std::time::{Duration, Instant};

const VIEW: ViewId = ViewId(0);
/// Time-out; slower edits are recorded with this duration.
const PATIENCE: Duration = Duration::from_secs(20);

/// Edits a scene repeatedly while it renders; returns the sum of `measured` over the edits.
fn edits(scene: &str, count: u64, measured: impl Fn(&Session) -> Option<f64>) -> Duration {
    let mut doc = common::doc(scene);
    (doc.film.width, doc.film.height) = (960, 540);
    let Ok(session) = Session::new(Library::default(), || {}) else { return Duration::ZERO };
    let mut total = 0.0;
    for edit in 0..=count {
        doc.medium_mut().scale *= if edit % 2 == 0 { 1.01 } else { 1.0 / 1.01 };
        session.submit(VIEW, Job { doc: Arc::new(doc.clone()), preview: true, role: Role::View });
        let since = Instant::now();
        // The image of an earlier submission is still present; only this number is reset.
        while session.state(VIEW).first_picture_seconds.is_none() && since.elapsed() < PATIENCE {
            std::thread::sleep(Duration::from_micros(200));
        }
        // The first submission reads files and cancels nothing.
        if edit > 0 {
            total += measured(&session).unwrap_or(PATIENCE.as_secs_f64());
        }
        // The next edit falls in the middle of a pass.
        std::thread::sleep(Duration::from_millis(30 + 7 * (edit % 11)));
    }
    Duration::from_secs_f64(total)
}

fn latency(c: &mut Criterion) {
    let mut group = c.benchmark_group("latency");
    group.sample_size(10).measurement_time(Duration::from_secs(4));
    for scene in ["first-light", "cloud-sidelit"] {
        group.bench_function(format!("{scene} first picture"), |b| {
            b.iter_custom(|count| edits(scene, count, |s| s.state(VIEW).first_picture_seconds));
        });
        group.bench_function(format!("{scene} cancelled"), |b| {
            b.iter_custom(|count| edits(scene, count, |s| s.state(VIEW).cancelled_seconds));
        });
    }
    group.finish();
}

criterion_group! { name = benches; config = common::config(); targets = latency }
criterion_main!(benches);
