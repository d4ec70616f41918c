//! Event sampling for all components at once, as in spectral tracking.

use super::{Collision, Event, Note, PathSettings, Trace};
use crate::scene::{Absorption, Tracking};
use crate::spectrum::Sampled;

/// Densities to which the event probabilities at a collision are proportional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EventDensities {
    /// Null collision.
    pub null: f32,
    /// Scattering.
    pub scattering: f32,
    /// Absorption.
    pub absorption: f32,
    /// Majorant μ̄, the same for all components.
    majorant: f32,
}

impl EventDensities {
    /// Computes the densities of a collision on a path with these weights, by the policies of Kutz et al.
    /// 2017, equations 22–25. Where every event would leave the path with zero weight, the history policy
    /// falls back on the average, so that the densities are never all zero.
    #[must_use]
    #[inline]
    pub fn of<const N: usize>(c: &Collision<N>, weights: &Sampled<N>, settings: &PathSettings) -> Self {
        let densities = Self::by(settings.tracking, c, weights, settings.absorption);
        if densities.total() > 0.0 {
            densities
        } else {
            Self::by(Tracking::Average, c, weights, settings.absorption)
        }
    }

    #[inline(always)]
    fn by<const N: usize>(
        tracking: Tracking,
        c: &Collision<N>,
        weights: &Sampled<N>,
        absorption: Absorption,
    ) -> Self {
        let coefficients = &c.coefficients;
        let policy = |e: Sampled<N>| match tracking {
            Tracking::Maximum => e.abs().max_component(),
            Tracking::Average => e.abs().mean(),
            Tracking::History => (e * *weights).abs().mean(),
        };
        let (scattering, absorption) = match absorption {
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

    /// Sum of the densities.
    #[must_use]
    pub fn total(&self) -> f32 {
        self.null + self.scattering + self.absorption
    }

    /// Draws the event.
    #[inline]
    pub fn draw_event(&self, trace: &mut Trace<'_>) -> Event {
        let number = trace.sampler.event();
        let event = self.event_at(number * self.total());
        let told = *self;
        trace.notify(move || {
            let density = match event {
                Event::Null => told.null,
                Event::Scattering => told.scattering,
                Event::Absorption => told.absorption,
            };
            Note::DrawnForAll { event, u: number, density: told.drawn(density) }
        });
        event
    }

    /// Selects the event at a number between 0 and [`Self::total`]. An event of density zero is never
    /// selected, even with rounding.
    fn event_at(&self, u: f32) -> Event {
        if u < self.null {
            Event::Null
        } else if u < self.null + self.scattering {
            Event::Scattering
        } else if self.absorption > 0.0 {
            Event::Absorption
        } else if self.scattering > 0.0 {
            Event::Scattering
        } else {
            Event::Null
        }
    }

    /// Density with which an event was drawn: μ̄ times its probability.
    #[must_use]
    pub fn drawn(&self, event: f32) -> f32 {
        self.majorant * event / self.total()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding may lift the number to the sum of the densities, with any of them zero.
    #[test]
    fn an_event_of_density_zero_is_never_drawn() {
        for mask in 1..8u8 {
            let on = |bit: u8, value: f32| if mask >> bit & 1 == 1 { value } else { 0.0 };
            for scale in [1.0f32, 1.0 / 3.0, 7e-30] {
                let densities = EventDensities {
                    null: on(0, 0.1) * scale,
                    scattering: on(1, 0.7) * scale,
                    absorption: on(2, 0.3) * scale,
                    majorant: 1.0,
                };
                let total = densities.total();
                for u in [0.0, 0.5 * total, total.next_down(), total, total.next_up()] {
                    let drawn = match densities.event_at(u) {
                        Event::Null => densities.null,
                        Event::Scattering => densities.scattering,
                        Event::Absorption => densities.absorption,
                    };
                    assert!(drawn > 0.0, "{densities:?} at {u}");
                }
            }
        }
    }
}
