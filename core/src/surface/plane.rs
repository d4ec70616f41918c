//! An infinite plane.

use super::SurfaceHit;
use crate::math::Ray;
use glam::Vec3;

/// A plane given by a point and its unit normal.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    /// A point on the plane.
    pub point: Vec3,
    /// Unit normal.
    pub normal: Vec3,
}

impl Plane {
    /// Intersection at `0 < t < t_max`.
    #[must_use]
    #[inline]
    pub fn intersect(&self, ray: &Ray, t_max: f32) -> Option<SurfaceHit> {
        let t = (self.point - ray.origin).dot(self.normal) / ray.direction.dot(self.normal);
        (t > 0.0 && t < t_max).then_some(SurfaceHit::new(t, self.normal))
    }
}
