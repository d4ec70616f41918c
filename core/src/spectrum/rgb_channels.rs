//! RGB mode: the components of a path are the film's channels.

use super::{Carried, Components, Sampled, Spectrum, WavelengthSampling, blackbody};
use glam::Vec3;

/// Colour channels: the hero is uniform over red, green and blue, the others follow in rotation.
#[derive(Clone, Copy, Debug)]
pub struct RgbChannels<const N: usize> {
    /// Channel indices, the hero first: 0 red, 1 green, 2 blue.
    pub channel: [usize; N],
}

impl<const N: usize> Components<N> for RgbChannels<N> {
    type Radiance = Sampled<N>;

    fn sample(u: f32, _: Option<WavelengthSampling>) -> Self {
        let hero = ((u * 3.0) as usize).min(2);
        Self { channel: std::array::from_fn(|i| (hero + i) % 3) }
    }

    fn evaluate(&self, spectrum: &Spectrum) -> Sampled<N> {
        self.upsample(spectrum.rgb())
    }

    fn upsample(&self, rgb: Vec3) -> Sampled<N> {
        Sampled(self.channel.map(|c| rgb[c]))
    }

    fn radiance(&self, spectrum: &Spectrum) -> Sampled<N> {
        self.evaluate(spectrum)
    }

    fn radiance_of_rgb(&self, rgb: Vec3) -> Sampled<N> {
        self.upsample(rgb)
    }

    fn blackbody(&self, kelvin: f32) -> Sampled<N> {
        self.upsample(blackbody::rgb(kelvin))
    }

    fn carried(&self) -> Carried {
        Carried::Channels(Sampled(self.channel.map(|c| c as f32)).lanes(), N)
    }

    fn to_film(&self, radiance: Sampled<N>) -> Vec3 {
        // A channel is among the N components with probability N/3.
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

    #[test]
    fn the_film_is_unbiased_over_the_hero() {
        let n = 3000u16;
        let hero = |i: u16| (f32::from(i) + 0.5) / f32::from(n);
        let three: Vec3 = (0..n).map(|i| RgbChannels::<3>::sample(hero(i), None).to_film(Sampled::ONE)).sum();
        let one: Vec3 = (0..n).map(|i| RgbChannels::<1>::sample(hero(i), None).to_film(Sampled::ONE)).sum();
        assert!((three / f32::from(n) - Vec3::ONE).abs().max_element() < 1e-3);
        assert!((one / f32::from(n) - Vec3::ONE).abs().max_element() < 1e-3);
    }
}
