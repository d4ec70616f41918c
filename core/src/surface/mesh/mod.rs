//! Triangle meshes.
//!
//! A mesh is stored in *mesh space*, in which it fits into the unit cube, whatever the units and the origin of
//! its file; a transform places it in the world. Rays keep their parameter `t` in mesh space, as in medium
//! space.

mod closed;
mod instance;
mod ray;

pub use closed::OpenEdge;
pub use instance::MeshInstance;

use glam::{DAffine3, DVec3, Vec3};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use ray::MeshRay;
use std::fmt;
use std::sync::OnceLock;
use std::time::Duration;

/// Margin of the boxes of triangles in mesh space, several times the rounding error of the slab test there.
const MARGIN: Vec3 = Vec3::splat(1e-6);

/// Triangle mesh with its bounding volume hierarchy.
#[derive(Clone)]
pub struct Mesh {
    /// Positions in mesh space.
    positions: Vec<Vec3>,
    /// Unit normals at the vertices; empty if the mesh is not smooth.
    normals: Vec<Vec3>,
    /// Indices of the vertices of every triangle, in the order of the hierarchy.
    triangles: Vec<[u32; 3]>,
    bvh: Bvh2,
    /// Uniform scale and translation from mesh space to the space of the file.
    object_from_mesh: DAffine3,
    open_edge: OnceLock<Option<OpenEdge>>,
}

impl fmt::Debug for Mesh {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "Mesh({} vertices, {} triangles)", self.positions.len(), self.triangles.len())
    }
}

/// Mesh data that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// There is no triangle.
    #[error("has no triangles: export faces, not only points or edges")]
    Empty,
    /// A coordinate is not a finite number.
    #[error("vertex {0} has a coordinate that is not a finite number: repair it in the modelling program")]
    NotFinite(usize),
    /// A triangle refers to a vertex that does not exist.
    #[error("triangle {triangle} refers to vertex {vertex}, but there are only {count} vertices")]
    Index {
        /// Triangle, counted from 0.
        triangle: usize,
        /// Vertex, counted from 0.
        vertex: u32,
        /// Number of vertices.
        count: usize,
    },
    /// All triangles lie in a point.
    #[error("all {0} triangles have zero area")]
    NoArea(usize),
}

impl Mesh {
    /// Creates a mesh from positions in the space of its file, unit normals at the vertices (or none) and
    /// triangles whose vertices are in counter-clockwise order as seen from outside. Triangles without area
    /// are left out; they cannot be hit.
    ///
    /// # Errors
    /// When there is no triangle with an area, a coordinate that is not finite, or an index out of range.
    pub fn new(
        positions: &[DVec3],
        normals: Vec<Vec3>,
        triangles: impl IntoIterator<Item = [u32; 3]>,
    ) -> Result<Self, MeshError> {
        if let Some(bad) = positions.iter().position(|p| !p.is_finite()) {
            return Err(MeshError::NotFinite(bad));
        }
        let triangles: Vec<[u32; 3]> = triangles.into_iter().collect();
        let count = positions.len();
        for (triangle, indices) in triangles.iter().enumerate() {
            if let Some(vertex) = indices.iter().copied().find(|index| *index as usize >= count) {
                return Err(MeshError::Index { triangle, vertex, count });
            }
        }
        let used = || triangles.iter().flatten().map(|index| positions[*index as usize]);
        let lo = used().reduce(DVec3::min).ok_or(MeshError::Empty)?;
        let size = (used().reduce(DVec3::max).ok_or(MeshError::Empty)? - lo).max_element();
        if size <= 0.0 || !size.is_finite() {
            return Err(MeshError::NoArea(triangles.len()));
        }
        let object_from_mesh =
            DAffine3::from_scale_rotation_translation(DVec3::splat(size), glam::DQuat::IDENTITY, lo);
        let positions: Vec<Vec3> = positions.iter().map(|p| ((*p - lo) / size).as_vec3()).collect();
        let corners = |indices: &[u32; 3]| indices.map(|index| positions[index as usize]);
        let with_area: Vec<[u32; 3]> = triangles
            .iter()
            .copied()
            .filter(|indices| {
                let [a, b, c] = corners(indices);
                (b - a).cross(c - a) != Vec3::ZERO
            })
            .collect();
        if with_area.is_empty() {
            return Err(MeshError::NoArea(triangles.len()));
        }
        let around = |indices: &[u32; 3]| {
            let [a, b, c] = corners(indices);
            let (lo, hi) = (a.min(b).min(c) - MARGIN, a.max(b).max(c) + MARGIN);
            // By arrays, as the hierarchy may use another version of glam.
            Aabb::new(lo.to_array().into(), hi.to_array().into())
        };
        let boxes: Vec<Aabb> = with_area.iter().map(around).collect();
        let mut bvh = build_bvh2(&boxes, BvhBuildParams::fast_build(), &mut Duration::default());
        // In the order of the hierarchy, leaves refer to triangles directly.
        let triangles = bvh.primitive_indices.iter().map(|index| with_area[*index as usize]).collect();
        bvh.primitive_indices = Vec::new();
        Ok(Self { positions, normals, triangles, bvh, object_from_mesh, open_edge: OnceLock::new() })
    }

