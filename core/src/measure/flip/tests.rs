//! Tests of FLIP against its authors' evaluator, version 1.7.

use super::super::fixture::{Fixture, of_size, values};
use super::*;

/// Relative difference of the means of two maps, and their largest absolute difference.
fn compared(found: &[f32], expected: &[f32]) -> (f64, f64) {
    assert_eq!(found.len(), expected.len());
    let mean = |map: &[f32]| map.iter().map(|x| f64::from(*x)).sum::<f64>() / map.len() as f64;
    let largest = found.iter().zip(expected).map(|(p, q)| f64::from((p - q).abs())).fold(0.0, f64::max);
    (mean(found) / mean(expected) - 1.0, largest)
}

#[test]
fn maps_agree_with_the_authors_evaluator() {
    let fixture = Fixture::load();
    let shown = |pixels: &[[f32; 3]]| -> Vec<[f32; 3]> { pixels.iter().map(|p| clamped(*p)).collect() };
    let [picture, reference] = [&fixture.picture, &fixture.reference].map(|p| shown(p));
    let hdr = map(&fixture.picture(), &fixture.reference().picture).unwrap();
    let ldr = ldr(&of_size(&picture), &of_size(&reference)).unwrap();
    for (name, found, expected) in [
        ("HDR", hdr, values(include_bytes!("../../../../tests/measures/flip.npy"))),
        ("LDR", ldr, values(include_bytes!("../../../../tests/measures/flip_ldr.npy"))),
    ] {
        let (mean, largest) = compared(&found, &expected);
        assert!(mean.abs() < 1e-5, "{name}: the mean is off by {mean:e} of it");
        assert!(largest < 1e-4, "{name}: a pixel is off by {largest:e}");
    }
}

#[test]
fn exposures_are_the_evaluators() {
    let fixture = Fixture::load();
    let found = exposures(&fixture.reference);
    let expected = |what| fixture.expected("exposures", what);
    assert_eq!(found.len() as f64, expected("numExposures"));
    for (found, what) in [(found.first(), "startExposure"), (found.last(), "stopExposure")] {
        assert!((f64::from(*found.unwrap()) - expected(what)).abs() < 1e-5, "{what}: {found:?}");
    }
    assert!((f64::from(kernel::PIXELS_PER_DEGREE) - expected("ppd")).abs() < 1e-5);
}
