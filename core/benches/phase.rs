//! Benchmarks of phase functions: sampling a direction, and evaluating a value.
#![allow(missing_docs, reason = "criterion's macros make undocumented functions")]

mod common;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec3;
use majorant_core::math::Sampler;
use majorant_core::phase::{Phase, PhaseDoc};

/// Events per measurement.
const EVENTS: u64 = 4096;

fn phases(c: &mut Criterion) {
    let mut group = c.benchmark_group("phase");
    group.throughput(Throughput::Elements(EVENTS));
    for doc in PhaseDoc::templates() {
        let phase = Phase::new(&doc);
        group.bench_function(format!("{}/draw", doc.kind().short), |b| {
            b.iter(|| {
                let mut random = Sampler::new(1, 2, 3);
                let mut direction = Vec3::X;
                let mut sum = 0.0;
                for _ in 0..EVENTS {
                    let (next, density) = phase.sample(direction, random.next_2d());
                    direction = next;
                    sum += density;
                }
                sum
            });
        });
        group.bench_function(format!("{}/value", doc.kind().short), |b| {
            b.iter(|| {
                let mut random = Sampler::new(1, 2, 3);
                (0..EVENTS).map(|_| phase.value(2.0 * random.next_1d() - 1.0)).sum::<f32>()
            });
        });
    }
    group.finish();
}

criterion_group! { name = benches; config = common::config(); targets = phases }
criterion_main!(benches);
