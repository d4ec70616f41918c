//! A mesh placed in the world.

use super::Mesh;
use super::ray::{MeshRay, TriangleHit};
use crate::math::Ray;
use crate::surface::SurfaceHit;
use glam::{Affine3A, DAffine3, Vec3};
use smallvec::SmallVec;
use std::sync::Arc;

/// Mesh with its placement.
#[derive(Clone, Debug)]
pub struct MeshInstance {
    mesh: Arc<Mesh>,
    world_from_mesh: Affine3A,
    mesh_from_world: Affine3A,
}

/// Ray in mesh space that starts where it enters the mesh's bounds.
struct Entered {
    ray: MeshRay,
    /// Parameter of the entry along the ray in the world.
    t0: f32,
    /// Length of the ray's direction in mesh space.
    per_unit: f32,
}

impl MeshInstance {
    /// Places a mesh. `None` if the transform has no inverse.
    #[must_use]
    pub fn new(mesh: Arc<Mesh>, world_from_object: &DAffine3) -> Option<Self> {
        let world_from_mesh = *world_from_object * *mesh.object_from_mesh();
        let mesh_from_world = world_from_mesh.inverse();
        let single =
            |m: &DAffine3| Affine3A::from_mat3_translation(m.matrix3.as_mat3(), m.translation.as_vec3());
        let (world_from_mesh, mesh_from_world) = (single(&world_from_mesh), single(&mesh_from_world));
        (world_from_mesh.is_finite() && mesh_from_world.is_finite()).then_some(Self {
            mesh,
            world_from_mesh,
            mesh_from_world,
        })
    }

    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Axis-aligned bounds in world space.
    #[must_use]
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let (lo, hi) = self.mesh.bounds();
        let corners = (0..8u8).map(|i| {
            let pick = |axis: usize| if i >> axis & 1 == 0 { lo[axis] } else { hi[axis] };
            self.world_from_mesh.transform_point3(Vec3::new(pick(0), pick(1), pick(2)))
        });
        corners.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lo, hi), p| (lo.min(p), hi.max(p)))
    }

    /// At most about `most` vertices in world space.
    #[must_use]
    pub fn vertices(&self, most: usize) -> Vec<Vec3> {
        let step = self.mesh.triangle_count().div_ceil(most).max(1);
        let first = |triangle: usize| self.corners(triangle as u32)[0];
        (0..self.mesh.triangle_count()).step_by(step).map(first).collect()
    }

    /// Corners of a triangle in world space.
    #[must_use]
    pub fn corners(&self, triangle: u32) -> [Vec3; 3] {
        self.mesh.corners(triangle).map(|corner| self.world_from_mesh.transform_point3(corner))
    }

    /// Unit normal of a triangle in world space, outward. Normals transform by the inverse transpose, which
    /// keeps them outside under mirrored placements as well.
    #[must_use]
    pub fn normal(&self, triangle: u32) -> Vec3 {
        let [a, b, c] = self.mesh.corners(triangle);
        self.normal_to_world((b - a).cross(c - a))
    }

    fn normal_to_world(&self, normal: Vec3) -> Vec3 {
        (self.mesh_from_world.matrix3.transpose() * normal.normalize_or_zero()).normalize_or_zero()
    }

    /// Nearest intersection at `0 < t < t_max`.
    #[must_use]
    pub fn intersect(&self, ray: &Ray, t_max: f32) -> Option<SurfaceHit> {
        let entered = self.enter(ray, t_max)?;
        let hit = self.mesh.nearest(&entered.ray, entered.local(t_max))?;
        let t = entered.world(&hit);
        (t > 0.0 && t < t_max).then(|| SurfaceHit {
            t,
            normal: self.normal(hit.triangle),
            triangle: hit.triangle,
            barycentric: hit.barycentric,
        })
    }

    /// Whether the ray intersects the mesh at `0 < t < t_max`.
    #[must_use]
    pub fn occludes(&self, ray: &Ray, t_max: f32) -> bool {
        self.enter(ray, t_max).is_some_and(|entered| self.mesh.occludes(&entered.ray, entered.local(t_max)))
    }

    /// Position and shading normal of an intersection in world space, and the size of the coordinates from
    /// which they are computed.
    pub(in crate::surface) fn point(&self, hit: &SurfaceHit) -> (Vec3, Vec3, f32) {
        let [u, v] = hit.barycentric.to_array();
        let [a, b, c] = self.mesh.corners(hit.triangle);
        let position = self.world_from_mesh.transform_point3(a * (1.0 - u - v) + b * u + c * v);
        let smooth = self.normal_to_world(self.mesh.interpolated_normal(hit.triangle, u, v));
        // An interpolated normal on the other side of the triangle is not usable.
        let shading = if smooth.dot(hit.normal) > 0.0 { smooth } else { hit.normal };
        (position, shading, self.world_from_mesh.translation.abs().max_element())
    }

    /// Calls `visit` with entry and exit of every stretch of the ray inside the closed mesh, at t > 0, in
    /// order; a stretch around the ray's origin starts at 0. Inside is where the surface winds around a point
    /// a number of times other than zero, so that parts may overlap and face inwards.
    pub(in crate::surface) fn stretches(&self, ray: &Ray, mut visit: impl FnMut(f32, f32)) {
        let Some(entered) = self.enter(ray, f32::INFINITY) else { return };
        let mut crossings: SmallVec<[(f32, i32); 8]> = SmallVec::new();
        self.mesh.all_hits(&entered.ray, |hit| {
            crossings.push((entered.world(hit), if hit.enters { 1 } else { -1 }));
        });
        crossings.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let mut winding = -crossings.iter().map(|(_, turn)| turn).sum::<i32>();
        let mut from = 0.0;
        for (t, turn) in crossings {
            let before = winding;
            winding += turn;
            if before == 0 {
                from = t;
            } else if winding == 0 && from < t {
                visit(from, t);
            }
        }
    }

    /// Clips a ray to the bounds of the mesh, so that its origin is close by and nothing is lost to the
    /// rounding of a distant one.
    fn enter(&self, ray: &Ray, t_max: f32) -> Option<Entered> {
        /// Margin around the bounds in mesh space, beyond all rounding.
        const MARGIN: f32 = 1e-3;
        let origin = self.mesh_from_world.transform_point3(ray.origin);
        let direction = self.mesh_from_world.transform_vector3(ray.direction);
        let per_unit = direction.length();
        let direction = direction / per_unit;
        let inverse = direction.recip();
        let a = (Vec3::splat(-MARGIN) - origin) * inverse;
        let b = (Vec3::splat(1.0 + MARGIN) - origin) * inverse;
        // A ray within a face's plane gives NaN, which minimum and maximum ignore.
        let near = a.min(b).max_element().max(0.0);
        let far = a.max(b).min_element();
        if !(near <= far && near < t_max * per_unit) {
            return None;
        }
        let ray = MeshRay::new(origin + direction * near, direction)?;
        Some(Entered { ray, t0: near / per_unit, per_unit })
    }
}

