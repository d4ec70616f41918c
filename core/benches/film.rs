//! Benchmarks of the film: adding samples to a pixel, and computing images from it.
#![allow(missing_docs, reason = "criterion's macros make undocumented functions")]

mod common;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use majorant_core::film::{Film, Images, Pixel};
use majorant_core::math::Sampler;

fn film(c: &mut Criterion) {
    let mut random = Sampler::new(4, 0, 0);
    let samples: Vec<[f32; 3]> = (0..1024).map(|_| std::array::from_fn(|_| random.next_1d())).collect();
    let mut group = c.benchmark_group("film");
    group.throughput(Throughput::Elements(samples.len() as u64));
    group.bench_function("add", |b| {
        b.iter(|| {
            let mut pixel = Pixel::default();
            samples.iter().for_each(|s| pixel.add(*s));
            pixel
        });
    });
    let mut film = Film::new(960, 540);
    for (i, pixel) in film.pixels.iter_mut().enumerate() {
        samples[i % 1000..i % 1000 + 4].iter().for_each(|s| pixel.add(*s));
    }
    group.throughput(Throughput::Elements(film.pixels.len() as u64));
    group.bench_function("read 960 × 540", |b| b.iter(|| Images::of(&film)));
    group.finish();
}

criterion_group! { name = benches; config = common::config(); targets = film }
criterion_main!(benches);
