//! Absolute errors: mean absolute error, and symmetric mean absolute percentage error.

use super::average::average;
use super::replicate::added_by_noise;
use super::{Measure, MeasureError, Measured, Picture, ReferencePicture, Region};

/// Mean absolute error.
pub(super) const MAE: Measure = Measure {
    id: "mae",
    name: "MAE",
    formula: "mean of |A − R|",
    doc: "Like the root mean squared error, but fireflies count linearly.",
    measure: mae,
    slope: -0.5,
};

/// MAE = mean |A − R|, in radiance. `reference_share` is the mean of |A − R′| − |A − R| with one noisier
/// reference R′ = R + σξ of fixed seed, at least 0.
///
/// # Errors
/// When image and reference differ in size.
fn mae(picture: &Picture, reference: &ReferencePicture, region: Region) -> Result<Measured, MeasureError> {
    let distance = |a: f64, r: f64| (a - r).abs();
    let found = average(picture, reference, region, |c| (distance(c.a, c.r), added_by_noise(c, distance)))?;
    Ok(Measured { reference_share: found.reference_share.max(0.0), ..found })
}

/// Avoids errors of 1 at nearly black pixels (Vogels et al. 2018).
const EPSILON: f64 = 0.01;

/// Symmetric mean absolute percentage error.
pub(super) const SMAPE: Measure = Measure {
    id: "smape",
    name: "SMAPE",
    formula: "mean of |A − R| / (|A| + |R| + ε), ε = 0.01",
    doc: "Relative error between 0 and 1, which no single pixel can dominate.",
    measure: smape,
    slope: -0.5,
};

/// SMAPE = mean |A − R|/(|A| + |R| + ε) with ε = 0.01, between 0 and 1 (T. Vogels et al., "Denoising with
/// Kernel Prediction and Asymmetric Loss Functions", SIGGRAPH 2018). Other definitions are twice as large.
/// `reference_share` is estimated as for the mean absolute error, with one noisier reference of fixed seed.
///
/// # Errors
/// When image and reference differ in size.
fn smape(picture: &Picture, reference: &ReferencePicture, region: Region) -> Result<Measured, MeasureError> {
    let distance = |a: f64, r: f64| (a - r).abs() / (a.abs() + r.abs() + EPSILON);
    let found = average(picture, reference, region, |c| (distance(c.a, c.r), added_by_noise(c, distance)))?;
    Ok(Measured { reference_share: found.reference_share.max(0.0), ..found })
}
