//! Symmetric mean absolute percentage error.

use super::average::average;
use super::replicate::added_by_noise;
use super::{Measure, MeasureError, Measured, Picture, ReferencePicture, Region};

/// Keeps black pixels from being wholly wrong for nothing (Vogels et al. 2018).
const EPSILON: f64 = 0.01;

/// Symmetric mean absolute percentage error.
pub(super) const MEASURE: Measure = Measure {
    id: "smape",
    name: "SMAPE",
    formula: "mean of |A − R| / (|A| + |R| + ε), ε = 0.01",
    doc: "Relative error between 0 and 1: no pixel, however wrong, can decide it alone.",
    measure: smape,
    slope: -0.5,
};

/// SMAPE = mean |A − R|/(|A| + |R| + ε) with ε = 0.01, between 0 and 1 (T. Vogels et al., "Denoising with
/// Kernel Prediction and Asymmetric Loss Functions", SIGGRAPH 2018). Elsewhere it is defined as twice that.
/// `reference_share` is found as for the mean absolute error, with one noisier reference of fixed seed.
///
/// # Errors
/// Picture and reference differ in size.
fn smape(picture: &Picture, reference: &ReferencePicture, region: Region) -> Result<Measured, MeasureError> {
    let distance = |a: f64, r: f64| (a - r).abs() / (a.abs() + r.abs() + EPSILON);
    let found = average(picture, reference, region, |c| (distance(c.a, c.r), added_by_noise(c, distance)))?;
    Ok(Measured { reference_share: found.reference_share.max(0.0), ..found })
}
