//! Disk light that emits on the side of its normal, sampled uniformly over its area.

use super::{Emitter, LightPoint, LightSample};
use crate::math::{Frame, sin_cos_turns};
use crate::spectrum::{Components, Spectrum};
use crate::surface::Disk;
use glam::{Vec2, Vec3};

/// One-sided disk light; its other side is black.
#[derive(Clone, Debug)]
pub struct DiskLight {
    /// Shape.
    pub shape: Disk,
    /// Emitted radiance.
    pub radiance: Spectrum,
}

impl Emitter for DiskLight {
    fn sample(&self, from: Vec3, u: Vec2) -> Option<LightSample> {
        let r = self.shape.radius * u.x.sqrt();
        let (sin, cos) = sin_cos_turns(u.y);
        let frame = Frame::about(self.shape.normal);
        let to_light = self.shape.center + frame.to_world(Vec3::new(r * cos, r * sin, 0.0)) - from;
        let distance = to_light.length();
        let point = LightPoint { direction: to_light / distance, distance, triangle: 0 };
        if distance == 0.0 || point.direction.dot(self.shape.normal) >= 0.0 {
            return None;
        }
        Some(LightSample { point, density: self.density(from, &point) })
    }

    /// distance² / (area · cos θ at the light).
    fn density(&self, _from: Vec3, at: &LightPoint) -> f32 {
        let cosine = -at.direction.dot(self.shape.normal);
        if cosine <= 0.0 { 0.0 } else { at.distance * at.distance / (self.shape.area() * cosine) }
    }

    fn radiance<const N: usize, C: Components<N>>(&self, _direction: Vec3, components: &C) -> C::Radiance {
        components.radiance(&self.radiance)
    }
}
