//! Regions of space that media fill.

use crate::math::{BoxRay, Ray};
use crate::surface::{Solid, Sphere};
use glam::{Affine3A, Vec3, Vec3A};
use std::sync::Arc;

/// Region of space that a medium fills, and the space in which its coefficients are defined.
#[derive(Clone, Debug)]
pub enum Region {
    /// The unit cube of medium space, given by the transform from world space to medium space.
    Cube(Affine3A),
    /// A ball about the origin of world space, with this radius. Medium space is world space.
    Ball(f32),
    /// The inside of a closed shape.
    Inside {
        /// The shape.
        solid: Arc<Solid>,
        /// Transform from world space to medium space.
        medium_from_world: Affine3A,
        /// Whether the medium also ends at the unit cube of medium space, as grids do.
        cut_by_cube: bool,
    },
    /// All of world space, without a boundary. Medium space is world space.
    Everywhere,
}

impl Region {
    /// Clips a ray of world space, with 0 ≤ t ≤ t_max, to a convex region. Returns the parameter of the entry
    /// and the segment in medium space; `None` if the ray misses the region. `t_end` of the segment is
    /// infinite where the ray never leaves. In a region that is not convex, returns the first stretch alone.
    #[must_use]
    #[inline]
    pub fn enter(&self, ray: &Ray, t_max: f32) -> Option<(f32, BoxRay)> {
        match self {
            Self::Cube(medium_from_world) => BoxRay::enter(ray, medium_from_world, t_max),
            Self::Ball(radius) => {
                let [t0, t1] = Sphere { center: Vec3::ZERO, radius: *radius }.interval(ray)?;
                stretch(ray, t0.max(0.0), t1.min(t_max))
            }
            Self::Everywhere => stretch(ray, 0.0, t_max),
            Self::Inside { .. } => {
                let mut first = None;
                self.stretches(ray, t_max, |t0, inside| first = first.or(Some((t0, inside))));
                first
            }
        }
    }

    /// As [`Self::enter`], for every stretch of the ray inside the region, in order.
    #[inline]
    pub fn stretches(&self, ray: &Ray, t_max: f32, mut visit: impl FnMut(f32, BoxRay)) {
        let Self::Inside { solid, medium_from_world, cut_by_cube } = self else {
            if let Some((t0, inside)) = self.enter(ray, t_max) {
                visit(t0, inside);
            }
            return;
        };
        let (from, to) = if *cut_by_cube {
            let Some((t0, inside)) = BoxRay::enter(ray, medium_from_world, t_max) else { return };
            (t0, t0 + inside.t_end)
        } else {
            (0.0, t_max)
        };
        solid.stretches(ray, |t0, t1| {
            if let Some((t0, inside)) = stretch(ray, t0.max(from), t1.min(to)) {
                let turned = |v: Vec3A| medium_from_world.transform_vector3a(v);
                visit(t0, inside.moved(medium_from_world.transform_point3a(inside.origin), turned));
            }
        });
    }

    /// Returns whether no ray enters the region more than once.
    #[must_use]
    pub fn is_convex(&self) -> bool {
        match self {
            Self::Inside { solid, .. } => solid.is_convex(),
            Self::Cube(_) | Self::Ball(_) | Self::Everywhere => true,
        }
    }

    /// Returns whether the region reaches to infinity.
    #[must_use]
    pub fn is_unbounded(&self) -> bool {
        matches!(self, Self::Everywhere)
    }

    /// Transform from world space to medium space.
    #[must_use]
    pub fn medium_from_world(&self) -> Affine3A {
        match self {
            Self::Cube(medium_from_world) | Self::Inside { medium_from_world, .. } => *medium_from_world,
            Self::Ball(_) | Self::Everywhere => Affine3A::IDENTITY,
        }
    }
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

    /// A grid's cube inside a ball, and a uniform medium in the same ball.
    #[test]
    fn a_shape_cuts_the_cube_of_a_grid() {
        let solid = Arc::new(Solid::Sphere(Sphere { center: Vec3::new(1.0, 0.5, 0.5), radius: 0.75 }));
        let medium_from_world = Affine3A::from_scale(Vec3::splat(0.5));
        let chord = |cut_by_cube: bool, x: f32, t_max: f32| {
            let region = Region::Inside { solid: Arc::clone(&solid), medium_from_world, cut_by_cube };
            let ray = Ray { origin: Vec3::new(x, 0.5, 0.5), direction: Vec3::X };
            region.enter(&ray, t_max).map(|(t0, inside)| (t0, t0 + inside.t_end, inside.at(0.25).x))
        };
        // The cube reaches from 0 to 2, the ball from 0.25 to 1.75.
        assert_eq!(chord(true, -1.0, f32::INFINITY), Some((1.25, 2.75, 0.25)));
        assert_eq!(chord(false, 1.0, f32::INFINITY), Some((0.0, 0.75, 0.625)));
        assert_eq!(chord(true, 1.0, 0.5), Some((0.0, 0.5, 0.625)));
        assert_eq!(chord(true, 3.0, f32::INFINITY), None);
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
