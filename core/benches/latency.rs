//! What an edit waits for at 960 × 540: until nobody works on the old scene, and until there is a picture.
#![allow(missing_docs, reason = "criterion's macros make undocumented functions")]

mod common;

use criterion::{Criterion, criterion_group, criterion_main};
use majorant_core::io::Library;
use majorant_core::session::{Job, Role, Session, ViewId};
use std::sync::Arc;
use std::time::{Duration, Instant};

const VIEW: ViewId = ViewId(0);

/// Edits a scene that renders, again and again; the sum of what `measured` says of each edit.
fn edits(scene: &str, count: u64, measured: impl Fn(&Session) -> Option<f64>) -> Duration {
    let mut doc = common::doc(scene);
    (doc.film.width, doc.film.height) = (960, 540);
    let Ok(session) = Session::new(Library::default(), || {}) else { return Duration::ZERO };
    let mut total = 0.0;
    for edit in 0..=count {
        doc.medium.scale *= if edit % 2 == 0 { 1.01 } else { 1.0 / 1.01 };
        session.submit(VIEW, Job { doc: Arc::new(doc.clone()), preview: true, role: Role::Contender });
        let since = Instant::now();
        // The first submission reads files and cancels nothing.
        loop {
            let ready = session.state(VIEW).snapshot.is_some_and(|s| s.spp > 0);
            if ready || since.elapsed() > Duration::from_secs(20) {
                break;
            }
            std::thread::sleep(Duration::from_micros(200));
        }
        if edit > 0 {
            total += measured(&session).unwrap_or(f64::NAN);
        }
        // Somewhere in the middle of a pass.
        std::thread::sleep(Duration::from_millis(30 + 7 * (edit % 11)));
    }
    Duration::from_secs_f64(if total.is_finite() { total } else { 0.0 })
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
