//! Surfaces: shapes in world space that rays meet.

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

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceHit {
    /// Distance along the ray.
    pub t: f32,
    /// Unit normal, outward; a rectangle's points to its emitting side.
    pub normal: Vec3,
}

/// Any shape.
#[derive(Clone, Debug)]
pub enum Shape {
    /// A parallelogram with right angles.
    Rectangle(Rectangle),
    /// A sphere.
    Sphere(Sphere),
    /// An infinite plane.
    Plane(Plane),
    /// A box of any orientation.
    Box(OrientedBox),
}

impl Shape {
    /// The nearest meeting at `0 < t < t_max`.
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

/// What a surface does with light.
#[derive(Clone, Debug)]
pub enum Role {
    /// It is the light with this index; it reflects nothing.
    Light(usize),
    /// It reflects this fraction, the same in all directions (Lambert).
    Diffuse(Spectrum),
}

/// A shape with its role.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Its shape.
    pub shape: Shape,
    /// What it does with light.
    pub role: Role,
}
