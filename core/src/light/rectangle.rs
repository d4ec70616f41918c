//! Rectangle light that emits on the side of its normal, sampled uniformly over its area.

use super::{Emitter, LightPoint, LightSample};
use crate::spectrum::{Components, Spectrum};
use crate::surface::Rectangle;
use glam::{Vec2, Vec3};

/// One-sided rectangle light; its other side is black.
#[derive(Clone, Debug)]
pub struct RectangleLight {
    /// Shape.
    pub shape: Rectangle,
    /// Emitted radiance.
    pub radiance: Spectrum,
}

impl Emitter for RectangleLight {
    #[inline]
    fn sample(&self, from: Vec3, u: Vec2) -> Option<LightSample> {
        let s = u * 2.0 - Vec2::ONE;
        let point = self.shape.center + self.shape.half_u * s.x + self.shape.half_v * s.y;
        let to_light = point - from;
        let distance = to_light.length();
        let direction = to_light / distance;
        if distance == 0.0 || direction.dot(self.shape.normal) >= 0.0 {
            return None;
        }
        let point = LightPoint { direction, distance, triangle: 0 };
        Some(LightSample { point, density: self.density(from, &point) })
    }

    /// distance² / (area · cos θ at the light).
    #[inline]
    fn density(&self, _from: Vec3, at: &LightPoint) -> f32 {
        let cosine = -at.direction.dot(self.shape.normal);
        if cosine <= 0.0 { 0.0 } else { at.distance * at.distance / (self.shape.area * cosine) }
    }

    #[inline]
    fn radiance<const N: usize, C: Components<N>>(&self, _direction: Vec3, components: &C) -> C::Radiance {
        components.radiance(&self.radiance)
    }
}
