//! Radiance of a black body, by Planck's law.
//!
//! Relative to the radiance at 3000 K and 560 nm, which a scene's `scale` sets. The dependence on temperature
//! is physical.

use super::observer;
use glam::Vec3;
use std::sync::LazyLock;

/// Temperatures are clamped to this maximum, in kelvins.
pub const HOTTEST_K: f32 = 15_000.0;
/// Temperatures below this have zero radiance: there it is below 10⁻⁹ of that at 3000 K.
const DARK_K: f32 = 700.0;

/// h c / k, in nm K.
const SECOND_RADIATION_CONSTANT: f64 = 1.438_776_877e7;

/// Spectral radiance at a wavelength, relative to 3000 K at 560 nm:
/// (560/λ)⁵ (e^(c₂/(560·3000)) − 1)/(e^(c₂/(λT)) − 1).
#[must_use]
pub fn planck(lambda_nm: f32, kelvin: f32) -> f32 {
    if kelvin < DARK_K {
        return 0.0;
    }
    let occupation = |lambda: f64, t: f64| 1.0 / (SECOND_RADIATION_CONSTANT / (lambda * t)).exp_m1();
    let (lambda, t) = (f64::from(lambda_nm), f64::from(kelvin.min(HOTTEST_K)));
    ((560.0 / lambda).powi(5) * occupation(lambda, t) / occupation(560.0, 3000.0)) as f32
}

/// Table of the colours of a black body, one per kelvin.
struct Colours(Vec<Vec3>);

impl Colours {
    fn new(colour: impl Fn(f32) -> Vec3) -> Self {
        Self((0..=HOTTEST_K as u16).map(|kelvin| colour(f32::from(kelvin))).collect())
    }

    fn at(&self, kelvin: f32) -> Vec3 {
        let at = kelvin.clamp(0.0, HOTTEST_K);
        let below = (at as usize).min(self.0.len() - 2);
        self.0[below].lerp(self.0[below + 1], at - below as f32)
    }
}

static ON_FILM: LazyLock<Colours> =
    LazyLock::new(|| Colours::new(|kelvin| observer::film_colour(|l| planck(l, kelvin), std::iter::empty())));

static IN_RGB: LazyLock<Colours> =
    LazyLock::new(|| Colours::new(|kelvin| observer::band_means(|l| planck(l, kelvin))));

/// ∫ response(λ) · planck(λ, T) dλ in linear sRGB; deep red lies outside the gamut and has a negative blue
/// component.
#[must_use]
pub fn film_colour(kelvin: f32) -> Vec3 {
    ON_FILM.at(kelvin)
}

/// Components in RGB mode: means under the positive part of each channel's response, as for any spectrum.
#[must_use]
pub fn rgb(kelvin: f32) -> Vec3 {
    IN_RGB.at(kelvin)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_follows_planck_and_wien() {
        assert!((planck(560.0, 3000.0) - 1.0).abs() < 1e-6);
        // Wien: at 5000 K the maximum lies at 2.897 771 955e6 / 5000 = 579.55 nm.
        let brightest = (3600..8300u16).max_by(|a, b| {
            let at = |x: &u16| planck(f32::from(*x) / 10.0, 5000.0);
            at(a).total_cmp(&at(b))
        });
        assert!(brightest.is_some_and(|l| (f32::from(l) / 10.0 - 579.55).abs() < 1.0), "{brightest:?}");
        assert_eq!(planck(560.0, 300.0), 0.0);
    }

    #[test]
    fn hotter_is_brighter_and_bluer() {
        // Below 2000 K blue is out of the gamut.
        let mut before = film_colour(2000.0);
        for hundreds in 21..=150u16 {
            let now = film_colour(f32::from(hundreds) * 100.0);
            assert!(now.x > before.x && now.z / now.x > before.z / before.x, "{hundreds}");
            before = now;
        }
        let between = film_colour(2000.5);
        let direct = observer::film_colour(|l| planck(l, 2000.5), std::iter::empty());
        assert!((between - direct).abs().max_element() < 1e-4 * direct.x, "{between} {direct}");
    }
}
