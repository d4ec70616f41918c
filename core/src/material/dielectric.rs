//! The boundary of a transparent body: reflection and refraction by Fresnel's equations, smooth or by GGX
//! microfacets.

use super::Ggx;
use crate::spectrum::Spectrum;

/// Dielectric.
#[derive(Clone, Debug)]
pub struct Dielectric {
    /// Refractive index of the body.
    pub ior: Spectrum,
    /// Distribution of microfacets; `None` for a smooth surface.
    pub ggx: Option<Ggx>,
}
