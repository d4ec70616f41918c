//! Benchmarks of volume loading: the embedded volumes, and those listed in the environment variable
//! `MAJORANT_BENCH_VOLUMES`, separated by colons.
#![allow(missing_docs, reason = "criterion's macros make undocumented functions")]

mod common;

use criterion::{Criterion, criterion_group, criterion_main};
use majorant_core::io::Library;
use majorant_core::medium::{Interpolation, Precision};
use majorant_core::scene::{GridRef, Resources};

fn load(c: &mut Criterion) {
    let own = std::env::var("MAJORANT_BENCH_VOLUMES").unwrap_or_default();
    let files = ["embedded:plume.vdb", "embedded:cloud.vdb"].into_iter().chain(own.split_terminator(':'));
    let mut group = c.benchmark_group("load");
    group.sample_size(10);
    for file in files {
        let grid = GridRef { file: file.to_owned(), grid: None };
        group.bench_function(file, |b| {
            b.iter(|| {
                Library::default().scalar_grid(&grid, Precision::F32).map(|placed| placed.grid.bytes())
            });
        });
        let Ok(placed) = Library::default().scalar_grid(&grid, Precision::F32) else { continue };
        let bounds = || majorant_core::medium::MajorantGrid::new(&placed.grid, 128, Interpolation::Trilinear);
        group.bench_function(format!("{file} majorants 128³"), |b| b.iter(bounds));
    }
    group.finish();
}

criterion_group! { name = benches; config = common::config(); targets = load }
criterion_main!(benches);
