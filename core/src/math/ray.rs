//! Rays and the unit box.

use glam::Vec3;

/// A half-line. In world space its direction has unit length, so that `t` is a distance; a ray taken
/// into another space keeps its `t` and may have a direction of any length.
#[derive(Clone, Copy, Debug)]
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

/// The cube from (0,0,0) to (1,1,1).
#[derive(Clone, Copy, Debug)]
pub struct UnitBox;

impl UnitBox {
    /// The interval of `t ≥ 0` inside the cube, if the ray meets it (slab test).
    #[must_use]
    pub fn interval(ray: &Ray) -> Option<(f32, f32)> {
        let inverse = ray.direction.recip();
        let a = -ray.origin * inverse;
        let b = (Vec3::ONE - ray.origin) * inverse;
        let (near, far) = (a.min(b), a.max(b));
        let mut t0 = 0.0f32;
        let mut t1 = f32::INFINITY;
        for axis in 0..3 {
            if near[axis] > t0 {
                t0 = near[axis];
            }
            if far[axis] < t1 {
                t1 = far[axis];
            }
            if ray.direction[axis] == 0.0 && !(0.0..=1.0).contains(&ray.origin[axis]) {
                return None;
            }
        }
        // Rays with a coordinate that is not a number would otherwise slip through every comparison.
        (t0 < t1 && ray.origin.is_finite() && ray.direction.is_finite()).then_some((t0, t1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_from_outside_inside_and_beside() {
        let ray = |o: [f32; 3], d: [f32; 3]| Ray { origin: o.into(), direction: d.into() };
        assert_eq!(UnitBox::interval(&ray([-1.0, 0.5, 0.5], [1.0, 0.0, 0.0])), Some((1.0, 2.0)));
        assert_eq!(UnitBox::interval(&ray([0.5, 0.5, 0.5], [0.0, 0.0, 2.0])), Some((0.0, 0.25)));
        assert_eq!(UnitBox::interval(&ray([-1.0, 1.5, 0.5], [1.0, 0.0, 0.0])), None);
        assert_eq!(UnitBox::interval(&ray([2.0, 0.5, 0.5], [1.0, 0.0, 0.0])), None);
    }
}
