//! Benchmarks of free flights through local majorants, by majorant resolution, with all tentative collisions
//! taken as null.
#![allow(missing_docs, reason = "criterion's macros make undocumented functions")]

mod common;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec2;
use majorant_core::math::Sampler;
use majorant_core::medium::{AnyMedium, Medium, One};
use majorant_core::scene::Absorption;
use majorant_core::spectrum::{Components, Wavelengths};
use majorant_core::transport::{CancelToken, PathWeights, Trace, Walk, WalkWeights};

fn walk(c: &mut Criterion) {
    let mut group = c.benchmark_group("majorant walk");
    for cells in [1, 4, 8, 16, 32, 64, 128] {
        let mut doc = common::doc("plume-spectral");
        doc.medium_mut().majorant.resolution = Some(cells);
        let scene = common::frozen(&doc);
        let placed = &scene.media[0].placed;
        let AnyMedium::DensityGrid(medium) = &placed.medium else { continue };
        let size = Vec2::new(scene.width as f32, scene.height as f32);
        group.throughput(Throughput::Elements(256));
        group.bench_function(BenchmarkId::from_parameter(format!("{cells}³")), |b| {
            b.iter(|| {
                let mut found = 0u64;
                for path in 0..256 {
                    let mut trace = Trace::new(Sampler::new(3, path, 0), CancelToken::NEVER);
                    let components =
                        Wavelengths::<4>::sample(trace.sampler.next_1d(), Some(doc.estimator.wavelengths));
                    let media = One { medium: medium.local(&components), placed };
                    let ray = scene.camera.ray(trace.sampler.next_2d() * size);
                    let mut walk = Walk::new(&media, &ray, f32::INFINITY, Absorption::Weighted);
                    let mut weights = PathWeights::CAMERA;
                    while let Some(collision) = walk.next_collision(&mut trace, &mut weights) {
                        weights.null_by_ratio(&collision);
                        found += 1;
                    }
                }
                found
            });
        });
    }
    group.finish();
}

criterion_group! { name = benches; config = common::config(); targets = walk }
criterion_main!(benches);
