//! A disk.

use super::SurfaceHit;
use crate::math::Ray;
use glam::Vec3;
use std::f32::consts::PI;

/// A disk given by centre, unit normal and radius.
#[derive(Clone, Copy, Debug)]
pub struct Disk {
    /// Centre.
    pub center: Vec3,
    /// Unit normal.
    pub normal: Vec3,
    /// Radius.
    pub radius: f32,
}

impl Disk {
    /// Area in square scene units.
    #[must_use]
    pub fn area(&self) -> f32 {
        PI * self.radius * self.radius
    }

    /// Intersection at `0 < t < t_max`, from either side.
    #[must_use]
    pub fn intersect(&self, ray: &Ray, t_max: f32) -> Option<SurfaceHit> {
        let t = (self.center - ray.origin).dot(self.normal) / ray.direction.dot(self.normal);
        // The negated form also rejects NaN, from rays within the plane.
        if !(t > 0.0 && t < t_max) {
            return None;
        }
        (ray.at(t).distance_squared(self.center) <= self.radius * self.radius)
            .then(|| SurfaceHit::new(t, self.normal))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hits_inside_the_radius_from_both_sides() {
        let disk = Disk { center: Vec3::new(0.0, 0.0, 2.0), normal: Vec3::NEG_Z, radius: 0.5 };
        let t = |x: f32, z: f32, direction: Vec3, t_max| {
            let ray = Ray { origin: Vec3::new(x, 0.0, z), direction };
            disk.intersect(&ray, t_max).map(|hit| hit.t)
        };
        assert_eq!(t(0.49, 0.0, Vec3::Z, 9.0), Some(2.0));
        assert_eq!(t(0.0, 5.0, Vec3::NEG_Z, 9.0), Some(3.0));
        assert_eq!(t(0.51, 0.0, Vec3::Z, 9.0), None);
        assert_eq!(t(0.0, 0.0, Vec3::Z, 2.0), None);
        assert_eq!(t(0.0, 2.0, Vec3::X, 9.0), None);
    }
}
