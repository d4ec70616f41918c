//! Benchmarks of triangle meshes: loading a binary PLY with its hierarchy, and the cost per path by the number of
//! triangles, of a surface that reflects, bounds a medium, or emits.
#![allow(missing_docs, reason = "criterion's macros make undocumented functions")]

mod common;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use majorant_core::estimator::{PathIndex, Settings, find};
use majorant_core::io::{Library, mesh, scene_file};
use majorant_core::scene::{Scene, SceneDoc, build};
use majorant_core::transport::CancelToken;
use std::f64::consts::{PI, TAU};
use std::path::Path;

/// Sphere with bumps, closed, of about this many triangles, as a binary PLY.
fn bumpy_sphere(triangles: usize) -> Vec<u8> {
    let rows = ((triangles as f64 / 4.0).sqrt() as usize).max(4);
    let columns = 2 * rows;
    let mut positions = vec![[0.0, 0.0, 1.0]];
    for row in 1..rows {
        for column in 0..columns {
            let (theta, phi) = (PI * row as f64 / rows as f64, TAU * column as f64 / columns as f64);
            let r = 1.0 + 0.05 * (9.0 * theta).sin() * (7.0 * phi).sin();
            positions.push([r * theta.sin() * phi.cos(), r * theta.sin() * phi.sin(), r * theta.cos()]);
        }
    }
    positions.push([0.0, 0.0, -1.0]);
    let at = |row: usize, column: usize| match row {
        0 => 0,
        row if row == rows => positions.len() - 1,
        row => 1 + (row - 1) * columns + column % columns,
    };
    let mut faces = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let [a, b] = [at(row, column), at(row + 1, column)];
            let [c, d] = [at(row + 1, column + 1), at(row, column + 1)];
            if row > 0 {
                faces.push([a, c, d]);
            }
            if row + 1 < rows {
                faces.push([a, b, c]);
            }
        }
    }
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        positions.len(),
        faces.len()
    )
    .into_bytes();
    positions.iter().flatten().for_each(|x| bytes.extend((*x as f32).to_le_bytes()));
    for face in faces {
        bytes.push(3);
        face.iter().for_each(|index| bytes.extend((*index as u32).to_le_bytes()));
    }
    bytes
}

fn load(c: &mut Criterion) {
    let mut group = c.benchmark_group("mesh load");
    group.sample_size(10);
    for count in [10_000, 1_000_000] {
        let bytes = bumpy_sphere(count);
        group.bench_function(format!("{count} triangles"), |b| {
            b.iter(|| mesh::parse_mesh(&bytes, Path::new("a.ply")).map(|(mesh, _)| mesh.bytes()));
        });
    }
    group.finish();
}

/// Paths of one iteration.
const PATHS: u32 = 1024;

fn trace(scene: &Scene, doc: &SceneDoc) -> f32 {
    let Some(entry) = find("uni-nee-mis") else { return 0.0 };
    let settings = Settings::new(&doc.estimator, 0);
    (0..PATHS)
        .map(|i| {
            let at = PathIndex { x: i % 32 * 4, y: i / 32 * 4, sample: 0 };
            (entry.kernel)(scene, &settings, at, CancelToken::NEVER.into()).rgb.x
        })
        .sum()
}

fn paths(c: &mut Criterion) {
    let mut group = c.benchmark_group("mesh paths");
    group.throughput(Throughput::Elements(u64::from(PATHS)));
    let uses = [
        ("reflects", "material = { kind = \"diffuse\", albedo = 0.5 }"),
        ("bounds", "material = { kind = \"interface\" }\n[[media]]\nwithin = \"mesh\"\nextinction = 4.0"),
        ("emits", "emission = { radiance = 2.0 }"),
    ];
    for count in [1000, 10_000, 100_000, 1_000_000] {
        let bytes = bumpy_sphere(count);
        let mut library = Library::default().with_volume("a.ply", bytes);
        for (name, what) in uses {
            let text = format!(
                "majorant = 2
                camera = {{ origin = [0.0, 0.5, 2.5], target = [0.0, 0.0, 0.0], fov_deg = 40.0 }}
                film = {{ width = 128, height = 128 }}
                [[lights]]
                kind = \"environment\"
                [[media]]
                name = \"haze\"
                within = \"everywhere\"
                extent = 3.0
                extinction = 0.2
                [[objects]]
                name = \"mesh\"
                kind = \"mesh\"
                file = \"a.ply\"
                placement = {{ fit = 1.0 }}
                {what}"
            );
            let Ok(doc) = scene_file::parse(&text, "bench") else { continue };
            let Ok(scene) = build(&doc, &mut library) else { continue };
            group.bench_function(format!("{name}, {count} triangles"), |b| b.iter(|| trace(&scene, &doc)));
        }
    }
    group.finish();
}

criterion_group! { name = benches; config = common::config(); targets = load, paths }
criterion_main!(benches);
