//! How a path turns at a vertex: what it is worth, and how likely it is.

use super::Vertex;
use crate::light::LightLobes;
use crate::math::{Frame, cosine_direction};
use crate::phase::Phase;
use glam::{Vec2, Vec3};
use std::f32::consts::FRAC_1_PI;

/// Share of directions in a medium that are drawn towards the lights, if any are.
const GUIDED: f32 = 0.3;

/// Everything that directions are drawn from.
#[derive(Clone, Copy, Debug)]
pub struct DirectionSampler<'a> {
    /// The medium's phase function.
    pub phase: &'a Phase,
    /// What guides paths to the lights, if anything does.
    pub guide: Option<Guide<'a>>,
}

/// Directions that are mixed with the phase function's.
#[derive(Clone, Copy, Debug)]
pub enum Guide<'a> {
    /// Broad lobes towards the lights.
    Lobes(&'a LightLobes),
    /// The parts of the phase function in which the vertex sees the lights.
    Product,
}

/// A direction out of a vertex.
#[derive(Clone, Copy, Debug)]
pub struct DirectionSample {
    /// Where the path goes.
    pub direction: Vec3,
    /// Phase function or cosine lobe, per steradian.
    pub value: f32,
    /// Density with which the direction is drawn, per steradian.
    pub density: f32,
}

impl DirectionSampler<'_> {
    /// Value and density of leaving a vertex in a direction.
    #[must_use]
    #[inline]
    pub fn towards(&self, vertex: &Vertex, direction: Vec3) -> DirectionSample {
        match vertex {
            Vertex::Medium { omega_in, .. } => {
                self.mixed(vertex, direction, self.phase.density(*omega_in, direction))
            }
            Vertex::Surface { normal, .. } => {
                let value = normal.dot(direction).max(0.0) * FRAC_1_PI;
                DirectionSample { direction, value, density: value }
            }
        }
    }

    /// Draws the direction that a path leaves a vertex in.
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
            Vertex::Surface { normal, .. } => {
                let local = cosine_direction(u);
                let value = (local.z * FRAC_1_PI).max(f32::MIN_POSITIVE);
                DirectionSample { direction: Frame::about(*normal).to_world(local), value, density: value }
            }
        }
    }

    /// A direction from the guide, if it has any at this vertex.
    #[inline]
    fn guided(&self, vertex: &Vertex, u: Vec2) -> Option<Vec3> {
        match (self.guide?, vertex) {
            (Guide::Lobes(lobes), _) => Some(lobes.sample(vertex.point(), u)),
            (Guide::Product, Vertex::Medium { parts, .. }) => parts.as_ref().map(|parts| parts.sample(u)),
            (Guide::Product, Vertex::Surface { .. }) => None,
        }
    }

    /// The density of a mixture, of which the phase function has one share and the guide the other.
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
