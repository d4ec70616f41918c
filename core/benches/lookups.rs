//! Benchmarks of density look-ups: trilinear and stochastic, at every precision, in small and large grids.
#![allow(missing_docs, reason = "criterion's macros make undocumented functions")]

mod common;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec3;
use majorant_core::math::Sampler;
use majorant_core::medium::{Grid, Interpolation, Lattice, Packing, Precision};
use std::hint::black_box;

/// A ball of noise that fills a third of its bounding box.
fn ball(n: usize) -> Vec<[f32; 1]> {
    let mut random = Sampler::new(1, 0, 0);
    let value = |i: usize| {
        let at = Vec3::new((i % n) as f32, (i / n % n) as f32, (i / n / n) as f32) / n as f32 - 0.5;
        [if at.length() < 0.43 { random.next_1d() } else { 0.0 }]
    };
    (0..n * n * n).map(value).collect()
}

/// Points along random rays, or in random order.
fn points(along_rays: bool) -> Vec<Vec3> {
    let mut random = Sampler::new(2, 0, 0);
    let mut any = || Vec3::new(random.next_1d(), random.next_1d(), random.next_1d());
    if !along_rays {
        return (0..4096).map(|_| any()).collect();
    }
    (0..64)
        .flat_map(|_| {
            let (a, b) = (any(), any());
            (0..64u8).map(move |i| a.lerp(b, f32::from(i) / 64.0))
        })
        .collect()
}

fn lookups(c: &mut Criterion) {
    for n in [64, 256, 512] {
        let values = ball(n);
        let mut group = c.benchmark_group(format!("look-ups/{n}³"));
        for precision in [Precision::F32, Precision::F16, Precision::U8] {
            let packing = Packing { precision, ..Packing::default() };
            let Some(grid) = Grid::packed([n; 3], &values, Lattice::CellCentred, packing) else { continue };
            for (interpolation, along_rays) in [
                (Interpolation::Trilinear, false),
                (Interpolation::Trilinear, true),
                (Interpolation::Stochastic, true),
            ] {
                let points = points(along_rays);
                group.throughput(Throughput::Elements(points.len() as u64));
                let order = if along_rays { "rays" } else { "random" };
                let id = BenchmarkId::new(format!("{interpolation:?} {order}"), format!("{precision:?}"));
                group.bench_function(id, |b| {
                    b.iter(|| points.iter().map(|p| grid.look_up(*p, interpolation, 0)[0]).sum::<f32>());
                });
            }
        }
        // A plain array with the same values as the bricks, for comparison.
        let points = points(true);
        group.throughput(Throughput::Elements(points.len() as u64));
        group.bench_function("plain array rays", |b| {
            b.iter(|| points.iter().map(|p| plain(&values, n, black_box(*p))).sum::<f32>());
        });
        group.finish();
    }
}

fn plain(values: &[[f32; 1]], n: usize, unit: Vec3) -> f32 {
    let index = (unit * n as f32 - 0.5).clamp(Vec3::ZERO, Vec3::splat((n - 1) as f32));
    let (x, y, z) = (index.x as usize, index.y as usize, index.z as usize);
    let f = index - Vec3::new(x as f32, y as f32, z as f32);
    let (dx, dy, dz) =
        (usize::from(x + 1 < n), if y + 1 < n { n } else { 0 }, if z + 1 < n { n * n } else { 0 });
    let base = x + n * (y + n * z);
    let lerp = |a: f32, b: f32, t: f32| a + (b - a) * t;
    let along_x = |i: usize| lerp(values[i][0], values[i + dx][0], f.x);
    let along_y = |i: usize| lerp(along_x(i), along_x(i + dy), f.y);
    lerp(along_y(base), along_y(base + dz), f.z)
}

criterion_group! { name = benches; config = common::config(); targets = lookups }
criterion_main!(benches);
