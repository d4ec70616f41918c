//! Mean absolute error.

use super::average::average;
use super::replicate::added_by_noise;
use super::{Measure, MeasureError, Measured, Picture, ReferencePicture, Region};

/// Mean absolute error.
pub(super) const MEASURE: Measure = Measure {
    id: "mae",
    name: "MAE",
    formula: "mean of |A − R|",
    doc: "As the root of the mean squared error, but one firefly counts no more than it is bright.",
    measure: mae,
    slope: -0.5,
};

/// MAE = mean |A − R|, radiance. `reference_share` is the mean of |A − R′| − |A − R| with one noisier
/// reference R′ = R + σξ of fixed seed, not below 0.
///
/// # Errors
/// Picture and reference differ in size.
fn mae(picture: &Picture, reference: &ReferencePicture, region: Region) -> Result<Measured, MeasureError> {
    let distance = |a: f64, r: f64| (a - r).abs();
    let found = average(picture, reference, region, |c| (distance(c.a, c.r), added_by_noise(c, distance)))?;
    Ok(Measured { reference_share: found.reference_share.max(0.0), ..found })
}
