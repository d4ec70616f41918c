//! Events that are drawn for all components at once, as spectral tracking does.

use super::{Collision, Event, Note, PathSettings, Trace};
use crate::scene::{Absorption, Tracking};
use crate::spectrum::Sampled;

/// What the event at a collision is drawn in proportion to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EventDensities {
    /// Going straight on.
    pub null: f32,
    /// Changing direction.
    pub scattering: f32,
    /// Ending.
    pub absorption: f32,
    /// μ̄, the same for all components.
    majorant: f32,
}

impl EventDensities {
    /// Of a collision on a path of these weights, by the policies of Kutz et al. 2017, equations 22–25. A policy that
    /// sees no way on falls back on the average.
    #[must_use]
    #[inline]
    pub fn of<const N: usize>(c: &Collision<N>, weights: &Sampled<N>, settings: &PathSettings) -> Self {
        let coefficients = &c.coefficients;
        let policy = |e: Sampled<N>| match settings.tracking {
            Tracking::Maximum => e.abs().max_component(),
            Tracking::Average => e.abs().mean(),
            Tracking::History => (e * *weights).abs().mean(),
        };
        let (scattering, absorption) = match settings.absorption {
            Absorption::Analogue => (coefficients.scattering, policy(coefficients.absorption)),
            Absorption::Weighted | Absorption::Roulette => (coefficients.extinction(), 0.0),
        };
        Self {
            null: policy(coefficients.null),
            scattering: policy(scattering),
            absorption,
            majorant: coefficients.majorant.max_component(),
        }
    }

    /// Their sum.
    #[must_use]
    pub fn total(&self) -> f32 {
        self.null + self.scattering + self.absorption
    }

    /// Draws the event.
    #[inline]
    pub fn draw_event(&self, trace: &mut Trace<'_>) -> Event {
        let number = trace.sampler.event();
        let u = number * self.total();
        let event = if u < self.null {
            Event::Null
        } else if u < self.null + self.scattering {
            Event::Scattering
        } else {
            Event::Absorption
        };
        let told = *self;
        trace.tell(move || {
            let density = match event {
                Event::Null => told.null,
                Event::Scattering => told.scattering,
                Event::Absorption => told.absorption,
            };
            Note::DrawnForAll { event, u: number, density: told.drawn(density) }
        });
        event
    }

    /// The density with which an event was drawn: μ̄ times its probability.
    #[must_use]
    pub fn drawn(&self, event: f32) -> f32 {
        self.majorant * event / self.total()
    }
}
