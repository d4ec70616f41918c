//! Mesh light: a triangle is drawn from a tree by its expected contribution, then a point on it uniformly.
//!
//! ```text
//!   p(ω) = P(triangle) · (1/A) · d² / |cos θ at the light|
//! ```
//!
//! P is a function of the point that receives the light alone, so that a walk which meets the triangle
//! computes the same value as the connection that draws it.

use super::mesh_tree::MeshTree;
use super::{Emitter, LightPoint, LightSample};
use crate::spectrum::{Components, Spectrum};
use crate::surface::MeshInstance;
use glam::{Vec2, Vec3};

/// Triangle mesh that emits on the outer side of its triangles.
#[derive(Clone, Debug)]
pub struct MeshLight {
    shape: MeshInstance,
    tree: MeshTree,
    /// Emitted radiance.
    pub radiance: Spectrum,
}

impl MeshLight {
    /// Creates a light of a placed mesh.
    #[must_use]
    pub fn new(shape: MeshInstance, radiance: Spectrum) -> Self {
        let tree = MeshTree::new(&shape);
        Self { shape, tree, radiance }
    }

    /// The mesh.
    #[must_use]
    pub fn shape(&self) -> &MeshInstance {
        &self.shape
    }

    /// Centre of a ball around the mesh.
    #[must_use]
    pub fn center(&self) -> Vec3 {
        self.tree.ball().0
    }

    /// Radius of a ball around the mesh.
    #[must_use]
    pub fn radius(&self) -> f32 {
        self.tree.ball().1
    }

    /// Area in square scene units.
    #[must_use]
    pub fn area(&self) -> f32 {
        self.tree.area()
    }
}

impl Emitter for MeshLight {
    fn sample(&self, from: Vec3, u: Vec2) -> Option<LightSample> {
        let (triangle, u) = self.tree.draw(from, u)?;
        let [a, b, c] = self.shape.corners(triangle);
        // Uniform over the triangle.
        let root = u.x.sqrt();
        let (v, w) = (root * (1.0 - u.y), root * u.y);
        let to_light = a * (1.0 - v - w) + b * v + c * w - from;
        let distance = to_light.length();
        let point = LightPoint { direction: to_light / distance, distance, triangle };
        let density = self.density(from, &point);
        (distance > 0.0 && density > 0.0).then_some(LightSample { point, density })
    }

    fn density(&self, from: Vec3, at: &LightPoint) -> f32 {
        let [a, b, c] = self.shape.corners(at.triangle);
        let cosine = -at.direction.dot(self.shape.normal(at.triangle));
        let area = 0.5 * (b - a).cross(c - a).length();
        if cosine <= 0.0 || area <= 0.0 {
            return 0.0;
        }
        self.tree.probability(from, at.triangle) * at.distance * at.distance / (area * cosine)
    }

    fn radiance<const N: usize, C: Components<N>>(&self, _direction: Vec3, components: &C) -> C::Radiance {
        components.radiance(&self.radiance)
    }
}
