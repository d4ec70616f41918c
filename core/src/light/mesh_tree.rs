//! Binary tree over the triangles of a mesh light, from which one is drawn by its expected contribution.
//!
//! At every node one of the two halves is drawn in proportion to
//!
//! ```text
//!   area · max(cos θ, FLOOR) / distance²
//! ```
//!
//! with the bounds of the half: θ is the smallest angle between a normal in its cone and a direction from its
//! ball to the point (Conty Estevez & Kulla 2018, "Importance sampling of many lights with adaptive tree
//! splitting", with one radiance for all triangles). The probability of a triangle follows from the same
//! function along the same branches.

use crate::surface::MeshInstance;
use glam::{Vec2, Vec3};

/// Smallest cosine that counts, so that no rounding of the bounds rules out a triangle.
const FLOOR: f32 = 0.01;

/// Balanced tree. The node of a range of n triangles is followed by the 2m − 1 nodes of its first m = ⌊n/2⌋
/// triangles, then by those of the rest.
#[derive(Clone, Debug)]
pub(super) struct MeshTree {
    nodes: Vec<Node>,
    /// Triangles in the order of the leaves.
    triangles: Vec<u32>,
    /// Position of every triangle among the leaves.
    places: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    center: Vec3,
    radius: f32,
    /// Axis of the cone of normals.
    axis: Vec3,
    /// Half angle of the cone of normals, radians.
    half_angle: f32,
    area: f32,
}

impl Node {
    fn importance(&self, from: Vec3) -> f32 {
        let away = from - self.center;
        let distance = away.length();
        let cosine = if distance <= self.radius {
            1.0
        } else {
            let between = (away.dot(self.axis) / distance).clamp(-1.0, 1.0).acos();
            (between - self.half_angle - (self.radius / distance).min(1.0).asin()).max(0.0).cos()
        };
        let nearest = distance.max(self.radius).max(f32::MIN_POSITIVE.sqrt());
        self.area * cosine.max(FLOOR) / (nearest * nearest)
    }
}

/// A triangle in world space.
struct Leaf {
    triangle: u32,
    corners: [Vec3; 3],
}

impl Leaf {
    fn center(&self) -> Vec3 {
        self.corners.iter().sum::<Vec3>() / 3.0
    }
}

impl MeshTree {
    pub fn new(mesh: &MeshInstance) -> Self {
        let count = mesh.mesh().triangle_count() as u32;
        let mut leaves: Vec<Leaf> =
            (0..count).map(|triangle| Leaf { triangle, corners: mesh.corners(triangle) }).collect();
        let mut nodes = Vec::with_capacity(2 * leaves.len());
        add(&mut leaves, &|triangle| mesh.normal(triangle), &mut nodes);
        let triangles: Vec<u32> = leaves.iter().map(|leaf| leaf.triangle).collect();
        let mut places = vec![0; triangles.len()];
        for (place, triangle) in triangles.iter().enumerate() {
            places[*triangle as usize] = place as u32;
        }
        Self { nodes, triangles, places }
    }

    /// Centre and radius of a ball around all triangles.
    pub fn ball(&self) -> (Vec3, f32) {
        self.nodes.first().map_or((Vec3::ZERO, 0.0), |root| (root.center, root.radius))
    }

    /// Area of all triangles.
    pub fn area(&self) -> f32 {
        self.nodes.first().map_or(0.0, |root| root.area)
    }

    /// Draws a triangle, and returns it with the random numbers that are left.
    pub fn draw(&self, from: Vec3, mut u: Vec2) -> Option<(u32, Vec2)> {
        let (mut node, mut start, mut count) = (0, 0, self.triangles.len());
        while count > 1 {
            let (first, second, half) = halves(node, count);
            let p = self.first_half(from, first, second);
            if u.x < p {
                u.x /= p;
                (node, count) = (first, half);
            } else {
                u.x = ((u.x - p) / (1.0 - p)).clamp(0.0, 1.0);
                (node, start, count) = (second, start + half, count - half);
            }
        }
        self.triangles.get(start).map(|triangle| (*triangle, u))
    }

    /// Probability with which [`Self::draw`] draws a triangle.
    pub fn probability(&self, from: Vec3, triangle: u32) -> f32 {
        let Some(place) = self.places.get(triangle as usize) else { return 0.0 };
        let mut place = *place as usize;
        let (mut node, mut count, mut probability) = (0, self.triangles.len(), 1.0);
        while count > 1 {
            let (first, second, half) = halves(node, count);
            let p = self.first_half(from, first, second);
            if place < half {
                probability *= p;
                (node, count) = (first, half);
            } else {
                probability *= 1.0 - p;
                (node, place, count) = (second, place - half, count - half);
            }
        }
        probability
    }

    /// Probability of the first of two halves.
    fn first_half(&self, from: Vec3, first: usize, second: usize) -> f32 {
        let [a, b] = [first, second].map(|node| self.nodes[node].importance(from));
        if a + b > 0.0 && (a + b).is_finite() { a / (a + b) } else { 0.5 }
    }
}

