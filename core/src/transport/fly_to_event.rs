//! The flight to the next event: the loop that every estimator of the null-scattering path integral shares.

use super::{Collision, Event, Technique, Trace, WalkWeights, World};
use crate::math::Ray;
use crate::medium::LocalMedium;
use crate::spectrum::Components;
use glam::Vec3;

/// How a flight ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FlightEnd {
    /// The path scatters in the medium, at this point in world space.
    Scattering(Vec3),
    /// The path is absorbed.
    Absorption,
    /// The path leaves the medium, or reaches what ends the ray.
    Exit,
}

/// Draws the event at a collision from the hero's densities, and multiplies null and scattering events into the weights.
/// Absorption ends the path and leaves them as they are.
#[inline(always)]
pub fn hero_event<W: WalkWeights<N>, const N: usize>(
    path: &mut W,
    collision: &Collision<N>,
    trace: &mut Trace<'_>,
) -> Event {
    let event = collision.draw_event(trace);
    match event {
        Event::Null => path.null(collision),
        Event::Scattering => path.scatter(collision),
        Event::Absorption => {}
    }
    event
}

impl<L: LocalMedium<N>, C: Components<N>, const N: usize> World<'_, L, C, N> {
    /// Flies along a ray from tentative collision to tentative collision until an event is not null, or until `t_max`.
    ///
    /// At every collision the medium's emission is added to `radiance` by `value_of_emission` (weights before the event,
    /// emitted radiance, collision), then `draw_event` draws what happens and multiplies it into the weights: those of
    /// hero-driven estimators by [`hero_event`].
    #[inline(always)]
    pub fn fly_to_event<W: WalkWeights<N>>(
        &self,
        (ray, t_max): (&Ray, f32),
        path: &mut W,
        radiance: &mut C::Radiance,
        trace: &mut Trace<'_>,
        value_of_emission: impl Fn(&W, C::Radiance, &Collision<N>) -> C::Radiance,
        draw_event: impl Fn(&mut W, &Collision<N>, &mut Trace<'_>) -> Event,
    ) -> FlightEnd {
        let mut walk = self.walk(ray, t_max);
        while let Some(collision) = walk.next_collision(trace, path) {
            if let Some(emitted) = self.emission_at(&collision, trace) {
                let value = value_of_emission(path, emitted, &collision);
                *radiance += self.record(Technique::Emission, (emitted, 0.0), value, trace);
            }
            match draw_event(path, &collision, trace) {
                Event::Null => {}
                Event::Scattering => return FlightEnd::Scattering(collision.point),
                Event::Absorption => return FlightEnd::Absorption,
            }
        }
        FlightEnd::Exit
    }
}
