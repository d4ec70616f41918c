//! What the components of a path stand for.

use super::{Sampled, Spectrum, WavelengthSampling};
use glam::Vec3;
use std::ops::{AddAssign, Mul};

/// The `N` components that one path carries, component 0 being the hero.
///
/// The set is symmetric: rotating it makes another member the hero with the same probability, which is
/// what lets the balance heuristic average over possible heroes (Wilkie et al. 2014).
pub trait Components<const N: usize>: Copy + Send + Sync {
    /// Radiance as a path gathers it.
    type Radiance: Radiance<N>;

    /// Draws the set from a number uniform in [0, 1).
    fn sample(u: f32, wavelengths: WavelengthSampling) -> Self;

    /// A coefficient (extinction, albedo) at the components.
    fn evaluate(&self, spectrum: &Spectrum) -> Sampled<N>;

    /// A coefficient that is given as linear sRGB, at the components.
    fn upsample(&self, rgb: Vec3) -> Sampled<N>;

    /// Radiance at the components.
    fn radiance(&self, spectrum: &Spectrum) -> Self::Radiance;

    /// Radiance that is given as linear sRGB, at the components.
    fn radiance_of_rgb(&self, rgb: Vec3) -> Self::Radiance;

    /// Radiance of a black body of so many kelvins, at the components.
    fn blackbody(&self, kelvin: f32) -> Self::Radiance;

    /// What they are.
    fn carried(&self) -> Carried;

    /// The linear sRGB estimate that radiance at the components amounts to.
    fn to_film(&self, radiance: Self::Radiance) -> Vec3;
}

/// Radiance that a path gathers, to be weighted component by component.
pub trait Radiance<const N: usize>: Copy + AddAssign + Mul<Sampled<N>, Output = Self> {
    /// No light.
    const BLACK: Self;

    /// Its numbers: one per component, or those of the film.
    fn lanes(&self) -> Lanes;
}

/// Values at the components of a path, of which there are at most four; the hero's first, zero beyond the last.
pub type Lanes = [f32; 4];

/// What the components of a path stand for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Carried {
    /// Wavelengths in nanometres: so many of these.
    Wavelengths(Lanes, usize),
    /// Channels of the film, 0 to 2: so many of these.
    Channels(Lanes, usize),
    /// One weight for all: nothing has a colour, and what a path gathers is in the colours of the film.
    Grey,
}

impl Carried {
    /// Components that have weights of their own.
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
