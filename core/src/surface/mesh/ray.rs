//! Watertight intersection of rays with triangles (Woop, Benthin & Wald 2013, "Watertight ray/triangle
//! intersection").
//!
//! The triangle is sheared so that the ray runs along +z through the origin; the signs of three edge functions
//! tell whether the origin lies inside. In single precision a rounded difference of two products has the right
//! sign or is zero; zeros are evaluated again in double precision, in which the products are exact. Where an
//! edge passes exactly through the ray, the ray counts as displaced by (ε, ε²), ε → 0: of all triangles that
//! share an edge or a vertex, a line hits as many as if it passed close by. A line therefore enters a closed
//! mesh as often as it leaves it.

use glam::{Vec2, Vec3};

/// Ray in mesh space, prepared for intersection.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeshRay {
    origin: Vec3,
    direction: Vec3,
    /// Axis of the largest component of the direction, and the two others, in the order that keeps the
    /// orientation of triangles.
    axes: [usize; 3],
    shear: Vec3,
}

/// Intersection of a ray with a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct TriangleHit {
    /// Parameter along the ray.
    pub t: f32,
    /// Triangle.
    pub triangle: u32,
    /// Barycentric coordinates of the second and third vertex.
    pub barycentric: Vec2,
    /// Whether the ray meets the side from which the vertices are counter-clockwise.
    pub enters: bool,
}

impl MeshRay {
    /// Prepares a ray with a unit direction; `None` if it is not finite.
    pub fn new(origin: Vec3, direction: Vec3) -> Option<Self> {
        let z = direction.abs().max_position();
        let along = direction[z];
        if !(origin.is_finite() && direction.is_finite() && along != 0.0) {
            return None;
        }
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        if along < 0.0 {
            (x, y) = (y, x);
        }
        let shear = Vec3::new(direction[x] / along, direction[y] / along, 1.0 / along);
        Some(Self { origin, direction, axes: [x, y, z], shear })
    }

    /// The ray up to `t_max`, for the traversal of a hierarchy.
    pub fn bounded(&self, t_max: f32) -> obvhs::ray::Ray {
        obvhs::ray::Ray::new(self.origin.to_array().into(), self.direction.to_array().into(), 0.0, t_max)
    }

    /// Intersection with a triangle at any t.
    pub fn intersect(&self, corners: [Vec3; 3]) -> Option<TriangleHit> {
        let [x, y, z] = self.axes;
        let sheared = |corner: Vec3| {
            let p = corner - self.origin;
            Vec3::new(p[x] - self.shear.x * p[z], p[y] - self.shear.y * p[z], p[z])
        };
        let [a, b, c] = corners.map(sheared);
        let (u, v, w) = (edge(b, c), edge(c, a), edge(a, b));
        let side = u.side;
        if side == 0 || side != v.side || side != w.side {
            return None;
        }
        let det = u.value + v.value + w.value;
        let t = (u.value * a.z + v.value * b.z + w.value * c.z) * self.shear.z / det;
        t.is_finite().then(|| TriangleHit {
            t,
            triangle: 0,
            barycentric: Vec2::new(v.value, w.value) / det,
            enters: side < 0,
        })
    }
}

/// Edge function of a directed edge: twice the signed area of the triangle that it spans with the origin.
struct Edge {
    value: f32,
    /// Sign of the value; of a displaced origin where the value is exactly zero.
    side: i8,
}

fn edge(p: Vec3, q: Vec3) -> Edge {
    let mut value = p.x * q.y - p.y * q.x;
    if value == 0.0 {
        value = (f64::from(p.x) * f64::from(q.y) - f64::from(p.y) * f64::from(q.x)) as f32;
    }
    let sign = |x: f32| i8::from(x > 0.0) - i8::from(x < 0.0);
    let side = match (sign(value), sign(p.y - q.y)) {
        (0, 0) => sign(q.x - p.x),
        (0, side) | (side, _) => side,
    };
    Edge { value, side }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ray(origin: [f32; 3], direction: Vec3) -> MeshRay {
        MeshRay::new(origin.into(), direction.normalize()).unwrap()
    }

    #[test]
    fn distance_side_and_barycentric_coordinates() {
        // Counter-clockwise as seen from +z.
        let corners = [Vec3::ZERO, Vec3::X * 2.0, Vec3::Y * 2.0];
        let from_above = ray([0.5, 0.25, 3.0], Vec3::NEG_Z).intersect(corners).unwrap();
        assert!((from_above.t - 3.0).abs() < 1e-6 && from_above.enters);
        assert!((from_above.barycentric - Vec2::new(0.25, 0.125)).length() < 1e-6);
        let from_below = ray([0.5, 0.25, -3.0], Vec3::Z).intersect(corners).unwrap();
        assert!((from_below.t - 3.0).abs() < 1e-6 && !from_below.enters);
        for axis in 0..3 {
            // The same triangle, turned so that another axis is the ray's largest.
            let turned = corners.map(|c| Vec3::new(c[axis], c[(axis + 1) % 3], c[(axis + 2) % 3]));
            let point = Vec3::new(0.5, 0.25, 3.0);
            let origin = Vec3::new(point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3]);
            let hit = ray(
                origin.into(),
                -Vec3::new(f32::from(axis == 2), f32::from(axis == 1), f32::from(axis == 0)),
            );
            let hit = hit.intersect(turned).unwrap();
            assert!((hit.t - 3.0).abs() < 1e-6 && hit.enters, "{axis} {hit:?}");
        }
        assert!(ray([1.5, 1.5, 3.0], Vec3::NEG_Z).intersect(corners).is_none());
        assert!(MeshRay::new(Vec3::NAN, Vec3::X).is_none());
    }

    /// Rays exactly through the vertices and edges of a fan hit one of its triangles.
    #[test]
    fn a_ray_through_a_shared_edge_or_vertex_hits_once() {
        let rim: Vec<Vec3> = (0..8)
            .map(|i| {
                let (x, y) = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)][i];
                Vec3::new(x as f32, y as f32, 0.3 * (i % 3) as f32)
            })
            .collect();
        let hits = |direction: Vec3, target: Vec3| {
            let origin = target - direction * 4.0;
            let ray = ray(origin.into(), direction);
            (0..8).filter(|i| ray.intersect([Vec3::ZERO, rim[*i], rim[(i + 1) % 8]]).is_some()).count()
        };
        for target in
            [Vec3::ZERO, Vec3::new(0.5, 0.0, 0.0), Vec3::new(0.5, 0.5, 0.15), Vec3::new(0.0, 0.25, 0.15)]
        {
            assert_eq!(hits(Vec3::NEG_Z, target), 1, "{target}");
        }
        assert_eq!(hits(Vec3::new(0.25, -0.5, -1.0), Vec3::ZERO), 1);
    }
}
