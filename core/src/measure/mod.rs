//! Error measures of a picture against a reference: one measure is one file and one line of [`MEASURES`].
//!
//! A measure averages over the pixels of a [`Region`]. It tells apart what it saw (`value`, what anybody
//! gets from the plain formula), how well the pixels determine that (`error`), and how much of it is owed
//! to a reference that was itself rendered (`reference_share`).

mod average;
mod error;
pub mod flip;
mod mae;
mod measured;
mod mse;
mod picture;
mod region;
mod relmse;
mod replicate;
mod rmse;
mod smape;

#[cfg(test)]
mod fixture;
#[cfg(test)]
mod properties;

pub use error::MeasureError;
pub use measured::Measured;
pub use picture::{Picture, ReferencePicture};
pub use region::Region;

/// The function that computes a measure.
pub type MeasureFn = fn(&Picture, &ReferencePicture, Region) -> Result<Measured, MeasureError>;

/// One way to say how far a picture is from its reference.
#[derive(Clone, Copy, Debug)]
pub struct Measure {
    /// Name in files and on the command line.
    pub id: &'static str,
    /// Name on screen.
    pub name: &'static str,
    /// What is averaged, in one line.
    pub formula: &'static str,
    /// What it is good for, in one sentence.
    pub doc: &'static str,
    /// Computes it.
    pub measure: MeasureFn,
    /// Slope of log(value) against log(samples) that unbiased Monte Carlo tends to.
    pub slope: f64,
}

/// Every measure.
pub static MEASURES: &[Measure] =
    &[mse::MEASURE, rmse::MEASURE, relmse::MEASURE, mae::MEASURE, smape::MEASURE, flip::MEASURE];

/// The measure of that id.
#[must_use]
pub fn find(id: &str) -> Option<&'static Measure> {
    MEASURES.iter().find(|m| m.id == id)
}
