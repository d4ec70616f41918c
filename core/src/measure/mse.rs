//! Mean squared error.

use super::average::average;
use super::{Measure, MeasureError, Measured, Picture, ReferencePicture, Region};

/// Mean squared error.
pub(super) const MEASURE: Measure = Measure {
    id: "mse",
    name: "MSE",
    formula: "mean of (A − R)² over pixels and the three linear channels",
    doc: "Variance plus squared bias: what theory speaks of, and what one bright pixel decides.",
    measure: mse,
    slope: -1.0,
};

/// MSE = mean (A − R)², radiance². A reference of variance σ² adds σ² to its expectation, so
/// `reference_share` is the mean of σ².
///
/// # Errors
/// Picture and reference differ in size.
fn mse(picture: &Picture, reference: &ReferencePicture, region: Region) -> Result<Measured, MeasureError> {
    average(picture, reference, region, |c| ((c.a - c.r).powi(2), c.noise * c.noise))
}
