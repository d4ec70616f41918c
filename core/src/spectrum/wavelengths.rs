//! Spectral mode: components are wavelengths.

use super::{
    Carried, Components, LAMBDA_MAX_NM, LAMBDA_MIN_NM, LAMBDA_RANGE_NM, Sampled, Spectrum, blackbody,
    observer,
};
use glam::Vec3;
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// How the hero's wavelength is drawn; the others are rotations of it by 1/N of the probability.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WavelengthSampling {
    /// Where the sensor responds most, most often.
    #[default]
    Sensor,
    /// Uniformly over 360–830 nm, as in the report: relMSE ×2.4 on the embedded plume, with look-ups ×0.7, as many of the
    /// wavelengths drawn hardly see the medium, nor are seen.
    Uniform,
}

/// Wavelengths, each drawn with a density of its own.
#[derive(Clone, Copy, Debug)]
pub struct Wavelengths<const N: usize> {
    /// In nanometres, the hero first.
    pub lambda_nm: [f32; N],
    /// Density with which each was drawn, per nanometre.
    pub density_per_nm: [f32; N],
}

impl<const N: usize> Components<N> for Wavelengths<N> {
    type Radiance = Sampled<N>;

    /// Rotations take place in the space of the uniform number: each member of the set is drawn with the
    /// density of the hero at its wavelength, whichever member is the hero.
    fn sample(u: f32, wavelengths: WavelengthSampling) -> Self {
        let mut set = Self { lambda_nm: [0.0; N], density_per_nm: [0.0; N] };
        for i in 0..N {
            let turned = (u + i as f32 / N as f32).fract();
            (set.lambda_nm[i], set.density_per_nm[i]) = match wavelengths {
                WavelengthSampling::Uniform => {
                    (LAMBDA_MIN_NM + LAMBDA_RANGE_NM * turned, 1.0 / LAMBDA_RANGE_NM)
                }
                WavelengthSampling::Sensor => SENSOR.at(turned),
            };
        }
        set
    }

    fn evaluate(&self, spectrum: &Spectrum) -> Sampled<N> {
        Sampled(self.lambda_nm.map(|lambda| spectrum.at(lambda)))
    }

    fn upsample(&self, rgb: Vec3) -> Sampled<N> {
        Sampled(self.lambda_nm.map(|lambda| observer::basis(lambda).dot(rgb)))
    }

    fn radiance(&self, spectrum: &Spectrum) -> Sampled<N> {
        self.evaluate(spectrum)
    }

    fn radiance_of_rgb(&self, rgb: Vec3) -> Sampled<N> {
        Sampled(self.lambda_nm.map(|lambda| observer::basis(lambda).dot(rgb) * observer::daylight(lambda)))
    }

    fn blackbody(&self, kelvin: f32) -> Sampled<N> {
        Sampled(self.lambda_nm.map(|lambda| blackbody::planck(lambda, kelvin)))
    }

    fn carried(&self) -> Carried {
        Carried::Wavelengths(Sampled(self.lambda_nm).lanes(), N)
    }

    /// Mean over the set of response · radiance / density.
    fn to_film(&self, radiance: Sampled<N>) -> Vec3 {
        let mut sum = Vec3::ZERO;
        for i in 0..N {
            let weight = radiance.0[i] / self.density_per_nm[i];
            sum += observer::response(self.lambda_nm[i]) * weight;
        }
        sum * (1.0 / N as f32)
    }
}

/// Steps of the sensor's quantile function.
const STEPS: usize = 1024;
/// Share of wavelengths that are drawn uniformly: no weight exceeds its inverse.
const UNIFORM: f32 = 0.04;

/// A wavelength as a function of a uniform number, linear between equal steps: drawing is one look-up,
/// and its density is exactly the inverse of the step's slope.
struct Quantiles([f32; STEPS + 1]);

