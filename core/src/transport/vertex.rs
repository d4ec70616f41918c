//! Vertices at which a path changes direction.

use crate::light::LobeParts;
use glam::Vec3;

/// A real scattering vertex.
#[derive(Clone, Copy, Debug)]
pub enum Vertex {
    /// In the medium.
    Medium {
        /// Position.
        point: Vec3,
        /// Incident direction of propagation.
        omega_in: Vec3,
        /// Parts of the phase function towards the lights, if directions are drawn from them.
        parts: Option<LobeParts>,
    },
    /// On a diffuse surface.
    Surface {
        /// Position just above the surface, on the side from which the path arrived.
        point: Vec3,
        /// Unit normal on that side.
        normal: Vec3,
    },
}

impl Vertex {
    /// Position of the vertex.
    #[must_use]
    pub fn point(&self) -> Vec3 {
        match self {
            Self::Medium { point, .. } | Self::Surface { point, .. } => *point,
        }
    }
}
