//! Tests of all measures against independent programs, and of their common properties.

use super::fixture::{Fixture, of_size};
use super::*;
use crate::math::Sampler;

fn assert_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    let off = (found / expected - 1.0).abs();
    assert!(off <= tolerance, "{what}: {found} is not {expected}, but {off:e} off");
}

fn measure(id: &str, picture: &Picture, reference: &ReferencePicture, region: Region) -> Measured {
    (find(id).unwrap().measure)(picture, reference, region).unwrap()
}

/// Standard normal random numbers, three per pixel.
fn noise(seed: u64, pixel: usize) -> [f64; 3] {
    let mut sampler = Sampler::new(seed, pixel as u64, 0);
    // The sum of twelve uniform numbers is close enough to normal here.
    [(); 3].map(|()| (0..12).map(|_| f64::from(sampler.next_1d())).sum::<f64>() - 6.0)
}

fn with_noise(pixels: &[[f32; 3]], sigma: impl Fn(usize) -> [f32; 3], seed: u64) -> Vec<[f32; 3]> {
    let noisy = |(i, p): (usize, &[f32; 3])| {
        let (s, xi) = (sigma(i), noise(seed, i));
        [0, 1, 2].map(|c| (f64::from(p[c]) + f64::from(s[c]) * xi[c]) as f32)
    };
    pixels.iter().enumerate().map(noisy).collect()
}

#[test]
fn values_agree_with_independent_programs() {
    let fixture = Fixture::load();
    let (picture, reference) = (fixture.picture(), fixture.reference());
    for m in MEASURES {
        for (of, region) in [("whole", Fixture::WHOLE), ("region", fixture.region())] {
            let found = (m.measure)(&picture, &reference, region).unwrap();
            assert_near(found.value, fixture.expected(of, m.id), 1e-5, &format!("{} of the {of}", m.id));
            assert_eq!((found.pixels, found.excluded), ((region.width() * region.height()) as u64, 0));
        }
    }
    for (of, region) in [("whole", Fixture::WHOLE), ("region", fixture.region())] {
        let [mse, rmse, relmse] =
            ["mse", "rmse", "relmse"].map(|id| measure(id, &picture, &reference, region));
        assert_near(mse.error, fixture.expected(of, "mse_error"), 1e-5, "standard error of MSE");
        assert_near(mse.reference_share, fixture.expected(of, "mse_share"), 1e-5, "share of MSE");
        assert_near(relmse.reference_share, fixture.expected(of, "relmse_share"), 1e-5, "share of relMSE");
        assert_near(rmse.error, mse.error / (2.0 * mse.value.sqrt()), 1e-9, "standard error of RMSE");
        assert_near(rmse.corrected().powi(2), mse.corrected(), 1e-9, "RMSE without the reference's share");
    }
}

#[test]
fn ids_are_found_and_unique() {
    for m in MEASURES {
        assert_eq!(find(m.id).map(|found| found.name), Some(m.name));
    }
    assert!(find("psnr").is_none());
}

#[test]
fn equal_pictures_differ_by_nothing() {
    let fixture = Fixture::load();
    let exact = ReferencePicture { standard_error: None, ..fixture.reference() };
    for m in MEASURES {
        let found = (m.measure)(&exact.picture, &exact, Fixture::WHOLE).unwrap();
        assert_eq!((found.value, found.error, found.reference_share), (0.0, 0.0, 0.0), "{}", m.id);
    }
}

#[test]
fn a_region_is_a_crop() {
    let fixture = Fixture::load();
    let region = fixture.region();
    let crop = |pixels: &[[f32; 3]]| -> Vec<[f32; 3]> {
        region.indices(Fixture::WIDTH, Fixture::HEIGHT).map(|i| pixels[i]).collect()
    };
    let (width, height) = (region.width(), region.height());
    let [a, r, e] = [&fixture.picture, &fixture.reference, &fixture.stderr].map(|pixels| crop(pixels));
    let picture = Picture { width, height, pixels: &a };
    let reference =
        ReferencePicture { picture: Picture { width, height, pixels: &r }, standard_error: Some(&e) };
    // FLIP depends on the surroundings of a region.
    for m in MEASURES.iter().filter(|m| m.id != "flip") {
        let of_region = (m.measure)(&fixture.picture(), &fixture.reference(), region).unwrap();
        let of_crop = (m.measure)(&picture, &reference, Region::whole(width, height)).unwrap();
        assert_eq!(of_region, of_crop, "{}", m.id);
    }
}

#[test]
fn what_is_not_finite_is_left_out_and_counted() {
    let mut fixture = Fixture::load();
    // Images that agree except for three damaged pixels: the remaining error is 0.
    fixture.reference = fixture.picture.clone();
    fixture.picture[100][1] = f32::NAN;
    fixture.reference[777][2] = f32::INFINITY;
    fixture.stderr[1500][0] = f32::NAN;
    for m in MEASURES {
        let found = (m.measure)(&fixture.picture(), &fixture.reference(), Fixture::WHOLE).unwrap();
        assert_eq!((found.pixels, found.excluded), (48 * 36 - 3, 3), "{}", m.id);
        assert_eq!(found.value, 0.0, "{}", m.id);
        // A region that contains one of them (row 2, column 4).
        let found = (m.measure)(&fixture.picture(), &fixture.reference(), Region::whole(10, 10)).unwrap();
        assert_eq!((found.pixels, found.excluded), (99, 1), "{}", m.id);
    }
}

