//! Sphere light that emits outwards, sampled uniformly over the cone that it subtends.

use super::{Emitter, LightPoint, LightSample};
use crate::math::{Frame, PolarAngle};
use crate::spectrum::{Components, Spectrum};
use crate::surface::Sphere;
use glam::{Vec2, Vec3};
use std::f32::consts::TAU;

/// Sphere light.
#[derive(Clone, Debug)]
pub struct SphereLight {
    /// Shape.
    pub shape: Sphere,
    /// Emitted radiance.
    pub radiance: Spectrum,
}

impl SphereLight {
    /// 1 − cos of the half angle that the sphere subtends, without cancellation; `None` inside.
    #[inline]
    fn one_minus_cos_max(&self, distance2: f32) -> Option<f32> {
        let sin2 = self.shape.radius * self.shape.radius / distance2;
        (sin2 < 1.0).then(|| sin2 / (1.0 + (1.0 - sin2).sqrt()))
    }
}

impl Emitter for SphereLight {
    #[inline]
    fn sample(&self, from: Vec3, u: Vec2) -> Option<LightSample> {
        let to_center = self.shape.center - from;
        let distance2 = to_center.length_squared();
        let cap = self.one_minus_cos_max(distance2)?;
        let theta = PolarAngle::from_one_minus_cos(u.x * cap);
        let direction = Frame::about(to_center / distance2.sqrt()).polar(theta, u.y);
        // Distance to the near side: foot of the centre on the ray, minus half a chord.
        let along = to_center.dot(direction);
        let off_axis2 = (to_center - direction * along).length_squared();
        let half_chord = (self.shape.radius * self.shape.radius - off_axis2).max(0.0).sqrt();
        Some(LightSample::new(direction, along - half_chord, 1.0 / (TAU * cap)))
    }

    #[inline]
    fn density(&self, from: Vec3, _at: &LightPoint) -> f32 {
        self.one_minus_cos_max((self.shape.center - from).length_squared())
            .map_or(0.0, |cap| 1.0 / (TAU * cap))
    }

    #[inline]
    fn radiance<const N: usize, C: Components<N>>(&self, _direction: Vec3, components: &C) -> C::Radiance {
        components.radiance(&self.radiance)
    }
}