/// In proportion to the length of the sensor's response, which gives the least variance summed over the
/// film's channels to a single wavelength of white light.
static SENSOR: LazyLock<Quantiles> = LazyLock::new(|| {
    let importance = |lambda: f32| observer::response(lambda).length();
    let total = observer::integrate(|l| Vec3::splat(importance(l))).x;
    let density = |lambda: f32| UNIFORM / LAMBDA_RANGE_NM + (1.0 - UNIFORM) * importance(lambda) / total;
    let mut quantiles = [LAMBDA_MAX_NM; STEPS + 1];
    let (mut next, mut below) = (0, 0.0f32);
    const FINE: usize = 16 * 470;
    let width = LAMBDA_RANGE_NM / FINE as f32;
    for i in 0..FINE {
        let lambda = LAMBDA_MIN_NM + width * i as f32;
        let share = density(lambda + 0.5 * width) * width;
        while next < STEPS && next as f32 / STEPS as f32 <= below + share {
            let into = (next as f32 / STEPS as f32 - below) / share;
            quantiles[next] = lambda + width * into.clamp(0.0, 1.0);
            next += 1;
        }
        below += share;
    }
    Quantiles(quantiles)
});

impl Quantiles {
    fn at(&self, u: f32) -> (f32, f32) {
        let x = u * STEPS as f32;
        let i = (x as usize).min(STEPS - 1);
        let slope = self.0[i + 1] - self.0[i];
        (self.0[i] + slope * (x - i as f32), 1.0 / (slope * STEPS as f32))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_film_is_unbiased_over_the_hero_however_it_is_drawn() {
        let expected = Vec3::new(1.204_98, 0.948_28, 0.908_62);
        for by in [WavelengthSampling::Uniform, WavelengthSampling::Sensor] {
            let n = 9400u16;
            let hero = |i: u16| (f32::from(i) + 0.5) / f32::from(n);
            let four = (0..n).map(|i| Wavelengths::<4>::sample(hero(i), by).to_film(Sampled::ONE));
            let one = (0..n).map(|i| Wavelengths::<1>::sample(hero(i), by).to_film(Sampled::ONE));
            let mean = |sum: Vec3| sum / f32::from(n);
            assert!((mean(four.sum()) - expected).abs().max_element() < 3e-4, "{by:?}");
            assert!((mean(one.sum()) - expected).abs().max_element() < 3e-4, "{by:?}");
        }
    }

    #[test]
    fn one_wavelength_by_the_sensor_scatters_less_than_a_uniform_one() {
        let variance = |by| {
            let n = 4700u16;
            let hero = |i: u16| (f32::from(i) + 0.5) / f32::from(n);
            let squares: f32 = (0..n)
                .map(|i| Wavelengths::<1>::sample(hero(i), by).to_film(Sampled::ONE).length_squared())
                .sum();
            squares / f32::from(n) - Vec3::new(1.204_98, 0.948_28, 0.908_62).length_squared()
        };
        let (sensor, uniform) = (variance(WavelengthSampling::Sensor), variance(WavelengthSampling::Uniform));
        assert!(sensor < 0.5 * uniform, "{sensor} {uniform}");
    }

    #[test]
    fn wavelengths_are_rotations_of_the_hero() {
        let w = Wavelengths::<4>::sample(0.9, WavelengthSampling::Uniform);
        for (lambda, expected) in w.lambda_nm.iter().zip([783.0, 430.5, 548.0, 665.5]) {
            assert!((lambda - expected).abs() < 1e-2);
        }
        let (a, b) = (0.9f32, (0.9f32 + 0.25).fract());
        let [first, second] = [a, b].map(|u| Wavelengths::<4>::sample(u, WavelengthSampling::Sensor));
        assert!((first.lambda_nm[1] - second.lambda_nm[0]).abs() < 0.01);
        assert!((first.density_per_nm[1] / second.density_per_nm[0] - 1.0).abs() < 1e-3);
    }
}
