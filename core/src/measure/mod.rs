//! Error measures of an image against a reference: one entry of [`MEASURES`] each.
//!
//! A measure averages over the pixels of a [`Region`]. It returns the value of the plain formula (`value`),
//! its standard error over pixels (`error`), and the part due to the noise of a rendered reference
//! (`reference_share`).

mod absolute;
mod average;
mod error;
pub mod flip;
mod measured;
mod picture;
mod region;
mod replicate;
mod squared;

#[cfg(test)]
mod fixture;
#[cfg(test)]
mod properties;

pub use error::MeasureError;
pub use measured::Measured;
pub use picture::{Picture, ReferencePicture};
pub use region::Region;

/// Function that computes a measure.
pub type MeasureFn = fn(&Picture, &ReferencePicture, Region) -> Result<Measured, MeasureError>;

/// An error measure between an image and its reference.
#[derive(Clone, Copy, Debug)]
pub struct Measure {
    /// Id in files and on the command line.
    pub id: &'static str,
    /// Display name.
    pub name: &'static str,
    /// One-line formula.
    pub formula: &'static str,
    /// One-sentence description of its use.
    pub doc: &'static str,
    /// Function that computes it.
    pub measure: MeasureFn,
    /// Slope of log(value) against log(samples) for unbiased Monte Carlo, in the limit.
    pub slope: f64,
}

/// All measures.
pub static MEASURES: &[Measure] =
    &[squared::MSE, squared::RMSE, squared::RELMSE, absolute::MAE, absolute::SMAPE, flip::MEASURE];

/// Returns the measure with this id.
#[must_use]
pub fn find(id: &str) -> Option<&'static Measure> {
    MEASURES.iter().find(|m| m.id == id)
}
