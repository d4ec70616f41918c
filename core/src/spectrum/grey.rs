//! Achromatic paths: where medium and surfaces are independent of wavelength, all components share one
//! weight, and the integral over wavelengths factors out of transport.
//!
//! The path then carries one component. Its radiance is the colour of each light on the film, ∫ response(λ)
//! Le(λ) dλ, in closed form. No colour noise remains.

use super::{
    Carried, Components, Lanes, Radiance, Sampled, Spectrum, WavelengthSampling, blackbody, observer,
};
use glam::Vec3;
use std::ops::{AddAssign, Mul};

/// The single component of a path through an achromatic scene.
#[derive(Clone, Copy, Debug)]
pub struct Grey {
    /// Whether the film integrates over wavelengths, or keeps RGB channels.
    spectral: bool,
}

/// Radiance as linear sRGB on the film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmColour(pub Vec3);

impl AddAssign for FilmColour {
    fn add_assign(&mut self, other: Self) {
        self.0 += other.0;
    }
}

impl Mul<Sampled<1>> for FilmColour {
    type Output = Self;
    fn mul(self, weight: Sampled<1>) -> Self {
        Self(self.0 * weight.hero())
    }
}

impl Radiance<1> for FilmColour {
    const BLACK: Self = Self(Vec3::ZERO);

    fn lanes(&self) -> Lanes {
        self.0.extend(0.0).to_array()
    }
}

impl Components<1> for Grey {
    type Radiance = FilmColour;

    fn sample(_: f32, wavelengths: Option<WavelengthSampling>) -> Self {
        Self { spectral: wavelengths.is_some() }
    }

    fn evaluate(&self, spectrum: &Spectrum) -> Sampled<1> {
        self.upsample(spectrum.rgb())
    }

    fn upsample(&self, rgb: Vec3) -> Sampled<1> {
        Sampled([rgb.x])
    }

    fn radiance(&self, spectrum: &Spectrum) -> FilmColour {
        FilmColour(if self.spectral { spectrum.film_colour() } else { spectrum.rgb() })
    }

    fn radiance_of_rgb(&self, rgb: Vec3) -> FilmColour {
        FilmColour(if self.spectral { observer::film_colour_of_rgb(rgb) } else { rgb })
    }

    fn blackbody(&self, kelvin: f32) -> FilmColour {
        FilmColour(if self.spectral { blackbody::film_colour(kelvin) } else { blackbody::rgb(kelvin) })
    }

    fn carried(&self) -> Carried {
        Carried::Grey
    }

    fn to_film(&self, radiance: FilmColour) -> Vec3 {
        radiance.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::{Quantity, SpectrumDoc, Wavelengths};

    #[test]
    fn a_light_has_the_colour_that_its_wavelengths_add_up_to() {
        let lights = [
            SpectrumDoc::Constant(2.0),
            SpectrumDoc::Rgb([0.9, 0.4, 0.1]),
            SpectrumDoc::Preset("report-plume".into()),
        ];
        for doc in lights {
            let spectrum = Spectrum::new(&doc, Quantity::Radiance);
            let n = 9400u16;
            let mut sum = Vec3::ZERO;
            for i in 0..n {
                let u = (f32::from(i) + 0.5) / f32::from(n);
                let set = Wavelengths::<1>::sample(u, Some(WavelengthSampling::Uniform));
                sum += set.to_film(set.radiance(&spectrum));
            }
            let FilmColour(colour) = Grey { spectral: true }.radiance(&spectrum);
            let apart = (sum / f32::from(n) - colour).abs().max_element();
            assert!(apart < 1e-3 * colour.max_element(), "{doc:?}: {sum} {colour}");
        }
        let FilmColour(white) = Grey { spectral: true }.radiance_of_rgb(Vec3::ONE);
        assert!((white - Vec3::ONE).abs().max_element() < 4e-3, "{white}");
        assert_eq!(Grey { spectral: false }.radiance_of_rgb(Vec3::X), FilmColour(Vec3::X));
    }
}
