//! A sphere.

use super::SurfaceHit;
use crate::math::Ray;
use glam::Vec3;

/// A sphere given by centre and radius.
#[derive(Clone, Copy, Debug)]
pub struct Sphere {
    /// Centre.
    pub center: Vec3,
    /// Radius.
    pub radius: f32,
}

impl Sphere {
    /// Nearest intersection at `0 < t < t_max`.
    #[must_use]
    #[inline]
    pub fn intersect(&self, ray: &Ray, t_max: f32) -> Option<SurfaceHit> {
        // With unit direction: the distance to the foot of the centre, then Pythagoras from the foot, which
        // is precise for small and distant spheres (Haines et al. 2019).
        let to_center = self.center - ray.origin;
        let along = to_center.dot(ray.direction);
        let off_axis = to_center - ray.direction * along;
        let half_chord2 = self.radius * self.radius - off_axis.length_squared();
        if half_chord2 <= 0.0 {
            return None;
        }
        let half_chord = half_chord2.sqrt();
        let inside = to_center.length_squared() < self.radius * self.radius;
        let t = if inside { along + half_chord } else { along - half_chord };
        (t > 0.0 && t < t_max).then(|| SurfaceHit::new(t, (ray.at(t) - self.center).normalize()))
    }

    /// Parameters at which the ray's line enters and leaves the sphere; `None` if it misses.
    ///
    /// The half chord follows from the point of the line nearest to the centre, which loses fewer digits for a
    /// distant ray origin than the discriminant b² − c does.
    #[must_use]
    #[inline]
    pub fn interval(&self, ray: &Ray) -> Option<[f32; 2]> {
        let middle = (self.center - ray.origin).dot(ray.direction);
        let nearest = (ray.at(middle) - self.center).length();
        let half_squared = (self.radius - nearest) * (self.radius + nearest);
        (half_squared > 0.0).then(|| {
            let half = half_squared.sqrt();
            [middle - half, middle + half]
        })
    }
}