    /// The cube from (0, 0, 0) to (1, 1, 1), of twelve triangles.
    ///
    /// # Errors
    /// As for [`Self::new`].
    pub fn cube() -> Result<Self, MeshError> {
        let corners =
            (0..8u8).map(|i| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)));
        // Faces −x, +x, −y, +y, −z, +z, counter-clockwise as seen from outside.
        let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let triangles = faces.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
        Self::new(&corners.collect::<Vec<_>>(), Vec::new(), triangles)
    }

    /// Number of triangles that have an area.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// Number of vertices.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// Memory in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.positions)
            + size_of_val(&*self.normals)
            + size_of_val(&*self.triangles)
            + size_of_val(&*self.bvh.nodes)
    }

    /// Returns whether the mesh has normals at its vertices.
    #[must_use]
    pub fn is_smooth(&self) -> bool {
        !self.normals.is_empty()
    }

    /// Transform from mesh space to the space of the file.
    #[must_use]
    pub fn object_from_mesh(&self) -> &DAffine3 {
        &self.object_from_mesh
    }

    /// Axis-aligned bounds in mesh space.
    #[must_use]
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let corners = || self.triangles.iter().flatten().map(|index| self.positions[*index as usize]);
        (corners().fold(Vec3::INFINITY, Vec3::min), corners().fold(Vec3::NEG_INFINITY, Vec3::max))
    }

    /// Corners of a triangle in mesh space.
    #[must_use]
    pub fn corners(&self, triangle: u32) -> [Vec3; 3] {
        self.triangles[triangle as usize].map(|index| self.positions[index as usize])
    }

    /// An edge that is not shared by two triangles of opposite orientation; `None` if the mesh is closed.
    /// Computed once.
    #[must_use]
    pub fn open_edge(&self) -> Option<OpenEdge> {
        *self.open_edge.get_or_init(|| closed::open_edge(self))
    }

    /// Interpolated unit normal of a triangle at barycentric coordinates, in mesh space; zero if the mesh is
    /// not smooth there.
    fn interpolated_normal(&self, triangle: u32, u: f32, v: f32) -> Vec3 {
        if self.normals.is_empty() {
            return Vec3::ZERO;
        }
        let [a, b, c] = self.triangles[triangle as usize]
            .map(|index| self.normals.get(index as usize).copied().unwrap_or(Vec3::ZERO));
        a * (1.0 - u - v) + b * u + c * v
    }

    /// Nearest intersection of a ray in mesh space, if any.
    fn nearest(&self, ray: &MeshRay, t_max: f32) -> Option<ray::TriangleHit> {
        let mut nearest = None;
        let bounded = ray.bounded(t_max);
        self.bvh.ray_traverse(bounded, &mut obvhs::ray::RayHit::none(), |bounded, index| {
            match ray.intersect(self.corners(index as u32)) {
                Some(hit) if hit.t > 0.0 && hit.t < bounded.tmax => {
                    nearest = Some(ray::TriangleHit { triangle: index as u32, ..hit });
                    hit.t
                }
                _ => f32::INFINITY,
            }
        });
        nearest
    }

    /// Whether a ray in mesh space intersects a triangle at `0 < t < t_max`.
    fn occludes(&self, ray: &MeshRay, t_max: f32) -> bool {
        !self.bvh.ray_traverse_miss(ray.bounded(t_max), |_, index| {
            ray.intersect(self.corners(index as u32))
                .map_or(f32::INFINITY, |hit| if hit.t > 0.0 { hit.t } else { f32::INFINITY })
        })
    }

    /// Calls `visit` for every intersection of a ray in mesh space at t > 0, in any order.
    fn all_hits(&self, ray: &MeshRay, mut visit: impl FnMut(&ray::TriangleHit)) {
        self.bvh.ray_traverse_anyhit(ray.bounded(f32::INFINITY), |_, index| {
            if let Some(hit) = ray.intersect(self.corners(index as u32)).filter(|hit| hit.t > 0.0) {
                visit(&hit);
            }
        });
    }
}
