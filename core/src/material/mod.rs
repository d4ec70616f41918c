//! Materials: how surfaces scatter light.
//!
//! A diffuse surface reflects with one lobe for all components. The others have lobes that depend on the
//! component: [`Scatterer`] gives them at the components of a path, in the frame of the surface.

mod conductor;
mod dielectric;
mod diffuse;
pub mod fresnel;
mod ggx;
mod mirror;
mod scatterer;
mod thin_dielectric;

pub use conductor::{Conductor, Metal};
pub use dielectric::Dielectric;
pub use diffuse::Diffuse;
pub use ggx::{Ggx, SMOOTH};
pub use mirror::Mirror;
pub use scatterer::{Scattered, Scatterer};
pub use thin_dielectric::ThinDielectric;

use crate::spectrum::Spectrum;

/// Material of a surface.
#[derive(Clone, Debug)]
pub enum Material {
    /// Lambertian reflection.
    Diffuse(Diffuse),
    /// Reflection in one direction.
    Mirror(Mirror),
    /// A metal, smooth or rough.
    Conductor(Conductor),
    /// The boundary of a transparent body, smooth or rough.
    Dielectric(Dielectric),
    /// A thin pane.
    ThinDielectric(ThinDielectric),
}

impl Material {
    /// Returns whether the material is independent of wavelength.
    #[must_use]
    pub fn is_achromatic(&self) -> bool {
        let flat = |spectra: &[&Spectrum]| spectra.iter().all(|spectrum| spectrum.is_flat());
        match self {
            Self::Diffuse(diffuse) => flat(&[&diffuse.albedo]),
            Self::Mirror(mirror) => flat(&[&mirror.reflectance]),
            Self::Conductor(conductor) => flat(&[&conductor.eta, &conductor.k]),
            Self::Dielectric(dielectric) => flat(&[&dielectric.ior]),
            Self::ThinDielectric(pane) => flat(&[&pane.ior]),
        }
    }
}
