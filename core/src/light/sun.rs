//! Distant disc light: constant radiance from all directions within a small angle of a direction.

use super::{Emitter, LightPoint, LightSample};
use crate::math::{Frame, PolarAngle};
use crate::spectrum::{Components, Spectrum};
use glam::{Vec2, Vec3};
use std::f32::consts::{PI, TAU};

/// Sun. Its radiance is irradiance / (π sin² α) for half angle α, so that a surface facing it receives the
/// specified irradiance, whatever the diameter.
#[derive(Clone, Debug)]
pub struct Sun {
    toward: Vec3,
    half_angle: f32,
    one_minus_cos_max: f32,
    radiance: Spectrum,
}

impl Sun {
    /// Creates a sun in direction `toward` with an apparent diameter in degrees.
    #[must_use]
    pub fn new(toward: Vec3, angular_diameter_deg: f32, irradiance: Spectrum) -> Self {
        let half_angle = 0.5 * angular_diameter_deg.to_radians();
        let sin_half = (0.5 * half_angle).sin();
        let sin = half_angle.sin();
        Self {
            toward: toward.normalize(),
            half_angle,
            one_minus_cos_max: 2.0 * sin_half * sin_half,
            radiance: irradiance.scaled(1.0 / (PI * sin * sin)),
        }
    }

    /// Unit vector towards the centre.
    #[must_use]
    pub fn toward(&self) -> Vec3 {
        self.toward
    }

    /// Half of the apparent diameter, in radians.
    #[must_use]
    pub fn half_angle(&self) -> f32 {
        self.half_angle
    }

    /// Integral over the disc of a scalar measure of the radiance.
    #[must_use]
    pub fn irradiance(&self, measure: impl Fn(&Spectrum) -> f32) -> f32 {
        measure(&self.radiance) * TAU * self.one_minus_cos_max
    }

    /// Whether the disc covers a direction.
    #[must_use]
    #[inline]
    pub fn covers(&self, direction: Vec3) -> bool {
        PolarAngle::between(direction, self.toward).one_minus_cos < self.one_minus_cos_max
    }
}

impl Emitter for Sun {
    #[inline]
    fn sample(&self, _from: Vec3, u: Vec2) -> Option<LightSample> {
        let theta = PolarAngle::from_one_minus_cos(u.x * self.one_minus_cos_max);
        let direction = Frame::about(self.toward).polar(theta, u.y);
        Some(LightSample::new(direction, f32::INFINITY, 1.0 / (TAU * self.one_minus_cos_max)))
    }

    #[inline]
    fn density(&self, _from: Vec3, _at: &LightPoint) -> f32 {
        1.0 / (TAU * self.one_minus_cos_max)
    }

    fn radiance<const N: usize, C: Components<N>>(&self, _direction: Vec3, components: &C) -> C::Radiance {
        components.radiance(&self.radiance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::RgbChannels;

    #[test]
    fn a_sun_gives_the_irradiance_that_was_asked_for_at_any_diameter() {
        for diameter in [0.1, 0.53, 5.0] {
            let sun = Sun::new(Vec3::Y, diameter, Spectrum::constant(2.0));
            let components = RgbChannels::<1> { channel: [0] };
            let s = sun.sample(Vec3::ZERO, Vec2::new(0.5, 0.5)).expect("the sun can always be sampled");
            let radiance = sun.radiance(s.point.direction, &components).hero();
            let half = 0.5 * f64::from(diameter).to_radians();
            let irradiance = f64::from(radiance) * std::f64::consts::PI * half.sin().powi(2);
            assert!((irradiance - 2.0).abs() < 1e-3, "{irradiance}");
            assert!(sun.covers(s.point.direction) && !sun.covers(Vec3::X));
        }
    }
}
