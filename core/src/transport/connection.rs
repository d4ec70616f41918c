//! Next-event estimation: a connection from a vertex to a point drawn on a light.
//!
//! Every collision on the way is taken as null (ratio tracking), so that the connection always
//! arrives, with the transmittance as its weight (the report's algorithm 6, mode "nee").

use super::{Trace, Vertex, Weights, World};
use crate::light::Emitter;
use crate::math::Ray;
use crate::medium::LocalMedium;
use crate::spectrum::Components;

/// A connection that has reached its light.
#[derive(Clone, Copy, Debug)]
pub struct Connection<R, W> {
    /// Weights of the whole path, camera to light, as made by the connection.
    pub weights: W,
    /// Emitted radiance.
    pub radiance: R,
}

impl<L: LocalMedium<N>, C: Components<N>, const N: usize> World<'_, L, C, N> {
    /// Draws a light and a direction towards it, and walks there. `None` if nothing arrives.
    pub fn connect<W: Weights<N>>(
        &self,
        vertex: &Vertex,
        path: &W,
        trace: &mut Trace<'_>,
    ) -> Option<Connection<C::Radiance, W>> {
        let (u, which) = trace.sampler.light();
        let (index, probability) =
            self.scene.light_choice.choose(vertex.point(), which, self.settings.lights)?;
        let light = self.scene.lights.get(index)?;
        let sample = light.sample(vertex.point(), u)?;
        let turn = self.turns().towards(vertex, sample.direction);
        if turn.value <= 0.0 {
            return None;
        }
        let ray = Ray { origin: vertex.point(), direction: sample.direction };
        // Occluders are looked for short of the light itself; the medium reaches all the way.
        if self.scene.occluded(&ray, sample.distance * (1.0 - 1e-4)) {
            return None;
        }
        let mut weights = path.connect(&turn, sample.density * probability);
        let mut walk = self.walk_to_light(&ray, sample.distance);
        while let Some(collision) = walk.next_collision(trace, &mut weights) {
            weights.null_by_ratio(&collision);
            if weights.is_dark() {
                return None;
            }
        }
        Some(Connection { weights, radiance: light.radiance(sample.direction, &self.components) })
    }
}
