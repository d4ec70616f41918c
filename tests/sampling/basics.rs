//! Random numbers, directions, components and events.

use glam::Vec3;
use majorant_core::math::{INV_4PI, Sampler, cosine_direction, uniform_direction};
use majorant_core::medium::{Coefficients, MajorantSegment};
use majorant_core::scene::Absorption;
use majorant_core::spectrum::{
    Components, LAMBDA_MAX_NM, LAMBDA_MIN_NM, LAMBDA_RANGE_NM, RgbChannels, Sampled, WavelengthSampling,
    Wavelengths,
};
use majorant_core::transport::{CancelToken, Collision, Event, Trace};
use majorant_tests::chi2::Family;
use std::f32::consts::FRAC_1_PI;

const SAMPLES: u64 = 200_000;

#[test]
fn numbers_are_uniform_and_optical_depths_exponential() {
    let mut family = Family::default();
    let mut one = Sampler::new(1, 0, 0);
    family.uniform("one stream", (0..SAMPLES).map(|_| f64::from(one.next_1d())));
    family.uniform("second of a pair", (0..SAMPLES).map(|_| f64::from(one.next_2d().y)));
    let depths = (0..SAMPLES).map(|_| 1.0 - (-f64::from(one.next_optical_depth())).exp());
    family.uniform("optical depth", depths);
    // A path uses the first few numbers of its own stream.
    let later = |skip: usize| {
        (0..SAMPLES).map(move |i| {
            let mut stream = Sampler::new(2, i % 200, i / 200);
            for _ in 0..skip {
                stream.next_1d();
            }
            f64::from(stream.next_1d())
        })
    };
    for skip in [0, 1, 5] {
        family.uniform(&format!("number {skip} of every stream"), later(skip));
    }
    family.judge();
}

#[test]
fn directions_are_uniform_and_cosine_weighted() {
    let mut family = Family::default();
    let mut sampler = Sampler::new(3, 0, 0);
    family.directions("uniform", || uniform_direction(sampler.next_2d()), |_| INV_4PI);
    let cosine = |d: Vec3| d.z.max(0.0) * FRAC_1_PI;
    family.directions("cosine", || cosine_direction(sampler.next_2d()), cosine);
    family.judge();
}

fn wavelengths<const N: usize>(family: &mut Family) {
    let mut sampler = Sampler::new(4, N as u64, 0);
    let uniform = WavelengthSampling::Uniform;
    let sets: Vec<_> =
        (0..SAMPLES).map(|_| Wavelengths::<N>::sample(sampler.next_1d(), Some(uniform))).collect();
    for i in 0..N {
        let over_range = sets.iter().map(|set| {
            assert!((LAMBDA_MIN_NM..=LAMBDA_MAX_NM).contains(&set.lambda_nm[i]));
            f64::from((set.lambda_nm[i] - LAMBDA_MIN_NM) / LAMBDA_RANGE_NM)
        });
        family.uniform(&format!("wavelength {i} of {N}"), over_range);
    }
}

fn channels<const N: usize>(family: &mut Family) {
    let mut sampler = Sampler::new(5, N as u64, 0);
    let mut counts = [0; 3];
    for _ in 0..SAMPLES {
        let set = RgbChannels::<N>::sample(sampler.next_1d(), Some(WavelengthSampling::Uniform));
        counts[set.channel[0]] += 1;
        assert!((1..N).all(|i| set.channel[i] == (set.channel[0] + i) % 3), "{set:?} is no rotation");
    }
    family.counts(&format!("hero of {N} channels"), &counts, &[1.0 / 3.0; 3]);
}

#[test]
fn every_component_is_uniform() {
    let mut family = Family::default();
    wavelengths::<1>(&mut family);
    wavelengths::<4>(&mut family);
    channels::<1>(&mut family);
    channels::<3>(&mut family);
    family.judge();
}

/// Probabilities of null collision, scattering and absorption at a collision.
fn shares([t, albedo, m]: [f64; 3], absorption: Absorption) -> [f64; 3] {
    let k = 1.0 / (t + (m - t).abs());
    let (scattering, absorbed) = match absorption {
        Absorption::Analogue => (t * albedo, t * (1.0 - albedo)),
        Absorption::Weighted | Absorption::Roulette => (t, 0.0),
    };
    [(m - t).abs() * k, scattering * k, absorbed * k]
}

#[test]
fn events_come_as_often_as_their_densities_say() {
    let mut family = Family::default();
    // Extinction, albedo and majorant: bounding, loose, tight, and exceeded.
    let cases = [[3.0, 0.75, 5.0], [0.5, 0.5, 5.0], [5.0, 0.75, 5.0], [8.0, 0.75, 5.0], [20.0, 0.25, 5.0]];
    let ends = [[5.0, 0.0, 5.0], [5.0, 1.0, 5.0], [0.0, 0.5, 5.0], [4.0, 0.998, 5.0]];
    for (seed, case) in (0..).zip(cases.into_iter().chain(ends)) {
        for absorption in [Absorption::Analogue, Absorption::Weighted] {
            // The other component must not affect the event.
            let [extinction, albedo, majorant] =
                [(case[0], 9.0), (case[1], 0.3), (case[2], 1.0)].map(|(x, other)| Sampled([x as f32, other]));
            let segment = MajorantSegment { t0: 0.0, t1: 1.0, majorant, clamp_null: false, watched: false };
            let coefficients = Coefficients::new(extinction, albedo, &segment);
            let collision = Collision::new(Vec3::ZERO, coefficients, absorption.into());
            let mut trace = Trace::new(Sampler::new(6, seed, 0), CancelToken::NEVER);
            let mut counts = [0; 3];
            for _ in 0..SAMPLES {
                counts[match collision.draw_event(&mut trace) {
                    Event::Null => 0,
                    Event::Scattering => 1,
                    Event::Absorption => 2,
                }] += 1;
            }
            family.counts(&format!("{case:?} {absorption:?}"), &counts, &shares(case, absorption));
        }
    }
    family.judge();
}
