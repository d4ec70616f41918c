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
pub struct Turns<'a> {
    /// The medium's phase function.
    pub phase: &'a Phase,
    /// Lobes towards the lights, where they guide.
    pub lobes: Option<&'a LightLobes>,
}

/// A direction out of a vertex.
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    /// Where the path goes.
    pub direction: Vec3,
    /// Phase function or cosine lobe, per steradian.
    pub value: f32,
    /// Density with which the direction is drawn, per steradian.
    pub density: f32,
}

impl Turns<'_> {
    /// Value and density of leaving a vertex in a direction.
    #[must_use]
    #[inline]
    pub fn towards(&self, vertex: &Vertex, direction: Vec3) -> Turn {
        match vertex {
            Vertex::Medium { point, omega_in } => {
                self.mixed(*point, direction, self.phase.density(*omega_in, direction))
            }
            Vertex::Surface { normal, .. } => {
                let value = normal.dot(direction).max(0.0) * FRAC_1_PI;
                Turn { direction, value, density: value }
            }
        }
    }

    /// Draws the direction that a path leaves a vertex in.
    #[must_use]
    #[inline]
    pub fn draw(&self, vertex: &Vertex, mut u: Vec2) -> Turn {
        match vertex {
            Vertex::Medium { point, omega_in } => {
                if let Some(lobes) = self.lobes {
                    if u.x < GUIDED {
                        u.x /= GUIDED;
                        let direction = lobes.sample(*point, u);
                        return self.mixed(*point, direction, self.phase.density(*omega_in, direction));
                    }
                    u.x = (u.x - GUIDED) / (1.0 - GUIDED);
                }
                let (direction, value) = self.phase.sample(*omega_in, u);
                self.mixed(*point, direction, value)
            }
            Vertex::Surface { normal, .. } => {
                let local = cosine_direction(u);
                let value = (local.z * FRAC_1_PI).max(f32::MIN_POSITIVE);
                Turn { direction: Frame::about(*normal).to_world(local), value, density: value }
            }
        }
    }

    /// The density of a mixture, of which the phase function has one share and the lobes the other.
    #[inline]
    fn mixed(&self, point: Vec3, direction: Vec3, value: f32) -> Turn {
        let density = match self.lobes {
            None => value,
            Some(lobes) => value + GUIDED * (lobes.density(point, direction) - value),
        };
        Turn { direction, value, density }
    }
}
