//! Closed shapes, which bound media.

use super::{MeshInstance, OrientedBox, Sphere};
use crate::math::Ray;
use glam::Vec3;

/// Closed shape with an inside.
#[derive(Clone, Debug)]
pub enum Solid {
    /// A sphere.
    Sphere(Sphere),
    /// A box of any orientation.
    Box(OrientedBox),
    /// A closed triangle mesh.
    Mesh(MeshInstance),
}

impl Solid {
    /// Returns whether no ray enters the shape more than once.
    #[must_use]
    pub fn is_convex(&self) -> bool {
        !matches!(self, Self::Mesh(_))
    }

    /// Calls `visit` with the parameters of entry and exit of every stretch of the ray's line inside the
    /// shape that ends at t > 0, in order. A stretch around the ray's origin starts at t ≤ 0.
    pub fn stretches(&self, ray: &Ray, mut visit: impl FnMut(f32, f32)) {
        let interval = match self {
            Self::Sphere(sphere) => sphere.interval(ray),
            Self::Box(solid) => solid.interval(ray),
            Self::Mesh(mesh) => return mesh.stretches(ray, visit),
        };
        if let Some([t0, t1]) = interval.filter(|[_, t1]| *t1 > 0.0) {
            visit(t0, t1);
        }
    }

    /// Axis-aligned bounds in world space.
    #[must_use]
    pub fn bounds(&self) -> (Vec3, Vec3) {
        match self {
            Self::Sphere(sphere) => (sphere.center - sphere.radius, sphere.center + sphere.radius),
            Self::Box(solid) => solid.bounds(),
            Self::Mesh(mesh) => mesh.bounds(),
        }
    }
}
