//! Surfaces: shapes in world space that can be intersected by rays.

mod oriented_box;
mod plane;
mod rectangle;
mod sphere;

pub use oriented_box::OrientedBox;
pub use plane::Plane;
pub use rectangle::Rectangle;
pub use sphere::Sphere;

use crate::math::Ray;
use crate::spectrum::Spectrum;
use glam::Vec3;

/// Intersection of a ray with a surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceHit {
    /// Distance along the ray.
    pub t: f32,
    /// Unit normal, outward; that of a rectangle points to its emitting side.
    pub normal: Vec3,
}

/// Shape of a surface.
#[derive(Clone, Debug)]
pub enum Shape {
    /// A rectangle.
    Rectangle(Rectangle),
    /// A sphere.
    Sphere(Sphere),
    /// An infinite plane.
    Plane(Plane),
    /// A box of any orientation.
    Box(OrientedBox),
}

impl Shape {
    /// Nearest intersection at `0 < t < t_max`.
    #[must_use]
    pub fn intersect(&self, ray: &Ray, t_max: f32) -> Option<SurfaceHit> {
        match self {
            Self::Rectangle(s) => s.intersect(ray, t_max),
            Self::Sphere(s) => s.intersect(ray, t_max),
            Self::Plane(s) => s.intersect(ray, t_max),
            Self::Box(s) => s.intersect(ray, t_max),
        }
    }
}

/// Optical behaviour of a surface.
#[derive(Clone, Debug)]
pub enum Role {
    /// Emits as the light with this index, and reflects nothing.
    Light(usize),
    /// Reflects diffusely (Lambert), with this albedo.
    Diffuse(Spectrum),
}

/// A shape with its optical behaviour.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Shape.
    pub shape: Shape,
    /// Optical behaviour.
    pub role: Role,
}
