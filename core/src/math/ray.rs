//! Rays, and what of them lies in the unit box.

use glam::{Affine3A, Vec3, Vec3A};

/// A half-line. In world space its direction has unit length, so that `t` is a distance; a ray taken
/// into another space keeps its `t` and may have a direction of any length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: Vec3,
    /// Where it goes.
    pub direction: Vec3,
}

impl Ray {
    /// The point at parameter `t`.
    #[must_use]
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + self.direction * t
    }
}

/// The part of a ray inside the cube from (0,0,0) to (1,1,1).
#[derive(Clone, Copy, Debug)]
pub struct BoxRay {
    /// Where it enters, or starts inside.
    pub origin: Vec3A,
    /// The ray's direction, without components that are exactly zero.
    pub direction: Vec3A,
    /// One over each component of it.
    pub inverse: Vec3A,
    /// Parameter at which it leaves, counted from `origin`; a walk that counts from far away would lose digits.
    pub t_end: f32,
}

impl BoxRay {
    /// The part of a ray of another space, with 0 ≤ t ≤ t_max, inside the cube, and the parameter at which
    /// that begins (slab test); `None` if the ray misses it.
    #[must_use]
    #[inline]
    pub fn enter(ray: &Ray, box_from_ray: &Affine3A, t_max: f32) -> Option<(f32, Self)> {
        // A direction this close to zero moves nothing, and its inverse is finite: no 0 · ∞ anywhere.
        const TINY: Vec3A = Vec3A::splat(1e-20);
        let origin = box_from_ray.transform_point3a(ray.origin.into());
        let direction = box_from_ray.transform_vector3a(ray.direction.into());
        let direction = Vec3A::select(direction.abs().cmplt(TINY), TINY, direction);
        let inverse = direction.recip();
        let a = -origin * inverse;
        let b = a + inverse;
        let t0 = a.min(b).max_element().max(0.0);
        let t1 = a.max(b).min_element().min(t_max);
        // Rays with a coordinate that is not a number would otherwise slip through every comparison.
        if t0 < t1 && (origin + direction).is_finite() {
            let origin = origin + direction * t0;
            Some((t0, Self { origin, direction, inverse, t_end: t1 - t0 }))
        } else {
            None
        }
    }

    /// The point at parameter `t`.
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
        // Along a face, and with what is not a number.
        assert_eq!(interval([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]), Some((1.0, 2.0)));
        assert_eq!(interval([f32::NAN, 0.5, 0.5], [1.0, 0.0, 0.0]), None);
        assert_eq!(interval([0.5, 0.5, 0.5], [1.0, f32::NAN, 0.0]), None);
        let ray = Ray { origin: Vec3::new(-1.0, 0.5, 0.5), direction: Vec3::X };
        assert_eq!(BoxRay::enter(&ray, &Affine3A::IDENTITY, 1.5).map(|(_, inside)| inside.t_end), Some(0.5));
        assert!(BoxRay::enter(&ray, &Affine3A::IDENTITY, 1.0).is_none());
    }
}
