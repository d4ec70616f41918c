//! Surfaces: shapes in world space that can be intersected by rays.

mod disk;
mod mesh;
mod oriented_box;
mod plane;
mod rectangle;
mod solid;
mod sphere;

pub use disk::Disk;
pub use mesh::{Mesh, MeshError, MeshInstance, OpenEdge};
pub use oriented_box::OrientedBox;
pub use plane::Plane;
pub use rectangle::Rectangle;
pub use solid::Solid;
pub use sphere::Sphere;

use crate::material::Material;
use crate::math::Ray;
use glam::{Vec2, Vec3};

/// Intersection of a ray with a surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceHit {
    /// Distance along the ray.
    pub t: f32,
    /// Unit normal of the geometry, outward; that of a rectangle, a disk or an open mesh points to its
    /// emitting side.
    pub normal: Vec3,
    /// Triangle of a mesh; 0 on other shapes.
    pub triangle: u32,
    /// Barycentric coordinates of the second and third vertex of the triangle.
    pub barycentric: Vec2,
}

impl SurfaceHit {
    /// Creates an intersection with a shape that has no triangles.
    #[must_use]
    #[inline]
    pub fn new(t: f32, normal: Vec3) -> Self {
        Self { t, normal, triangle: 0, barycentric: Vec2::ZERO }
    }
}

/// Point of a surface from which paths go on.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// Position.
    pub position: Vec3,
    /// Bound of the rounding error of the position, scene units.
    pub error: f32,
    /// Unit normal that shading uses, outward: interpolated where a mesh has normals at its vertices.
    pub shading_normal: Vec3,
}

/// Rounding error of a position relative to the largest coordinate that it was computed from: 8 units in the
/// last place.
const ROUNDING: f32 = 1e-6;

/// Shape of a surface.
#[derive(Clone, Debug)]
pub enum Shape {
    /// A rectangle.
    Rectangle(Rectangle),
    /// A disk.
    Disk(Disk),
    /// A sphere.
    Sphere(Sphere),
    /// An infinite plane.
    Plane(Plane),
    /// A box of any orientation.
    Box(OrientedBox),
    /// A triangle mesh.
    Mesh(MeshInstance),
}

impl Shape {
    /// Nearest intersection at `0 < t < t_max`.
    #[must_use]
    #[inline]
    pub fn intersect(&self, ray: &Ray, t_max: f32) -> Option<SurfaceHit> {
        match self {
            Self::Rectangle(s) => s.intersect(ray, t_max),
            Self::Disk(s) => s.intersect(ray, t_max),
            Self::Sphere(s) => s.intersect(ray, t_max),
            Self::Plane(s) => s.intersect(ray, t_max),
            Self::Box(s) => s.intersect(ray, t_max),
            Self::Mesh(s) => s.intersect(ray, t_max),
        }
    }

    /// Whether the ray intersects the shape at `0 < t < t_max`.
    #[must_use]
    #[inline]
    pub fn occludes(&self, ray: &Ray, t_max: f32) -> bool {
        match self {
            Self::Mesh(s) => s.occludes(ray, t_max),
            other => other.intersect(ray, t_max).is_some(),
        }
    }

    /// The point of an intersection, as precise as the shape allows: on spheres and meshes the error does not
    /// grow with the distance to the ray's origin.
    #[must_use]
    #[inline]
    pub fn point(&self, ray: &Ray, hit: &SurfaceHit) -> SurfacePoint {
        let by = |position: Vec3, size: f32| SurfacePoint {
            position,
            error: ROUNDING * (position.abs().max_element() + size),
            shading_normal: hit.normal,
        };
        match self {
            Self::Sphere(s) => by(s.center + hit.normal * s.radius, s.radius),
            Self::Mesh(s) => {
                let (position, shading_normal, size) = s.point(hit);
                SurfacePoint { shading_normal, ..by(position, size) }
            }
            Self::Rectangle(_) | Self::Disk(_) | Self::Plane(_) | Self::Box(_) => {
                by(ray.at(hit.t), ray.origin.abs().max_element())
            }
        }
    }
}

/// A shape with its optical behaviour.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Shape.
    pub shape: Shape,
    /// Index of the light that it emits as, on the side of its normal.
    pub light: Option<usize>,
    /// How it scatters light; `None`: it absorbs all light.
    pub material: Option<Material>,
    /// Index of the transparent body that it bounds.
    pub body: Option<u32>,
}
