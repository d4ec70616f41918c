use super::*;
use crate::film::{Film, Pixel};
use crate::io::Library;
use crate::scene::{SceneDoc, build};
use crate::session::{Budget, Probe, render};
use crate::transport::Trace;

const SPP: u64 = 24;

/// Adds contributions of every technique, with pseudo-random orders and numbers of null collisions. Some
/// samples are not finite, in one layer or only in their sum, and all samples of the pixels of column 0.
fn occasionally_non_finite(_: &Scene, _: &Settings, at: PathIndex, context: PathContext<'_>) -> PathEstimate {
    let number = at.sample + 3 * u64::from(at.x) + 7 * u64::from(at.y);
    let mut trace = Trace::new(crate::math::Sampler::new(5, number, 0), context);
    let mut sum = Vec3::ZERO;
    for (i, technique) in Technique::ALL.into_iter().enumerate() {
        let broken = at.x == 0 || number % 11 == i as u64;
        let film = if broken { Vec3::new(1.0, f32::NAN, 1.0) } else { Vec3::splat(trace.sampler.next_1d()) };
        for _ in 0..number % 3 {
            trace.notify(|| Note::Drawn { event: Event::Null, u: 0.5 });
        }
        sum += film;
        let lanes = film.extend(0.0).to_array();
        trace.notify(move || Note::Contribution {
            technique,
            emitted: lanes,
            other_density: 0.0,
            value: lanes,
            film,
        });
    }
    if number % 11 == 10 {
        sum = Vec3::INFINITY;
    }
    PathEstimate { rgb: sum, lookups: 0, exceeded: 0 }
}

fn probe(kernel: Kernel) -> Probe {
    let mut doc = SceneDoc::default();
    (doc.film.width, doc.film.height) = (5, 4);
    let scene = build(&doc, &mut Library::default()).unwrap();
    Probe::new(Arc::new(scene), kernel, Settings::new(&doc.estimator, 3))
}

fn film(probe: &Probe) -> Film {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    render(probe, &pool, Budget::Samples(SPP)).film
}

/// Layers and film count the same samples, whichever layer of a sample is not finite.
#[test]
fn layers_sum_to_the_film_where_samples_are_not_finite() {
    let probe = probe(occasionally_non_finite);
    let film = film(&probe);
    for split in Split::ALL {
        let parts = probe.strategies(split, 0..SPP, CancelToken::NEVER).unwrap();
        assert!(!parts.layers.is_empty());
        for (i, pixel) in film.pixels.iter().enumerate() {
            let sum: DVec3 = parts.layers.iter().map(|l| Vec3::from_array(l.mean[i]).as_dvec3()).sum();
            if i % 5 == 0 {
                assert!(pixel.count == 0 && sum.y.is_nan(), "a pixel without finite samples");
                continue;
            }
            assert!(pixel.count > 0 && pixel.count < SPP, "some samples are rejected: {}", pixel.count);
            for (c, mean) in pixel.mean.iter().enumerate() {
                assert!((sum[c] - mean).abs() < 1e-6 * mean.abs(), "{}: {sum} {mean}", split.name());
            }
            // Cov(X_k, X) sums to the variance of the same samples.
            let covariance: f64 = parts.layers.iter().map(|l| f64::from(l.covariance[i])).sum();
            let variance = variance_of_one(pixel);
            assert!((covariance - variance).abs() < 1e-5 * variance, "{covariance} {variance}");
        }
    }
}

fn variance_of_one(pixel: &Pixel) -> f64 {
    pixel.m2.iter().sum::<f64>() / (pixel.count - 1) as f64
}

#[test]
fn a_pixel_of_no_or_one_sample_has_no_covariance() {
    for n in [0, 1] {
        let mut sums = Sums::new(2);
        (0..n).for_each(|_| sums.add(&[DVec3::ONE, DVec3::splat(3.0)]));
        assert_eq!([sums.covariance(0), sums.covariance(1)], [0.0; 2]);
        assert_eq!(sums.mean(0)[0].is_nan(), n == 0);
    }
}
