//! Vertices at which a path changes direction.

use super::Collision;
use crate::light::LobeParts;
use crate::math::Ray;
use crate::scene::Crossing;
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
    /// On a surface.
    Surface {
        /// Position just above the surface, on the side from which the path arrived.
        point: Vec3,
        /// Incident direction of propagation.
        omega_in: Vec3,
        /// Unit normal on that side, interpolated on smooth meshes.
        normal: Vec3,
        /// Unit normal of the geometry on that side, below which no light passes.
        outward: Vec3,
        /// Surface and its sides, if it is not diffuse.
        boundary: Option<Boundary>,
    },
}

/// A surface that is not diffuse, as a path meets it.
#[derive(Clone, Copy, Debug)]
pub struct Boundary {
    /// Index of the surface.
    pub surface: u32,
    /// Transparent bodies on both sides.
    pub crossing: Crossing,
    /// Distance of the vertex from the surface.
    pub lift: f32,
}

impl Vertex {
    /// The surface of the vertex, if it is one that is not diffuse.
    #[must_use]
    #[inline]
    pub fn boundary(&self) -> Option<&Boundary> {
        match self {
            Self::Surface { boundary, .. } => boundary.as_ref(),
            Self::Medium { .. } => None,
        }
    }

    /// The ray that leaves the vertex in a direction: on the other side of the surface, if the direction passes
    /// it.
    #[must_use]
    #[inline]
    pub fn ray(&self, direction: Vec3) -> Ray {
        let origin = match self {
            Self::Surface { point, outward, boundary: Some(boundary), .. }
                if outward.dot(direction) < 0.0 =>
            {
                *point - *outward * (2.0 * boundary.lift)
            }
            Self::Surface { point, .. } | Self::Medium { point, .. } => *point,
        };
        Ray { origin, direction }
    }

    /// Position of the vertex.
    #[must_use]
    pub fn point(&self) -> Vec3 {
        match self {
            Self::Medium { point, .. } | Self::Surface { point, .. } => *point,
        }
    }
}
