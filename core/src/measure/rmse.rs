//! Root of the mean squared error.

use super::{Measure, MeasureError, Measured, Picture, ReferencePicture, Region, mse};

/// Root of the mean squared error.
pub(super) const MEASURE: Measure = Measure {
    id: "rmse",
    name: "RMSE",
    formula: "√MSE = square root of the mean of (A − R)²",
    doc: "The mean squared error in the unit of the picture.",
    measure: rmse,
    slope: -0.5,
};

/// RMSE = √MSE, radiance. The error follows by the delta method, σ(√m) = σ(m)/(2√m); `reference_share` is
/// what taking the mean of σ² from under the root removes.
///
/// # Errors
/// Picture and reference differ in size.
fn rmse(picture: &Picture, reference: &ReferencePicture, region: Region) -> Result<Measured, MeasureError> {
    let mse = (mse::MEASURE.measure)(picture, reference, region)?;
    let value = mse.value.sqrt();
    // Not 0/0 where the pictures agree, nor ∞/NaN where nothing was counted.
    let known = mse.error > 0.0 && mse.error.is_finite();
    let error = if known { mse.error / (2.0 * value) } else { mse.error };
    let without = (mse.value - mse.reference_share).max(0.0).sqrt();
    let reference_share = if mse.pixels == 0 { 0.0 } else { value - without };
    Ok(Measured { value, error, reference_share, ..mse })
}
