//! Relative mean squared error.

use super::average::average;
use super::{Measure, MeasureError, Measured, Picture, ReferencePicture, Region};

/// Keeps black pixels from deciding everything (Rousselle, Knaus and Zwicker 2011).
const EPSILON: f64 = 0.01;

/// Relative mean squared error.
pub(super) const MEASURE: Measure = Measure {
    id: "relmse",
    name: "relMSE",
    formula: "mean of (A − R)² / (R² + ε), ε = 0.01",
    doc: "Squared error as the eye weighs it: a dark pixel's noise counts as much as a bright one's.",
    measure: relmse,
    slope: -1.0,
};

/// relMSE = mean (A − R)²/(R² + ε) with ε = 0.01, without unit (F. Rousselle, C. Knaus, M. Zwicker, "Adaptive
/// Sampling and Reconstruction using Greedy Error Minimization", SIGGRAPH Asia 2011). `reference_share` is
/// the mean of σ²/(R² + ε): the denominator's own noise is neglected.
///
/// # Errors
/// Picture and reference differ in size.
fn relmse(picture: &Picture, reference: &ReferencePicture, region: Region) -> Result<Measured, MeasureError> {
    average(picture, reference, region, |c| {
        let scale = c.r * c.r + EPSILON;
        ((c.a - c.r).powi(2) / scale, c.noise * c.noise / scale)
    })
}
