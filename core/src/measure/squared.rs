//! Squared errors: mean squared error, its root, and relative mean squared error.

use super::average::average;
use super::{Measure, MeasureError, Measured, Picture, ReferencePicture, Region};

/// Mean squared error.
pub(super) const MSE: Measure = Measure {
    id: "mse",
    name: "MSE",
    formula: "mean of (A − R)² over pixels and the three linear channels",
    doc: "Variance plus squared bias: the error of theory, but dominated by single bright pixels.",
    measure: mse,
    slope: -1.0,
};

/// MSE = mean (A − R)², in radiance². A reference of variance σ² adds σ² to its expectation, so
/// `reference_share` is the mean of σ².
///
/// # Errors
/// When image and reference differ in size.
fn mse(picture: &Picture, reference: &ReferencePicture, region: Region) -> Result<Measured, MeasureError> {
    average(picture, reference, region, |c| ((c.a - c.r).powi(2), c.noise * c.noise))
}

/// Root of the mean squared error.
pub(super) const RMSE: Measure = Measure {
    id: "rmse",
    name: "RMSE",
    formula: "√MSE = square root of the mean of (A − R)²",
    doc: "Mean squared error in the unit of the image.",
    measure: rmse,
    slope: -0.5,
};

/// RMSE = √MSE, in radiance. The error follows by the delta method, σ(√m) = σ(m)/(2√m); `reference_share` is
/// the change of the root when the mean of σ² is subtracted under it.
///
/// # Errors
/// When image and reference differ in size.
fn rmse(picture: &Picture, reference: &ReferencePicture, region: Region) -> Result<Measured, MeasureError> {
    let mse = (MSE.measure)(picture, reference, region)?;
    let value = mse.value.sqrt();
    // Avoids 0/0 where the images agree, and ∞/NaN where no pixel was counted.
    let known = mse.error > 0.0 && mse.error.is_finite();
    let error = if known { mse.error / (2.0 * value) } else { mse.error };
    let without = (mse.value - mse.reference_share).max(0.0).sqrt();
    let reference_share = if mse.pixels == 0 { 0.0 } else { value - without };
    Ok(Measured { value, error, reference_share, ..mse })
}

/// Limits the influence of black pixels (Rousselle, Knaus and Zwicker 2011).
const EPSILON: f64 = 0.01;

/// Relative mean squared error.
pub(super) const RELMSE: Measure = Measure {
    id: "relmse",
    name: "relMSE",
    formula: "mean of (A − R)² / (R² + ε), ε = 0.01",
    doc: "Squared error relative to brightness, as perceived: noise in dark and bright pixels counts alike.",
    measure: relmse,
    slope: -1.0,
};

/// relMSE = mean (A − R)²/(R² + ε) with ε = 0.01, dimensionless (F. Rousselle, C. Knaus, M. Zwicker,
/// "Adaptive Sampling and Reconstruction using Greedy Error Minimization", SIGGRAPH Asia 2011).
/// `reference_share` is the mean of σ²/(R² + ε): the noise of the denominator is neglected.
///
/// # Errors
/// When image and reference differ in size.
fn relmse(picture: &Picture, reference: &ReferencePicture, region: Region) -> Result<Measured, MeasureError> {
    average(picture, reference, region, |c| {
        let scale = c.r * c.r + EPSILON;
        ((c.a - c.r).powi(2) / scale, c.noise * c.noise / scale)
    })
}
