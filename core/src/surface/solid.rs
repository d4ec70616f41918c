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

    /// Returns whether a point is inside.
    #[must_use]
    pub fn contains(&self, point: Vec3) -> bool {
        match self {
            Self::Sphere(sphere) => point.distance_squared(sphere.center) < sphere.radius * sphere.radius,
            Self::Box(solid) => solid.contains(point),
            Self::Mesh(_) => {
                // A direction along no axis, edge or diagonal of common shapes.
                let ray = Ray { origin: point, direction: Vec3::new(0.371_390_7, 0.557_086, 0.742_781_4) };
                let mut inside = false;
                self.stretches(&ray, |t0, _| inside |= t0 <= 0.0);
                inside
            }
        }
    }

    /// Points on the surface, spread over all of it.
    #[must_use]
    pub fn surface_points(&self) -> Vec<Vec3> {
        match self {
            Self::Sphere(sphere) => (0..64u8)
                .map(|i| {
                    let z = 1.0 - (2.0 * f32::from(i) + 1.0) / 64.0;
                    let (sin, cos) = (2.399_963_2 * f32::from(i)).sin_cos();
                    let r = (1.0 - z * z).sqrt();
                    sphere.center + Vec3::new(r * cos, r * sin, z) * sphere.radius
                })
                .collect(),
            Self::Box(solid) => solid.surface_points(),
            Self::Mesh(mesh) => mesh.vertices(256),
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
