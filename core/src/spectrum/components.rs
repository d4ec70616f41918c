//! Components of a path: wavelengths or colour channels.

use super::{Sampled, Spectrum, WavelengthSampling};
use glam::Vec3;
use std::ops::{AddAssign, Mul};

/// The `N` components of a path, component 0 being the hero.
///
/// The set is symmetric: rotating it makes another member the hero with the same probability, so the balance
/// heuristic can average over possible heroes (Wilkie et al. 2014).
pub trait Components<const N: usize>: Copy + Send + Sync {
    /// Radiance carried by a path.
    type Radiance: Radiance<N>;

    /// Samples the set from a number uniform in [0, 1). `wavelengths` selects the distribution of
    /// wavelengths; `None` in RGB mode.
    fn sample(u: f32, wavelengths: Option<WavelengthSampling>) -> Self;

    /// Evaluates a coefficient (extinction, albedo) at the components.
    fn evaluate(&self, spectrum: &Spectrum) -> Sampled<N>;

    /// Evaluates a coefficient given as linear sRGB at the components.
    fn upsample(&self, rgb: Vec3) -> Sampled<N>;

    /// Evaluates a radiance spectrum at the components.
    fn radiance(&self, spectrum: &Spectrum) -> Self::Radiance;

    /// Evaluates a radiance given as linear sRGB at the components.
    fn radiance_of_rgb(&self, rgb: Vec3) -> Self::Radiance;

    /// Evaluates the radiance of a black body at a temperature in kelvins.
    fn blackbody(&self, kelvin: f32) -> Self::Radiance;

    /// Describes the components for display.
    fn carried(&self) -> Carried;

    /// Converts radiance at the components to its estimate of linear sRGB.
    fn to_film(&self, radiance: Self::Radiance) -> Vec3;
}

/// Radiance of a path, weighted component by component.
pub trait Radiance<const N: usize>: Copy + AddAssign + Mul<Sampled<N>, Output = Self> {
    /// Zero radiance.
    const BLACK: Self;

    /// Values per component, or per film channel for grey paths.
    fn lanes(&self) -> Lanes;
}

/// Values at the components of a path, at most four; the hero first, zero beyond the last.
pub type Lanes = [f32; 4];

/// Description of the components of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Carried {
    /// Wavelengths in nanometres, and their number.
    Wavelengths(Lanes, usize),
    /// Film channels, 0 to 2, and their number.
    Channels(Lanes, usize),
    /// One weight for all wavelengths: an achromatic path, whose radiance is in film channels.
    Grey,
}

impl Carried {
    /// Number of components with separate weights.
    #[must_use]
    pub fn count(&self) -> usize {
        match self {
            Self::Wavelengths(_, n) | Self::Channels(_, n) => *n,
            Self::Grey => 1,
        }
    }
}

impl<const N: usize> Radiance<N> for Sampled<N> {
    const BLACK: Self = Self::ZERO;

    fn lanes(&self) -> Lanes {
        Sampled::lanes(*self)
    }
}
