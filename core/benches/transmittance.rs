//! Benchmarks of transmittance estimates by every technique, with one component and four: along rays through
//! an embedded cloud, and along a closed form. `examples/transmittance.rs` measures the corresponding noise.
#![allow(missing_docs, reason = "criterion's macros make undocumented functions")]

mod common;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec2;
use majorant_core::math::Sampler;
use majorant_core::medium::{AnyMedium, LocalMedia, Medium, One};
use majorant_core::scene::Scene;
use majorant_core::spectrum::{Components, Wavelengths};
use majorant_core::transmittance::{Analytic, InMedium, Shape, TransmittanceKind};

/// Estimates per measurement.
const RAYS: u32 = 256;

fn closed_form<const N: usize>(c: &mut Criterion, extinction: [f32; N]) {
    let mut group = c.benchmark_group(format!("transmittance/gaussian, {N} components"));
    group.throughput(Throughput::Elements(u64::from(RAYS)));
    let profile = Analytic::new(Shape::Gaussian, extinction, 8);
    for kind in TransmittanceKind::all() {
        group.bench_function(kind.entry().id, |b| {
            b.iter(|| {
                let estimate = |i| kind.estimate(&profile, &mut Sampler::new(1, i, 0)).weight.hero();
                (0..u64::from(RAYS)).map(estimate).sum::<f32>()
            });
        });
    }
    group.finish();
}

fn along_rays<M: LocalMedia<4>>(scene: &Scene, media: &M, kind: TransmittanceKind) -> (f32, u64) {
    let size = Vec2::new(scene.width as f32, scene.height as f32);
    let (mut sum, mut lookups) = (0.0, 0);
    for path in 0..u64::from(RAYS) {
        let mut sampler = Sampler::new(3, path, 0);
        let ray = scene.camera.ray(sampler.next_2d() * size);
        let Some((_, traversal)) = media.traverse(&ray, f32::INFINITY) else { continue };
        let found = kind.estimate(&InMedium::new(traversal), &mut sampler);
        sum += found.weight.mean();
        lookups += u64::from(found.lookups);
    }
    (sum, lookups)
}

fn in_media(c: &mut Criterion) {
    for name in ["plume-spectral", "cloud-backlit"] {
        let doc = common::doc(name);
        let scene = common::frozen(&doc);
        let placed = &scene.media[0].placed;
        let AnyMedium::DensityGrid(medium) = &placed.medium else { continue };
        let components = Wavelengths::<4>::sample(0.3, Some(doc.estimator.wavelengths));
        let media = One { medium: medium.local(&components), placed };
        let mut group = c.benchmark_group(format!("transmittance/{name}"));
        group.throughput(Throughput::Elements(u64::from(RAYS)));
        for kind in TransmittanceKind::all() {
            group.bench_function(kind.entry().id, |b| b.iter(|| along_rays(&scene, &media, kind)));
        }
        group.finish();
    }
}

fn transmittance(c: &mut Criterion) {
    closed_form(c, [16.0]);
    closed_form(c, [16.0, 12.0, 8.0, 4.0]);
    in_media(c);
}

criterion_group! { name = benches; config = common::config(); targets = transmittance }
criterion_main!(benches);