#[test]
fn any_input_is_measured_or_refused() {
    let fixture = Fixture::load();
    let empty = Picture { width: 0, height: 0, pixels: &[] };
    let wide = Picture { width: 36, height: 48, pixels: &fixture.picture };
    let short = Picture { width: 48, height: 36, pixels: &fixture.picture[1..] };
    let overflowing = Picture { width: usize::MAX, height: 2, pixels: &fixture.picture };
    let extremes = [f32::MAX, -f32::MAX, 1e30, -1.0, f32::MIN_POSITIVE, f32::NAN, f32::INFINITY, 0.0];
    let wild: Vec<[f32; 3]> = (0..48 * 36).map(|i| [0, 1, 2].map(|c| extremes[(i + c) % 8])).collect();
    let reference = |picture| ReferencePicture { picture, standard_error: None };
    for m in MEASURES {
        let nothing = (m.measure)(&empty, &reference(empty), Region::whole(3, 3)).unwrap();
        assert!(nothing.value.is_nan() && nothing.corrected().is_nan());
        assert_eq!((nothing.pixels, nothing.reference_share), (0, 0.0));
        let far = Region { x0: 90, y0: 90, x1: 99, y1: 99 };
        let outside = (m.measure)(&fixture.picture(), &fixture.reference(), far).unwrap();
        assert!(outside.value.is_nan() && outside.pixels == 0 && outside.error.is_infinite(), "{}", m.id);

        let refused = (m.measure)(&wide, &fixture.reference(), Fixture::WHOLE).unwrap_err();
        assert_eq!(
            refused.to_string(),
            "the image has 36 × 48 pixels, but the reference 48 × 36: render both at the same size"
        );
        for bad in [short, overflowing] {
            assert!((m.measure)(&bad, &fixture.reference(), Fixture::WHOLE).is_err());
            assert!((m.measure)(&fixture.picture(), &reference(bad), Fixture::WHOLE).is_err());
        }
        let noise = &fixture.stderr[1..];
        let bad = ReferencePicture { standard_error: Some(noise), ..fixture.reference() };
        assert!((m.measure)(&fixture.picture(), &bad, Fixture::WHOLE).is_err());

        for (a, r) in [(&wild, &fixture.reference), (&fixture.picture, &wild), (&wild, &wild)] {
            let found = (m.measure)(&of_size(a), &reference(of_size(r)), Fixture::WHOLE).unwrap();
            assert!(found.value.is_finite() && found.value >= 0.0, "{}: {found:?}", m.id);
            assert!(found.pixels > 0 && found.excluded > 0);
        }
    }
}

/// Squared errors can be debiased exactly: for a perfect image only chance remains.
#[test]
fn the_references_noise_does_not_count_against_a_perfect_picture() {
    let fixture = Fixture::load();
    let truth = &fixture.reference;
    let seeds = 200u32;
    // Not clamped at 0, which would bias the mean.
    let corrected: Vec<f64> = (0..seeds)
        .map(|seed| {
            let noisy = with_noise(truth, |i| fixture.stderr[i], u64::from(seed));
            let reference =
                ReferencePicture { picture: of_size(&noisy), standard_error: Some(&fixture.stderr) };
            let found = measure("mse", &of_size(truth), &reference, Fixture::WHOLE);
            assert!(found.corrected() < 0.3 * found.value);
            found.value - found.reference_share
        })
        .collect();
    let mean = corrected.iter().sum::<f64>() / f64::from(seeds);
    let scatter = corrected.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / f64::from(seeds - 1);
    let error = (scatter / f64::from(seeds)).sqrt();
    assert!(mean.abs() < 4.0 * error, "{mean:e} ± {error:e}");
    let share = measure("mse", &of_size(truth), &fixture.reference(), Fixture::WHOLE).reference_share;
    assert!(error < 0.01 * share, "sees too little: {error:e} of {share:e}");
}

/// For a noisy image, every corrected measure is closer to its value against the true reference.
#[test]
fn correction_helps_where_both_are_noisy() {
    let fixture = Fixture::load();
    let truth = &fixture.reference;
    let twice = |i: usize| fixture.stderr[i].map(|s| 2.0 * s);
    for id in ["mse", "rmse", "relmse", "mae", "smape"] {
        let (mut off, mut corrected_off) = (0.0, 0.0);
        for seed in 0..20 {
            let picture = with_noise(truth, twice, 2 * seed);
            let noisy = with_noise(truth, |i| fixture.stderr[i], 2 * seed + 1);
            let exact = ReferencePicture { picture: of_size(truth), standard_error: None };
            let against_truth = measure(id, &of_size(&picture), &exact, Fixture::WHOLE);
            assert_eq!(against_truth.reference_share, 0.0);
            let reference =
                ReferencePicture { picture: of_size(&noisy), standard_error: Some(&fixture.stderr) };
            let found = measure(id, &of_size(&picture), &reference, Fixture::WHOLE);
            off += (found.value / against_truth.value - 1.0) / 20.0;
            corrected_off += (found.corrected() / against_truth.value - 1.0) / 20.0;
        }
        assert!(off > 0.04, "{id}: the noise adds {off}");
        assert!(corrected_off.abs() < 0.4 * off, "{id}: {corrected_off} remains of {off}");
    }
}

#[test]
fn values_fall_with_samples_as_the_slope_says() {
    let fixture = Fixture::load();
    let exact = ReferencePicture { standard_error: None, ..fixture.reference() };
    for m in MEASURES {
        let value = |samples: f32| {
            let sigma = |i: usize| fixture.stderr[i].map(|s| s * samples.sqrt().recip());
            let picture = with_noise(&fixture.reference, sigma, 1);
            (m.measure)(&of_size(&picture), &exact, Fixture::WHOLE).unwrap().value
        };
        let slope = (value(1024.0) / value(64.0)).ln() / 16.0f64.ln();
        assert!((slope - m.slope).abs() < 0.05, "{}: {slope}", m.id);
    }
}