/// Nodes of the two halves of a node of `count` triangles, and the size of the first.
fn halves(node: usize, count: usize) -> (usize, usize, usize) {
    let half = count / 2;
    (node + 1, node + 2 * half, half)
}

/// Appends the node of some triangles and all below it, and sorts the triangles along the way.
fn add(leaves: &mut [Leaf], normal: &impl Fn(u32) -> Vec3, nodes: &mut Vec<Node>) {
    let corners = || leaves.iter().flat_map(|leaf| leaf.corners);
    let (lo, hi) = corners().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lo, hi), p| (lo.min(p), hi.max(p)));
    let center = 0.5 * (lo + hi);
    let radius = corners().map(|p| p.distance(center)).fold(0.0, f32::max) * (1.0 + 1e-5);
    let area_of = |leaf: &Leaf| {
        let [a, b, c] = leaf.corners;
        0.5 * (b - a).cross(c - a).length()
    };
    let area = leaves.iter().map(area_of).sum();
    let axis = leaves.iter().map(|leaf| normal(leaf.triangle) * area_of(leaf)).sum::<Vec3>();
    let axis = axis.normalize_or(Vec3::Z);
    let half_angle =
        leaves.iter().map(|leaf| axis.dot(normal(leaf.triangle)).clamp(-1.0, 1.0).acos()).fold(0.0, f32::max);
    nodes.push(Node { center, radius, axis, half_angle, area });
    if leaves.len() > 1 {
        let size = hi - lo;
        let longest = size.max_position();
        let half = leaves.len() / 2;
        leaves.select_nth_unstable_by(half, |a, b| a.center()[longest].total_cmp(&b.center()[longest]));
        let (first, second) = leaves.split_at_mut(half);
        add(first, normal, nodes);
        add(second, normal, nodes);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::Mesh;
    use glam::{DAffine3, DVec3};
    use std::sync::Arc;

    /// A strip of triangles of different sizes, bent so that the normals differ.
    fn strip(count: u32) -> MeshInstance {
        let at = |i: u32| {
            let x = 0.1 * f64::from(i * i);
            DVec3::new(x, f64::from(i % 2), (2.0 * x).sin())
        };
        let positions: Vec<DVec3> = (0..count + 2).map(at).collect();
        let mesh = Mesh::new(&positions, Vec::new(), (0..count).map(|i| [i, i + 1, i + 2])).unwrap();
        MeshInstance::new(Arc::new(mesh), &DAffine3::IDENTITY).unwrap()
    }

    /// Probabilities sum to one, and triangles are drawn with them.
    #[test]
    fn triangles_are_drawn_with_their_probabilities() {
        for count in [1, 2, 5, 32] {
            let mesh = strip(count);
            let tree = MeshTree::new(&mesh);
            for from in [Vec3::new(0.0, 2.0, 1.0), Vec3::new(3.0, -1.0, -2.0), Vec3::new(0.4, 0.5, 0.3)] {
                let probabilities: Vec<f32> = (0..count).map(|t| tree.probability(from, t)).collect();
                assert!((probabilities.iter().sum::<f32>() - 1.0).abs() < 1e-5, "{probabilities:?}");
                assert!(probabilities.iter().all(|p| *p > 0.0), "{probabilities:?}");
                let steps = 1 << 14;
                let mut drawn = vec![0.0; count as usize];
                for i in 0..steps {
                    let u = Vec2::new((i as f32 + 0.5) / steps as f32, 0.5);
                    let (triangle, left) = tree.draw(from, u).unwrap();
                    assert!((0.0..=1.0).contains(&left.x));
                    drawn[triangle as usize] += 1.0 / steps as f32;
                }
                for (drawn, expected) in drawn.iter().zip(&probabilities) {
                    assert!((drawn - expected).abs() < 2.0 / steps as f32, "{drawn} {expected}");
                }
            }
        }
    }

    /// Close triangles, and those that face the point, are more likely.
    #[test]
    fn near_triangles_are_preferred() {
        // A long strip of small triangles.
        let positions: Vec<DVec3> = (0..66)
            .map(|i| DVec3::new(0.5 * f64::from(i), f64::from(i % 2), 0.1 * f64::from(i % 3)))
            .collect();
        let mesh = Mesh::new(&positions, Vec::new(), (0..64).map(|i| [i, i + 1, i + 2])).unwrap();
        let mesh = MeshInstance::new(Arc::new(mesh), &DAffine3::IDENTITY).unwrap();
        let tree = MeshTree::new(&mesh);
        let center = |triangle| mesh.corners(triangle).iter().sum::<Vec3>() / 3.0;
        for triangle in [3, 20, 40] {
            let from = center(triangle) + mesh.normal(triangle) * 0.05;
            let per_area = |triangle: u32| {
                let [a, b, c] = mesh.corners(triangle);
                tree.probability(from, triangle) / (b - a).cross(c - a).length()
            };
            let distance = |t: &u32| center(*t).distance(from);
            let farthest = (0..64).max_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap();
            let [near, far] = [triangle, farthest].map(per_area);
            assert!(near > 10.0 * far, "{triangle}: {near} {far}");
        }
    }
}
