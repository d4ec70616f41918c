//! A solid box of any orientation.

use super::SurfaceHit;
use crate::math::Ray;
use glam::{Mat3, Quat, Vec3};

/// A box given by centre, half edge lengths and rotation.
#[derive(Clone, Copy, Debug)]
pub struct OrientedBox {
    /// Centre.
    pub center: Vec3,
    /// Half of the edge lengths.
    pub half_size: Vec3,
    /// Rotation from the box's axes to world space.
    pub world_from_box: Quat,
}

impl OrientedBox {
    /// Nearest intersection at `0 < t < t_max`: entry from outside, exit from inside.
    #[must_use]
    pub fn intersect(&self, ray: &Ray, t_max: f32) -> Option<SurfaceHit> {
        let box_from_world = self.world_from_box.inverse();
        let origin = box_from_world * (ray.origin - self.center);
        let direction = box_from_world * ray.direction;
        let inverse = direction.recip();
        let a = (-self.half_size - origin) * inverse;
        let b = (self.half_size - origin) * inverse;
        let (near, far) = (a.min(b), a.max(b));
        let (t0, t1) = (near.max_element(), far.min_element());
        if t0.is_nan() || t1.is_nan() || t0 >= t1 {
            return None;
        }
        let (t, faces) = if t0 > 0.0 { (t0, near) } else { (t1, far) };
        if !(t > 0.0 && t < t_max) {
            return None;
        }
        let local = origin + direction * t;
        let mut normal = Vec3::ZERO;
        for axis in 0..3 {
            if faces[axis] == t {
                normal[axis] = local[axis].signum();
                break;
            }
        }
        Some(SurfaceHit::new(t, self.world_from_box * normal))
    }

    /// Parameters at which the ray's line enters and leaves the box; `None` if it misses.
    #[must_use]
    pub fn interval(&self, ray: &Ray) -> Option<[f32; 2]> {
        // A component this small has no effect, and its inverse is finite, so that 0 · ∞ never occurs.
        const TINY: Vec3 = Vec3::splat(1e-20);
        let box_from_world = self.world_from_box.inverse();
        let origin = box_from_world * (ray.origin - self.center);
        let direction = box_from_world * ray.direction;
        let inverse = Vec3::select(direction.abs().cmplt(TINY), TINY, direction).recip();
        let a = (-self.half_size - origin) * inverse;
        let b = (self.half_size - origin) * inverse;
        let (t0, t1) = (a.min(b).max_element(), a.max(b).min_element());
        (t0 < t1).then_some([t0, t1])
    }

    /// Returns whether a point is inside.
    #[must_use]
    pub fn contains(&self, point: Vec3) -> bool {
        let local = self.world_from_box.inverse() * (point - self.center);
        local.abs().cmplt(self.half_size).all()
    }

    /// Corners, centres of edges and centres of faces.
    #[must_use]
    pub fn surface_points(&self) -> Vec<Vec3> {
        let at = |i: u8| f32::from(i % 3) - 1.0;
        let points = (0..27).filter(|i| *i != 13).map(|i| Vec3::new(at(i), at(i / 3), at(i / 9)));
        points.map(|p| self.center + self.world_from_box * (p * self.half_size)).collect()
    }

    /// Axis-aligned bounds in world space.
    #[must_use]
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let m = Mat3::from_quat(self.world_from_box);
        let half = m.x_axis.abs() * self.half_size.x
            + m.y_axis.abs() * self.half_size.y
            + m.z_axis.abs() * self.half_size.z;
        (self.center - half, self.center + half)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entry_exit_and_miss() {
        let cube = OrientedBox {
            center: Vec3::new(0.0, 0.0, 5.0),
            half_size: Vec3::new(1.0, 1.0, 1.0),
            world_from_box: Quat::from_rotation_y(std::f32::consts::FRAC_PI_2),
        };
        let ray = Ray { origin: Vec3::new(0.1, 0.2, 0.0), direction: Vec3::Z };
        let hit = cube.intersect(&ray, f32::INFINITY).expect("the ray hits the box");
        assert!((hit.t - 4.0).abs() < 1e-5 && (hit.normal - Vec3::NEG_Z).length() < 1e-5);
        assert!(cube.intersect(&ray, 3.9).is_none());
        let inside = Ray { origin: Vec3::new(0.1, 0.2, 5.0), direction: Vec3::Z };
        let hit = cube.intersect(&inside, f32::INFINITY).expect("from inside");
        assert!((hit.t - 1.0).abs() < 1e-5 && (hit.normal - Vec3::Z).length() < 1e-5);
        let beside = Ray { origin: Vec3::new(3.0, 0.2, 0.0), direction: Vec3::Z };
        assert!(cube.intersect(&beside, f32::INFINITY).is_none());
    }
}
