//! Test whether a mesh is closed.

use super::Mesh;
use glam::{DVec3, Vec3};
use std::collections::HashMap;
use std::fmt;

/// Edge of a mesh at which it is open, or at which the orientation of its triangles changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenEdge {
    /// Ends of the edge in the space of the file.
    pub ends: [DVec3; 2],
    /// Number of such edges.
    pub count: usize,
}

impl fmt::Display for OpenEdge {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let [a, b] = self.ends.map(|p| format!("({}, {}, {})", p.x as f32, p.y as f32, p.z as f32));
        write!(f, "the edge from {a} to {b}")?;
        if self.count > 1 {
            write!(f, " and {} more", self.count - 1)?;
        }
        Ok(())
    }
}

/// An edge that is not matched by edges of opposite direction. Vertices at the same position are the same.
pub(super) fn open_edge(mesh: &Mesh) -> Option<OpenEdge> {
    let mut known = HashMap::with_capacity(mesh.positions.len());
    let number: Vec<u32> = mesh
        .positions
        .iter()
        .enumerate()
        // Adding zero turns −0 into 0.
        .map(|(i, p)| *known.entry((*p + Vec3::ZERO).to_array().map(f32::to_bits)).or_insert(i as u32))
        .collect();
    let mut edges: Vec<(u32, u32, bool)> = Vec::with_capacity(3 * mesh.triangles.len());
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|index| number[index as usize]);
        edges.extend([(a, b), (b, c), (c, a)].map(|(from, to)| (from.min(to), from.max(to), from < to)));
    }
    edges.sort_unstable();
    let unmatched = |same: &[(u32, u32, bool)]| {
        2 * same.iter().filter(|(_, _, forwards)| *forwards).count() != same.len()
    };
    let mut open = edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).filter(|same| unmatched(same));
    let (from, to, _) = open.next()?[0];
    let at = |index: u32| {
        let position = mesh.positions[index as usize].as_dvec3();
        mesh.object_from_mesh.transform_point3(position)
    };
    Some(OpenEdge { ends: [at(from), at(to)], count: 1 + open.count() })
}
