//! Constant environment, sampled uniformly over the sphere.

use super::{Emitter, LightPoint, LightSample};
use crate::math::{INV_4PI, uniform_direction};
use crate::spectrum::{Components, Spectrum};
use glam::{Vec2, Vec3};

/// Environment with the same radiance from every direction.
#[derive(Clone, Debug)]
pub struct Environment {
    /// Incident radiance.
    pub radiance: Spectrum,
}

impl Emitter for Environment {
    #[inline]
    fn sample(&self, _from: Vec3, u: Vec2) -> Option<LightSample> {
        Some(LightSample::new(uniform_direction(u), f32::INFINITY, INV_4PI))
    }

    #[inline]
    fn density(&self, _from: Vec3, _at: &LightPoint) -> f32 {
        INV_4PI
    }

    #[inline]
    fn radiance<const N: usize, C: Components<N>>(&self, _direction: Vec3, components: &C) -> C::Radiance {
        components.radiance(&self.radiance)
    }
}