impl Entered {
    /// Parameter in the world of an intersection in mesh space.
    fn world(&self, hit: &TriangleHit) -> f32 {
        self.t0 + hit.t / self.per_unit
    }

    /// Parameter in mesh space of one in the world.
    fn local(&self, t: f32) -> f32 {
        (t - self.t0) * self.per_unit
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DQuat, DVec3};

    fn placed(world_from_object: DAffine3) -> MeshInstance {
        MeshInstance::new(Arc::new(Mesh::cube().unwrap()), &world_from_object).unwrap()
    }

    fn stretches(mesh: &MeshInstance, origin: Vec3, direction: Vec3) -> Vec<[f32; 2]> {
        let mut found = Vec::new();
        mesh.stretches(&Ray { origin, direction: direction.normalize() }, |a, b| found.push([a, b]));
        found
    }

    /// A cube, turned, stretched, mirrored and far away, from outside and inside.
    #[test]
    fn entry_exit_and_normals_under_placements() {
        let half = DAffine3::from_translation(DVec3::splat(-0.5));
        for (scale, at) in [(DVec3::ONE, 0.0), (DVec3::new(2.0, 0.5, -1.0), 10.0), (DVec3::splat(1e-3), 3.0)]
        {
            let turn = DQuat::from_rotation_y(0.7) * DQuat::from_rotation_x(0.3);
            let center = DVec3::new(at, -at, 0.5 * at);
            let world = DAffine3::from_scale_rotation_translation(scale, turn, center);
            let mesh = placed(world * half);
            let axis = (turn * DVec3::Z).as_vec3();
            let half_depth = 0.5 * scale.z.abs() as f32;
            let center = center.as_vec3();
            let ray = Ray { origin: center - axis * 4.0, direction: axis };
            let hit = mesh.intersect(&ray, f32::INFINITY).unwrap();
            assert!((hit.t - (4.0 - half_depth)).abs() < 1e-5, "{scale} {hit:?}");
            assert!((hit.normal + axis).length() < 1e-5, "{scale} {hit:?}");
            assert!(mesh.occludes(&ray, 4.0) && !mesh.occludes(&ray, 4.0 - 1.1 * half_depth));
            let through = stretches(&mesh, ray.origin, axis);
            assert_eq!(through.len(), 1);
            assert!((through[0][1] - through[0][0] - 2.0 * half_depth).abs() < 1e-5, "{through:?}");
            let inside = stretches(&mesh, center, axis);
            assert_eq!(inside.len(), 1);
            assert!(inside[0][0] == 0.0 && (inside[0][1] - half_depth).abs() < 1e-5, "{inside:?}");
            assert!(stretches(&mesh, ray.origin, -axis).is_empty());
        }
    }

