//! What the components of a path stand for.

use super::{LAMBDA_MIN_NM, LAMBDA_RANGE_NM, Sampled, Spectrum, observer};
use glam::Vec3;

/// The `N` components that one path carries, component 0 being the hero.
///
/// The set is symmetric: rotating it makes another member the hero with the same probability, which is
/// what lets the balance heuristic average over possible heroes (Wilkie et al. 2014).
pub trait Components<const N: usize>: Copy + Send + Sync {
    /// Draws the set from a number uniform in [0, 1).
    fn sample(u: f32) -> Self;

    /// A spectrum at the components.
    fn evaluate(&self, spectrum: &Spectrum) -> Sampled<N>;

    /// A coefficient (extinction, albedo) that is given as linear sRGB, at the components.
    fn upsample(&self, rgb: Vec3) -> Sampled<N>;

    /// Radiance that is given as linear sRGB, at the components.
    fn upsample_radiance(&self, rgb: Vec3) -> Sampled<N>;

    /// The linear sRGB estimate that radiance at the components amounts to.
    fn to_film(&self, radiance: Sampled<N>) -> Vec3;
}

/// Wavelengths: the hero uniform over 360–830 nm, the others at rotations by 1/N of the range.
#[derive(Clone, Copy, Debug)]
pub struct Wavelengths<const N: usize> {
    /// In nanometres, the hero first.
    pub lambda_nm: [f32; N],
}

impl<const N: usize> Components<N> for Wavelengths<N> {
    fn sample(u: f32) -> Self {
        let lambda_nm = std::array::from_fn(|i| {
            let turned = u + i as f32 / N as f32;
            LAMBDA_MIN_NM + LAMBDA_RANGE_NM * turned.fract()
        });
        Self { lambda_nm }
    }

    fn evaluate(&self, spectrum: &Spectrum) -> Sampled<N> {
        Sampled(self.lambda_nm.map(|lambda| spectrum.at(lambda)))
    }

    fn upsample(&self, rgb: Vec3) -> Sampled<N> {
        Sampled(self.lambda_nm.map(|lambda| observer::basis(lambda).dot(rgb)))
    }

    fn upsample_radiance(&self, rgb: Vec3) -> Sampled<N> {
        Sampled(self.lambda_nm.map(|lambda| observer::basis(lambda).dot(rgb) * observer::daylight(lambda)))
    }

    fn to_film(&self, radiance: Sampled<N>) -> Vec3 {
        // Each wavelength is uniform over the range: divide by the density 1/range, average over N.
        let mut sum = Vec3::ZERO;
        for (lambda, value) in self.lambda_nm.iter().zip(radiance.0) {
            sum += observer::response(*lambda) * value;
        }
        sum * (LAMBDA_RANGE_NM / N as f32)
    }
}

/// Colour channels: the hero uniform over red, green and blue, the others in rotation.
#[derive(Clone, Copy, Debug)]
pub struct RgbChannels<const N: usize> {
    /// 0 red, 1 green, 2 blue; the hero first.
    pub channel: [usize; N],
}

impl<const N: usize> Components<N> for RgbChannels<N> {
    fn sample(u: f32) -> Self {
        let hero = ((u * 3.0) as usize).min(2);
        Self { channel: std::array::from_fn(|i| (hero + i) % 3) }
    }

    fn evaluate(&self, spectrum: &Spectrum) -> Sampled<N> {
        self.upsample(spectrum.rgb())
    }

    fn upsample(&self, rgb: Vec3) -> Sampled<N> {
        Sampled(self.channel.map(|c| rgb[c]))
    }

    fn upsample_radiance(&self, rgb: Vec3) -> Sampled<N> {
        self.upsample(rgb)
    }

    fn to_film(&self, radiance: Sampled<N>) -> Vec3 {
        // A channel is among the N carried ones with probability N/3.
        let mut rgb = Vec3::ZERO;
        for (c, value) in self.channel.iter().zip(radiance.0) {
            rgb[*c] += value * (3.0 / N as f32);
        }
        rgb
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The film must see a constant radiance in the mean over the hero, for any number of components.
    fn mean_film<const N: usize, C: Components<N>>() -> Vec3 {
        let n = 4700u16;
        (0..n).map(|i| C::sample((f32::from(i) + 0.5) / f32::from(n)).to_film(Sampled::ONE)).sum::<Vec3>()
            / f32::from(n)
    }

    #[test]
    fn the_film_is_unbiased_over_the_hero() {
        let e = Vec3::new(1.2048, 0.9483, 0.9089);
        assert!((mean_film::<4, Wavelengths<4>>() - e).abs().max_element() < 3e-4);
        assert!((mean_film::<1, Wavelengths<1>>() - e).abs().max_element() < 3e-4);
        assert!((mean_film::<3, RgbChannels<3>>() - Vec3::ONE).abs().max_element() < 1e-3);
        assert!((mean_film::<1, RgbChannels<1>>() - Vec3::ONE).abs().max_element() < 1e-3);
    }

    #[test]
    fn wavelengths_are_rotations_of_the_hero() {
        let w = Wavelengths::<4>::sample(0.9);
        for (lambda, expected) in w.lambda_nm.iter().zip([783.0, 430.5, 548.0, 665.5]) {
            assert!((lambda - expected).abs() < 1e-2);
        }
    }
}
