//! Rays, and their intersection with the unit cube.

use glam::{Affine3A, Vec3, Vec3A};

/// A ray. In world space its direction has unit length, so that `t` is a distance. A ray transformed to
/// another space keeps its `t` and may have a direction of any length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Start point.
    pub origin: Vec3,
    /// Direction.
    pub direction: Vec3,
}

impl Ray {
    /// Returns the point at parameter `t`.
    #[must_use]
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + self.direction * t
    }
}

/// Segment of a ray inside the cube from (0,0,0) to (1,1,1).
#[derive(Clone, Copy, Debug)]
pub struct BoxRay {
    /// Entry point, or the ray's origin if that is inside.
    pub origin: Vec3A,
    /// Direction of the ray, with zero components replaced by tiny ones.
    pub direction: Vec3A,
    /// Reciprocals of the components of the direction.
    pub inverse: Vec3A,
    /// Parameter of the exit, relative to `origin`; counting from a distant ray origin would lose digits.
    pub t_end: f32,
}

/// A component of a direction this small has no effect, and its inverse is finite, so that 0 · ∞ never occurs.
const TINY: Vec3A = Vec3A::splat(1e-20);

impl BoxRay {
    /// Clips a ray of another space, with 0 ≤ t ≤ t_max, to the cube (slab test). Returns the parameter of
    /// the entry and the segment; `None` if the ray misses the cube.
    #[must_use]
    #[inline]
    pub fn enter(ray: &Ray, box_from_ray: &Affine3A, t_max: f32) -> Option<(f32, Self)> {
        let origin = box_from_ray.transform_point3a(ray.origin.into());
        let direction = box_from_ray.transform_vector3a(ray.direction.into());
        let direction = Vec3A::select(direction.abs().cmplt(TINY), TINY, direction);
        let inverse = direction.recip();
        let a = -origin * inverse;
        let b = a + inverse;
        let t0 = a.min(b).max_element().max(0.0);
        let t1 = a.max(b).min_element().min(t_max);
        // Rejects rays with NaN coordinates, for which every comparison fails.
        if t0 < t1 && (origin + direction).is_finite() {
            let origin = origin + direction * t0;
            Some((t0, Self { origin, direction, inverse, t_end: t1 - t0 }))
        } else {
            None
        }
    }

    /// Returns the segment in another space, given its origin there and the map of directions.
    #[must_use]
    #[inline]
    pub fn moved(&self, origin: Vec3A, turned: impl Fn(Vec3A) -> Vec3A) -> Self {
        let direction = turned(self.direction);
        let direction = Vec3A::select(direction.abs().cmplt(TINY), TINY, direction);
        Self { origin, direction, inverse: direction.recip(), t_end: self.t_end }
    }

    /// Returns the point at parameter `t`.
    #[must_use]
    #[inline]
    pub fn at(&self, t: f32) -> Vec3 {
        (self.origin + self.direction * t).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_from_outside_inside_and_beside() {
        let interval = |o: [f32; 3], d: [f32; 3]| {
            let ray = Ray { origin: o.into(), direction: d.into() };
            BoxRay::enter(&ray, &Affine3A::IDENTITY, f32::INFINITY)
                .map(|(t0, inside)| (t0, t0 + inside.t_end))
        };
        assert_eq!(interval([-1.0, 0.5, 0.5], [1.0, 0.0, 0.0]), Some((1.0, 2.0)));
        assert_eq!(interval([0.5, 0.5, 0.5], [0.0, 0.0, 2.0]), Some((0.0, 0.25)));
        assert_eq!(interval([-1.0, 1.5, 0.5], [1.0, 0.0, 0.0]), None);
        assert_eq!(interval([2.0, 0.5, 0.5], [1.0, 0.0, 0.0]), None);
        // Along a face, and with NaN.
        assert_eq!(interval([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]), Some((1.0, 2.0)));
        assert_eq!(interval([f32::NAN, 0.5, 0.5], [1.0, 0.0, 0.0]), None);
        assert_eq!(interval([0.5, 0.5, 0.5], [1.0, f32::NAN, 0.0]), None);
        let ray = Ray { origin: Vec3::new(-1.0, 0.5, 0.5), direction: Vec3::X };
        assert_eq!(BoxRay::enter(&ray, &Affine3A::IDENTITY, 1.5).map(|(_, inside)| inside.t_end), Some(0.5));
        assert!(BoxRay::enter(&ray, &Affine3A::IDENTITY, 1.0).is_none());
    }
}
