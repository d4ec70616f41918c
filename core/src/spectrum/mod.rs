//! Wavelengths, colours and what lies between them.
//!
//! A path carries a few *components*: in spectral mode wavelengths (the hero and its rotations), in
//! RGB mode the three channels, in independent tracking only one of either. Everything downstream is
//! generic over [`Components`], so both modes are the same code.

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

/// The shortest wavelength that is rendered, in nanometres.
pub const LAMBDA_MIN_NM: f32 = 360.0;
/// The longest wavelength that is rendered, in nanometres.
pub const LAMBDA_MAX_NM: f32 = 830.0;
/// The width of the rendered range, in nanometres.
pub const LAMBDA_RANGE_NM: f32 = LAMBDA_MAX_NM - LAMBDA_MIN_NM;
