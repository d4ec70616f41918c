//! Spectra, wavelengths and colour.
//!
//! A path carries a few *components*: wavelengths in spectral mode (the hero and its rotations), the three
//! channels in RGB mode, and only one of either in independent tracking. All code downstream is generic over
//! [`Components`], so both modes share it.

mod blackbody;
mod combined;
mod components;
mod doc;
mod grey;
mod observer;
mod polyline;
pub mod presets;
mod rgb_channels;
mod sampled;
mod shape;
mod wavelengths;

pub use blackbody::HOTTEST_K;
pub use combined::Rule;
pub use components::{Carried, Components, Lanes, Radiance};
pub use doc::{ControlPoint, Outside, SpectrumDoc};
pub use grey::{FilmColour, Grey};
pub use observer::{response, wavelength_colour};
pub use rgb_channels::RgbChannels;
pub use sampled::Sampled;
pub use shape::{Quantity, Spectrum};
pub use wavelengths::{WavelengthSampling, Wavelengths};

/// Shortest rendered wavelength, in nanometres.
pub const LAMBDA_MIN_NM: f32 = 360.0;
/// Longest rendered wavelength, in nanometres.
pub const LAMBDA_MAX_NM: f32 = 830.0;
/// Width of the rendered range, in nanometres.
pub const LAMBDA_RANGE_NM: f32 = LAMBDA_MAX_NM - LAMBDA_MIN_NM;
