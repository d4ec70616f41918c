//! Lambertian reflection: radiance albedo/π times the irradiance, in all directions and on both sides.

use crate::spectrum::Spectrum;

/// Diffuse material.
#[derive(Clone, Debug)]
pub struct Diffuse {
    /// Reflected fraction of the incident light, 0 to 1.
    pub albedo: Spectrum,
}
