//! A rectangle.

use super::SurfaceHit;
use crate::math::Ray;
use glam::Vec3;

/// A rectangle given by its centre and two perpendicular half-edges; its normal is their cross product.
#[derive(Clone, Copy, Debug)]
pub struct Rectangle {
    /// Centre.
    pub center: Vec3,
    /// Half-edge along the width.
    pub half_u: Vec3,
    /// Half-edge along the height.
    pub half_v: Vec3,
    /// Unit normal.
    pub normal: Vec3,
    /// Area in square scene units.
    pub area: f32,
}

impl Rectangle {
    /// Creates a rectangle at `center` that faces `target`, with its height axis as close to `up` as
    /// possible.
    #[must_use]
    pub fn facing(center: Vec3, target: Vec3, up: Vec3, size: [f32; 2]) -> Self {
        let normal = (target - center).normalize();
        let sideways = up.normalize().cross(normal);
        let u = if sideways.length_squared() > 1e-12 {
            sideways.normalize()
        } else {
            normal.any_orthonormal_vector()
        };
        let v = normal.cross(u);
        Self {
            center,
            half_u: u * (0.5 * size[0]),
            half_v: v * (0.5 * size[1]),
            normal,
            area: size[0] * size[1],
        }
    }

    /// Intersection at `0 < t < t_max`, from either side.
    #[must_use]
    #[inline]
    pub fn intersect(&self, ray: &Ray, t_max: f32) -> Option<SurfaceHit> {
        let t = (self.center - ray.origin).dot(self.normal) / ray.direction.dot(self.normal);
        // The negated form also rejects NaN, from rays within the plane.
        if !(t > 0.0 && t < t_max) {
            return None;
        }
        let p = ray.at(t) - self.center;
        let inside = p.dot(self.half_u).abs() <= self.half_u.length_squared()
            && p.dot(self.half_v).abs() <= self.half_v.length_squared();
        inside.then_some(SurfaceHit::new(t, self.normal))
    }
}
