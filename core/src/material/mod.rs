//! Materials: how surfaces scatter light.

mod diffuse;

pub use diffuse::Diffuse;

/// Material of a surface.
#[derive(Clone, Debug)]
pub enum Material {
    /// Lambertian reflection.
    Diffuse(Diffuse),
}

impl Material {
    /// Returns whether the material is independent of wavelength.
    #[must_use]
    pub fn is_achromatic(&self) -> bool {
        match self {
            Self::Diffuse(diffuse) => diffuse.albedo.is_flat(),
        }
    }
}
