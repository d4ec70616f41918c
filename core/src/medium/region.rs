//! Regions of space that media fill.

use crate::math::{BoxRay, Ray};
use glam::{Affine3A, Vec3A};

/// Region of space that a medium fills, and the space in which its coefficients are defined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Region {
    /// The unit cube of medium space, given by the transform from world space to medium space.
    Cube(Affine3A),
    /// A ball about the origin of world space, with this radius. Medium space is world space.
    Ball(f32),
    /// All of world space, without a boundary. Medium space is world space.
    Everywhere,
}

impl Region {
    /// Clips a ray of world space, with 0 ≤ t ≤ t_max, to the region. Returns the parameter of the entry and
    /// the segment in medium space; `None` if the ray misses the region. `t_end` of the segment is infinite
    /// where the ray never leaves.
    #[must_use]
    #[inline]
    pub fn enter(&self, ray: &Ray, t_max: f32) -> Option<(f32, BoxRay)> {
        match self {
            Self::Cube(medium_from_world) => BoxRay::enter(ray, medium_from_world, t_max),
            Self::Ball(radius) => {
                let [t0, t1] = within_ball(ray, *radius)?;
                stretch(ray, t0.max(0.0), t1.min(t_max))
            }
            Self::Everywhere => stretch(ray, 0.0, t_max),
        }
    }

    /// Transform from world space to medium space.
    #[must_use]
    pub fn medium_from_world(&self) -> Affine3A {
        match self {
            Self::Cube(medium_from_world) => *medium_from_world,
            Self::Ball(_) | Self::Everywhere => Affine3A::IDENTITY,
        }
    }
}

/// Parameters at which a ray enters and leaves a ball about the origin; `None` if it misses.
///
/// The half chord follows from the point of the ray nearest to the centre, which loses fewer digits for a
/// distant ray origin than the discriminant b² − c does.
fn within_ball(ray: &Ray, radius: f32) -> Option<[f32; 2]> {
    let middle = -ray.origin.dot(ray.direction);
    let nearest = ray.at(middle).length();
    let half_squared = (radius - nearest) * (radius + nearest);
    (half_squared > 0.0).then(|| {
        let half = half_squared.sqrt();
        [middle - half, middle + half]
    })
}

/// Segment of a ray in world space; `None` if it is empty.
fn stretch(ray: &Ray, t0: f32, t1: f32) -> Option<(f32, BoxRay)> {
    let direction = Vec3A::from(ray.direction);
    (t0 < t1 && ray.origin.is_finite() && direction.is_finite()).then(|| {
        let segment =
            BoxRay { origin: ray.at(t0).into(), direction, inverse: direction.recip(), t_end: t1 - t0 };
        (t0, segment)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn a_chord_of_a_ball_from_outside_inside_and_far_away() {
        let chord = |origin: Vec3, direction: Vec3, t_max| {
            Region::Ball(2.0)
                .enter(&Ray { origin, direction }, t_max)
                .map(|(t0, inside)| (t0, t0 + inside.t_end))
        };
        assert_eq!(chord(Vec3::new(-5.0, 0.0, 0.0), Vec3::X, f32::INFINITY), Some((3.0, 7.0)));
        assert_eq!(chord(Vec3::ZERO, Vec3::Z, f32::INFINITY), Some((0.0, 2.0)));
        assert_eq!(chord(Vec3::ZERO, Vec3::Z, 0.5), Some((0.0, 0.5)));
        assert_eq!(chord(Vec3::new(-5.0, 2.5, 0.0), Vec3::X, f32::INFINITY), None);
        assert_eq!(chord(Vec3::new(5.0, 0.0, 0.0), Vec3::X, f32::INFINITY), None);
        let (t0, t1) = chord(Vec3::new(-1e5, 1.0, 0.0), Vec3::X, f32::INFINITY).unwrap();
        assert!((t1 - t0 - 12f32.sqrt()).abs() < 0.02, "{t0} {t1}");
    }

    #[test]
    fn a_region_without_a_boundary_is_never_left() {
        let ray = Ray { origin: Vec3::ONE, direction: Vec3::Y };
        let (t0, inside) = Region::Everywhere.enter(&ray, f32::INFINITY).unwrap();
        assert_eq!((t0, inside.t_end), (0.0, f32::INFINITY));
        let nan = Ray { origin: Vec3::NAN, ..ray };
        assert!(Region::Everywhere.enter(&nan, 1.0).is_none());
    }
}
