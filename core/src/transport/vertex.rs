//! Vertices at which a path changes direction.

use crate::light::LobeParts;
use glam::Vec3;

/// A real scattering vertex.
#[derive(Clone, Copy, Debug)]
pub enum Vertex {
    /// In the medium.
    Medium {
        /// Where.
        point: Vec3,
        /// Direction of propagation that arrived.
        omega_in: Vec3,
        /// What is scattered towards the lights, if directions are drawn by it.
        parts: Option<LobeParts>,
    },
    /// On a diffuse surface.
    Surface {
        /// Just above the surface, on the side that the path came from.
        point: Vec3,
        /// Unit normal of that side.
        normal: Vec3,
    },
}

impl Vertex {
    /// Where it is.
    #[must_use]
    pub fn point(&self) -> Vec3 {
        match self {
            Self::Medium { point, .. } | Self::Surface { point, .. } => *point,
        }
    }
}
