//! Flight to the next event: the loop shared by the estimators of the null-scattering path integral.

use super::{Collision, Event, ScatteringPoint, Technique, Trace, WalkWeights, World};
use crate::math::Ray;
use crate::medium::LocalMedia;
use crate::spectrum::Components;

/// End of a flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FlightEnd {
    /// The path scatters at this point of a medium.
    Scattering(ScatteringPoint),
    /// The path is absorbed.
    Absorption,
    /// The path leaves all media, or reaches the end of the ray.
    Exit,
}

/// Draws the event at a collision from the hero's densities and multiplies null and scattering events into
/// the weights. Absorption ends the path and leaves the weights unchanged.
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

impl<M: LocalMedia<N>, C: Components<N>, const N: usize> World<'_, M, C, N> {
    /// Flies along a ray from tentative collision to tentative collision until an event is not null, or until
    /// `t_max`.
    ///
    /// At every collision the emission of the medium, weighted by `value_of_emission` (weights before the
    /// event, emitted radiance, collision), is added to `radiance`. Then `draw_event` draws the event and
    /// multiplies it into the weights; hero-driven estimators pass [`hero_event`].
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
                Event::Scattering => return FlightEnd::Scattering((&collision).into()),
                Event::Absorption => return FlightEnd::Absorption,
            }
        }
        FlightEnd::Exit
    }
}
