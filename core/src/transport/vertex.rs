//! Vertices at which a path changes direction.

use super::Collision;
use crate::light::LobeParts;
use glam::Vec3;

/// Point of a medium at which a path scatters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScatteringPoint {
    /// Position in world space.
    pub point: Vec3,
    /// Index of the medium.
    pub medium: u32,
    /// The medium's share of the majorant of all media at the point, averaged over the components.
    pub share: f32,
}

impl<const N: usize> From<&Collision<N>> for ScatteringPoint {
    #[inline(always)]
    fn from(collision: &Collision<N>) -> Self {
        Self { point: collision.point, medium: collision.medium, share: collision.share }
    }
}

/// A real scattering vertex.
#[derive(Clone, Copy, Debug)]
pub enum Vertex {
    /// In a medium.
    Medium {
        /// Position.
        point: Vec3,
        /// Index of the medium, whose phase function holds.
        medium: u32,
        /// Incident direction of propagation.
        omega_in: Vec3,
        /// Parts of the phase function towards the lights, if directions are drawn from them.
        parts: Option<LobeParts>,
    },
    /// On a diffuse surface.
    Surface {
        /// Position just above the surface, on the side from which the path arrived.
        point: Vec3,
        /// Unit normal on that side, interpolated on smooth meshes.
        normal: Vec3,
        /// Unit normal of the geometry on that side, below which no light passes.
        outward: Vec3,
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
