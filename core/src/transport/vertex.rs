//! Vertices at which a path changes direction.

use super::{PathWeights, Trace};
use crate::math::{Frame, Ray, cosine_direction};
use crate::phase::Phase;
use glam::Vec3;
use std::f32::consts::FRAC_1_PI;

/// A real scattering vertex.
#[derive(Clone, Copy, Debug)]
pub enum Vertex {
    /// In the medium.
    Medium {
        /// Where.
        point: Vec3,
        /// Direction of propagation that arrived.
        omega_in: Vec3,
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

    /// Phase function or cosine lobe in a direction, per steradian: value and density alike.
    #[must_use]
    pub fn density(&self, phase: &Phase, omega_out: Vec3) -> f32 {
        match self {
            Self::Medium { omega_in, .. } => phase.density(*omega_in, omega_out),
            Self::Surface { normal, .. } => normal.dot(omega_out).max(0.0) * FRAC_1_PI,
        }
    }

    /// Draws the direction that the path leaves in.
    pub fn leave<const N: usize>(
        &self,
        phase: &Phase,
        trace: &mut Trace<'_>,
        weights: &mut PathWeights<N>,
    ) -> Ray {
        let u = trace.sampler.next_2d();
        match self {
            Self::Medium { point, omega_in } => {
                let (direction, density) = phase.sample(*omega_in, u);
                weights.leave(density);
                Ray { origin: *point, direction }
            }
            Self::Surface { point, normal } => {
                let local = cosine_direction(u);
                weights.leave((local.z * FRAC_1_PI).max(f32::MIN_POSITIVE));
                Ray { origin: *point, direction: Frame::about(*normal).to_world(local) }
            }
        }
    }
}
