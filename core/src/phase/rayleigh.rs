//! Rayleigh scattering by molecules: p(cos θ) = 3/(16π) (1 + cos² θ).

use super::Lobe;
use crate::math::PolarAngle;
use std::f32::consts::PI;

#[derive(Clone, Copy, Debug)]
pub(super) struct Rayleigh;

impl Lobe for Rayleigh {
    #[inline]
    fn value(&self, theta: PolarAngle) -> f32 {
        let cosine = theta.cos();
        3.0 / (16.0 * PI) * (1.0 + cosine * cosine)
    }

    /// Inverts the cumulative distribution, a cubic in cos θ, by Cardano's formula (Frisvad 2011).
    #[inline]
    fn sample(&self, u: f32) -> PolarAngle {
        let z = 2.0 * (2.0 * u - 1.0);
        let root = (z * z + 1.0).sqrt();
        let cosine = (root + z).cbrt() - (root - z).cbrt();
        PolarAngle::from_one_minus_cos(1.0 - cosine.clamp(-1.0, 1.0))
    }

    #[inline]
    fn mean_cosine(&self) -> f32 {
        0.0
    }
}
