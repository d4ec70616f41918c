//! Sampling of outgoing directions at a vertex, with their value and density.

use super::Vertex;
use crate::light::LightLobes;
use crate::math::{Frame, cosine_direction};
use crate::phase::Phase;
use glam::{Vec2, Vec3};
use std::f32::consts::FRAC_1_PI;

/// Probability of drawing a direction in the medium from the guide, if there is one.
const GUIDED: f32 = 0.3;

/// Distributions from which outgoing directions are drawn.
#[derive(Clone, Copy, Debug)]
pub struct DirectionSampler<'a> {
    /// The medium's phase function.
    pub phase: &'a Phase,
    /// Guiding distribution towards the lights, if any.
    pub guide: Option<Guide<'a>>,
}

/// Guiding distribution, mixed with the phase function.
#[derive(Clone, Copy, Debug)]
pub enum Guide<'a> {
    /// Broad lobes towards the lights.
    Lobes(&'a LightLobes),
    /// Parts of the phase function that cover the lights as seen from the vertex.
    Product,
}

/// Direction of a path out of a vertex.
#[derive(Clone, Copy, Debug)]
pub struct DirectionSample {
    /// Outgoing direction.
    pub direction: Vec3,
    /// Phase function or cosine lobe, per steradian.
    pub value: f32,
    /// Density with which the direction is drawn, per steradian.
    pub density: f32,
}

impl DirectionSampler<'_> {
    /// Value and density of leaving a vertex in a given direction.
    #[must_use]
    #[inline]
    pub fn towards(&self, vertex: &Vertex, direction: Vec3) -> DirectionSample {
        match vertex {
            Vertex::Medium { omega_in, .. } => {
                self.mixed(vertex, direction, self.phase.density(*omega_in, direction))
            }
            Vertex::Surface { normal, outward, .. } => {
                let density = normal.dot(direction).max(0.0) * FRAC_1_PI;
                let value = if outward.dot(direction) > 0.0 { density } else { 0.0 };
                DirectionSample { direction, value, density }
            }
        }
    }

    /// Draws the direction in which a path leaves a vertex.
    #[must_use]
    #[inline]
    pub fn draw(&self, vertex: &Vertex, mut u: Vec2) -> DirectionSample {
        match vertex {
            Vertex::Medium { omega_in, .. } => {
                if self.guide.is_some() {
                    if u.x < GUIDED {
                        u.x /= GUIDED;
                        if let Some(direction) = self.guided(vertex, u) {
                            return self.towards(vertex, direction);
                        }
                    } else {
                        u.x = (u.x - GUIDED) / (1.0 - GUIDED);
                    }
                }
                let (direction, value) = self.phase.sample(*omega_in, u);
                self.mixed(vertex, direction, value)
            }
            Vertex::Surface { normal, outward, .. } => {
                let local = cosine_direction(u);
                let density = (local.z * FRAC_1_PI).max(f32::MIN_POSITIVE);
                let direction = Frame::about(*normal).to_world(local);
                // On the geometric normal alone, rounding may put a grazing direction below the surface.
                let passes = normal == outward || outward.dot(direction) > 0.0;
                DirectionSample { direction, value: if passes { density } else { 0.0 }, density }
            }
        }
    }

    /// Draws a direction from the guide, if it applies at this vertex.
    #[inline]
    fn guided(&self, vertex: &Vertex, u: Vec2) -> Option<Vec3> {
        match (self.guide?, vertex) {
            (Guide::Lobes(lobes), _) => Some(lobes.sample(vertex.point(), u)),
            (Guide::Product, Vertex::Medium { parts, .. }) => parts.as_ref().map(|parts| parts.sample(u)),
            (Guide::Product, Vertex::Surface { .. }) => None,
        }
    }

    /// Direction sample with the density of the mixture of phase function and guide.
    #[inline]
    fn mixed(&self, vertex: &Vertex, direction: Vec3, value: f32) -> DirectionSample {
        let guided = match (self.guide, vertex) {
            (Some(Guide::Lobes(lobes)), _) => Some(lobes.density(vertex.point(), direction)),
            (Some(Guide::Product), Vertex::Medium { parts: Some(parts), .. }) => {
                Some(parts.density(direction))
            }
            _ => None,
        };
        let density = guided.map_or(value, |guided| value + GUIDED * (guided - value));
        DirectionSample { direction, value, density }
    }
}