    /// Normals of slanted faces are perpendicular to them and point outwards under every placement.
    #[test]
    fn normals_are_perpendicular_to_stretched_faces() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let mesh = Arc::new(Mesh::new(&corners, Vec::new(), faces).unwrap());
        for scale in [DVec3::ONE, DVec3::new(3.0, 0.5, 1.0), DVec3::new(1.0, -2.0, 0.3)] {
            let turn = DQuat::from_rotation_z(0.4);
            let world = DAffine3::from_scale_rotation_translation(scale, turn, DVec3::ONE);
            let placed = MeshInstance::new(Arc::clone(&mesh), &world).unwrap();
            let inside = world.transform_point3(DVec3::splat(0.2)).as_vec3();
            for triangle in 0..4 {
                let [a, b, c] = placed.corners(triangle);
                let normal = placed.normal(triangle);
                assert!(normal.dot(b - a).abs() < 1e-5 && normal.dot(c - a).abs() < 1e-5, "{scale}");
                assert!(normal.dot(a - inside) > 0.0, "{scale}");
            }
        }
    }

    /// Rays through edges, vertices and along the diagonals of faces enter as often as they leave.
    #[test]
    fn a_closed_mesh_is_left_as_often_as_it_is_entered() {
        let mesh = placed(DAffine3::IDENTITY);
        assert!(mesh.mesh().open_edge().is_none());
        let targets = [
            Vec3::ZERO,
            Vec3::ONE,
            Vec3::splat(0.5),
            Vec3::new(0.5, 0.0, 0.0),
            Vec3::new(0.0, 0.5, 0.5),
            Vec3::new(1.0, 0.25, 0.25),
            Vec3::new(0.75, 1.0, 0.75),
        ];
        let mut count = 0;
        for target in targets {
            for x in -2..=2i8 {
                for y in -2..=2i8 {
                    for z in -2..=2i8 {
                        let direction = Vec3::new(f32::from(x), f32::from(y), f32::from(z));
                        if direction == Vec3::ZERO {
                            continue;
                        }
                        let found = stretches(&mesh, target - direction * 4.0, direction);
                        let inside: f32 = found.iter().map(|[a, b]| b - a).sum();
                        assert!(found.len() <= 1 && inside <= 1.74, "{target} {direction}: {found:?}");
                        count += found.len();
                    }
                }
            }
        }
        assert!(count > 300, "{count}");
    }

    #[test]
    fn a_missing_or_turned_face_is_named() {
        let corners: Vec<DVec3> =
            (0..4).map(|i| DVec3::AXES.get(i).copied().unwrap_or(DVec3::ZERO)).collect();
        let faces = [[3, 1, 0], [3, 2, 1], [3, 0, 2], [0, 1, 2]];
        let mesh = |faces: &[[u32; 3]]| Mesh::new(&corners, Vec::new(), faces.to_vec()).unwrap();
        assert_eq!(mesh(&faces).open_edge(), None);
        let open = mesh(&faces[..3]).open_edge().unwrap();
        assert_eq!(open.count, 3);
        assert!(open.to_string().starts_with("the edge from (1, 0, 0) to "), "{open}");
        let mut turned = faces;
        turned[2].swap(0, 1);
        assert_eq!(mesh(&turned).open_edge().unwrap().count, 3);
    }
}
