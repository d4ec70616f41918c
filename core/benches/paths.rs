//! Benchmarks of path tracing: every estimator on four scenes, averaged over many pixels, then the cost of
//! modes, samplers and grid sizes.
#![allow(missing_docs, reason = "criterion's macros make undocumented functions")]

mod common;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec3;
use majorant_core::estimator::{Entry, PathIndex, REGISTRY, Settings, find};
use majorant_core::io::Library;
use majorant_core::math::SamplerKind;
use majorant_core::scene::{
    DensityDoc, DirectionSampling, GridRef, LightSampling, MediumDoc, Mode, Scene, SceneDoc, build,
};
use majorant_core::transport::CancelToken;

/// Paths per measurement, spread over the image.
const PATHS: u32 = 1024;

fn trace(scene: &Scene, doc: &SceneDoc, entry: &Entry) -> Vec3 {
    let settings = Settings::new(&doc.estimator, 1);
    let mut sum = Vec3::ZERO;
    for i in 0..PATHS {
        // Steps coprime to the image's width and height visit it evenly.
        let at = PathIndex {
            x: (i * 37) % scene.width,
            y: (i * 101 / 7) % scene.height,
            sample: u64::from(i / 256),
        };
        sum += (entry.kernel)(scene, &settings, at, CancelToken::NEVER.into()).rgb;
    }
    sum
}

fn estimators(c: &mut Criterion) {
    for name in common::SCENES {
        let doc = common::doc(name);
        let scene = common::frozen(&doc);
        let mut group = c.benchmark_group(format!("paths/{name}"));
        group.throughput(Throughput::Elements(u64::from(PATHS)));
        for entry in REGISTRY {
            group.bench_function(entry.id, |b| b.iter(|| trace(&scene, &doc, entry)));
        }
        group.finish();
    }
}

type Edit = fn(&mut SceneDoc);

fn options(c: &mut Criterion) {
    let Some(entry) = find("uni-nee-mis") else { return };
    let mut group = c.benchmark_group("options/plume-spectral");
    group.throughput(Throughput::Elements(u64::from(PATHS)));
    let edits: [(&str, Edit); 6] = [
        ("spectral", |_| {}),
        ("rgb", |d| d.estimator.mode = Mode::Rgb),
        ("lattice", |d| d.estimator.sampler = SamplerKind::Lattice),
        ("guided", |d| d.estimator.directions = DirectionSampling::TowardsLights),
        ("product", |d| {
            d.estimator.directions = DirectionSampling::Product;
            d.estimator.light_sampling = LightSampling::Product;
        }),
        ("global majorant", |d| d.medium_mut().majorant.resolution = Some(1)),
    ];
    for (name, edit) in edits {
        let mut doc = common::doc("plume-spectral");
        edit(&mut doc);
        let scene = common::frozen(&doc);
        group.bench_function(name, |b| b.iter(|| trace(&scene, &doc, entry)));
    }
    group.finish();
}

/// The same cloud at increasing grid resolution, which should have little effect on a path.
fn sizes(c: &mut Criterion) {
    let Some(entry) = find("uni-nee-mis") else { return };
    let mut group = c.benchmark_group("grid size");
    group.throughput(Throughput::Elements(u64::from(PATHS)));
    for n in [64usize, 128, 256, 512] {
        let mut doc = common::doc("cloud-sidelit");
        let name = format!("cloud_{n}x{n}x{n}.raw");
        doc.medium_mut().density = DensityDoc::Grid(GridRef { file: name.clone(), grid: None });
        doc.medium_mut().placement.fit = Some(1.0);
        let library = Library::default().with_volume(&name, cloud(n));
        let Ok(scene) = build(&doc, &mut library.clone()) else { continue };
        group.bench_function(BenchmarkId::from_parameter(format!("{n}³")), |b| {
            b.iter(|| trace(&scene, &doc, entry));
        });
    }
    group.finish();
}

/// A cloud as one medium, as several that overlap, each with its share of the extinction, and as a row of
/// clouds beside each other of the same total length.
fn media(c: &mut Criterion) {
    let Some(entry) = find("uni-nee-mis") else { return };
    let mut group = c.benchmark_group("media");
    group.throughput(Throughput::Elements(u64::from(PATHS)));
    let mut bench = |name: String, edit: &dyn Fn(usize, &mut MediumDoc), count: usize| {
        let mut doc = common::doc("cloud-sidelit");
        let one = doc.medium().clone();
        doc.media.clear();
        for index in 0..count {
            let mut medium = MediumDoc { name: index.to_string(), ..one.clone() };
            edit(index, &mut medium);
            doc.media.push(medium);
        }
        let scene = common::frozen(&doc);
        group.bench_function(name, |b| b.iter(|| trace(&scene, &doc, entry)));
    };
    for count in [1, 2, 8] {
        bench(format!("{count} overlapping"), &|_, medium| medium.scale /= count as f32, count);
    }
    for count in [8, 64] {
        // A plate of small clouds in the place of the large one, four deep.
        let side = (count / 4) as f32;
        let small = move |index: usize, medium: &mut MediumDoc| {
            let scale = medium.placement.fit.unwrap_or(1.0) / side.max(4.0);
            let at = |i: usize, n: f32| (i as f32 + 0.5 - 0.5 * n) * scale;
            medium.placement.fit = Some(scale);
            medium.placement.translate = [at(index / 4, side), 0.0, at(index % 4, 4.0)];
            medium.scale /= scale;
        };
        bench(format!("{count} disjoint"), &small, count);
    }
    group.finish();
}

/// Raw voxels of a lumpy ball with the same shape at every resolution.
fn cloud(n: usize) -> Vec<u8> {
    let value = |i: usize| {
        let p =
            Vec3::new((i % n) as f32 + 0.5, (i / n % n) as f32 + 0.5, (i / n / n) as f32 + 0.5) / n as f32;
        let lumps = (p.x * 19.0).sin() * (p.y * 23.0).sin() * (p.z * 17.0).sin();
        (0.35 + 0.1 * lumps - (p - 0.5).length()).clamp(0.0, 0.1) * 10.0
    };
    (0..n * n * n).flat_map(|i| value(i).to_le_bytes()).collect()
}

criterion_group! { name = benches; config = common::config(); targets = estimators, options, sizes, media }
criterion_main!(benches);
