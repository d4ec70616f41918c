//! Events at a tentative collision and their densities.
//!
//! The density of each event per component, with k = μ̄ / (μt + |μn|):
//!
//! | event | analogue | albedo-weighted |
//! | --- | --- | --- |
//! | null | \|μn\| k | \|μn\| k |
//! | scattering | μs k | μt k |
//! | absorption | μa k | never drawn |
//!
//! Where the majorant bounds the extinction, k = 1 and the densities are the coefficients themselves. Where
//! it does not, μn is negative, and the factor k makes the densities sum to μ̄ again.
//!
//! *Weighted delta tracking* makes real collisions more likely by κ = √(μ̄ / μt), at the cost of null
//! collisions: the densities are μs κ (or μt κ), μa κ and μ̄ − μt κ.
//!
//! *Decomposition tracking* splits the extinction into a control μc, known without a look-up, and the
//! residual. A collision belongs to the control with density μc, and is then real, or to the residual with
//! density μ̄ − μc, for which the table holds with μt − μc in place of μt. The path space is extended by a
//! label of every collision, control or residual; f and all densities are those of the label, so that the
//! heuristics hold as before. All null collisions belong to the residual, with density μ̄ − μt where the
//! majorant bounds the extinction. This is the same density as without a control, so that connections, which
//! are not split, agree with the walk. Where the majorant may be exceeded they would not agree (k of the
//! residual differs from that of the whole), and the residual could have density zero where its f is not
//! zero. Such a segment therefore has no control, and the table holds for the whole medium.

use super::{CollisionRecord, Note, PathSettings, Trace};
use crate::medium::{Coefficients, Member};
use crate::scene::{Absorption, DistanceSampling};
use crate::spectrum::Sampled;
use glam::Vec3;

/// Outcome of a collision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// The path continues in the same direction.
    Null,
    /// The path changes direction.
    Scattering,
    /// The path ends.
    Absorption,
}

/// Rule by which events are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EventRule {
    /// Treatment of absorption at a collision.
    pub absorption: Absorption,
    /// Rule by which a collision is real or null.
    pub distances: DistanceSampling,
}

impl From<Absorption> for EventRule {
    fn from(absorption: Absorption) -> Self {
        Self { absorption, ..Self::default() }
    }
}

impl From<&PathSettings> for EventRule {
    fn from(settings: &PathSettings) -> Self {
        Self { absorption: settings.absorption, distances: settings.distances }
    }
}

/// A tentative collision of the walk, drawn with density μ̄ e^(−μ̄ t) of the hero.
#[derive(Clone, Copy, Debug)]
pub struct Collision<const N: usize> {
    /// Position in world space.
    pub point: Vec3,
    /// Index of the medium that the collision belongs to, which is a label of the path.
    pub medium: u32,
    /// The medium's share of the majorant of all media at the point, averaged over the components.
    pub share: f32,
    /// μa, μs, μn, μ̄ of the medium at the point; of one part of it under decomposition tracking.
    pub coefficients: Coefficients<N>,
    /// Density of a tentative collision with this part of the medium: μ̄ for the whole medium.
    pub tentative: Sampled<N>,
    /// Density of a null collision, per component.
    pub null_density: Sampled<N>,
    /// Density of scattering, per component.
    pub scattering_density: Sampled<N>,
    /// Density of absorption, for the hero.
    absorption_density: f32,
    /// Whether the majorant bounds the extinction here, at every component.
    pub bounds: bool,
}

impl<const N: usize> Collision<N> {
    /// Computes the event densities of a collision.
    #[must_use]
    #[inline]
    pub fn new(point: Vec3, coefficients: Coefficients<N>, rule: EventRule) -> Self {
        let (all, bounds) = (coefficients.majorant, is_bound(&coefficients));
        let mut collision = Self::with_part(point, coefficients, all, bounds, rule.absorption);
        if rule.distances == DistanceSampling::WeightedDelta && collision.bounds {
            collision.make_real_more_likely();
        }
        collision
    }

    /// Creates a collision with the control, of extinction μc; it is real.
    #[must_use]
    pub fn with_control(
        point: Vec3,
        control: Sampled<N>,
        albedo: Sampled<N>,
        majorant: Sampled<N>,
        absorption: Absorption,
    ) -> Self {
        let scattering = control * albedo;
        let part = Coefficients {
            absorption: control - scattering,
            scattering,
            null: Sampled::ZERO,
            majorant,
            excess: 1.0,
        };
        Self::with_part(point, part, control, true, absorption)
    }

    /// Creates a collision with the residual of the medium beside the control.
    #[must_use]
    pub fn with_rest(
        point: Vec3,
        all: Coefficients<N>,
        control: Sampled<N>,
        albedo: Sampled<N>,
        absorption: Absorption,
    ) -> Self {
        // The control is a lower bound of the extinction, except for rounding.
        let less = |all: Sampled<N>, part: Sampled<N>| all.zip(part, |all, part| (all - part).max(0.0));
        let rest = Coefficients {
            absorption: less(all.absorption, control - control * albedo),
            scattering: less(all.scattering, control * albedo),
            ..all
        };
        Self::with_part(point, rest, all.majorant - control, is_bound(&all), absorption)
    }

    #[inline(always)]
    fn with_part(
        point: Vec3,
        coefficients: Coefficients<N>,
        tentative: Sampled<N>,
        bounds: bool,
        absorption: Absorption,
    ) -> Self {
        let c = &coefficients;
        let extinction = c.extinction();
        let mut null_density = c.null.abs();
        let (mut scattering_density, mut absorption_density) = match absorption {
            Absorption::Analogue => (c.scattering, c.absorption.hero()),
            Absorption::Weighted | Absorption::Roulette => (extinction, 0.0),
        };
        if !bounds {
            let k = tentative.zip(extinction + null_density, |m, sum| m / sum.max(f32::MIN_POSITIVE));
            null_density *= k;
            scattering_density *= k;
            absorption_density *= k.hero();
        }
        Self {
            point,
            medium: 0,
            share: 1.0,
            coefficients,
            tentative,
            null_density,
            scattering_density,
            absorption_density,
            bounds,
        }
    }

    /// Returns the same collision as one of a scene's media.
    #[must_use]
    #[inline(always)]
    pub fn in_medium(self, member: &Member<N>) -> Self {
        Self { medium: member.index, share: member.share, ..self }
    }

    /// Multiplies the densities of real events by κ = √(μ̄ / μt), which leaves μ̄ − √(μ̄ μt) to null
    /// collisions.
    fn make_real_more_likely(&mut self) {
        let extinction = self.coefficients.extinction();
        let kappa = self.tentative.zip(extinction, |m, t| if t > 0.0 { (m / t).sqrt() } else { 1.0 });
        self.scattering_density *= kappa;
        self.absorption_density *= kappa.hero();
        self.null_density = self.tentative.zip(extinction, |m, t| (m - (m * t).sqrt()).max(0.0));
    }

    /// Draws whether the collision is real, with probability μt / μ̄ of the hero (the report's algorithm 3).
    /// Where the extinction exceeds the majorant it always is.
    pub fn draw_real(&self, trace: &mut Trace<'_>) -> Event {
        let (c, u) = (&self.coefficients, trace.sampler.event());
        let real = u * c.majorant.hero() < c.extinction().hero();
        let event = if real { Event::Scattering } else { Event::Null };
        trace.notify(move || Note::Drawn { event, u });
        event
    }

    /// Draws the event from the hero's densities.
    pub fn draw_event(&self, trace: &mut Trace<'_>) -> Event {
        let u = trace.sampler.event();
        self.draw_event_by(u, trace)
    }

    /// As [`Self::draw_event`], with a random number of the side stream: for a walk beside the path's own.
    pub fn draw_event_side_stream(&self, trace: &mut Trace<'_>) -> Event {
        let u = trace.connection.next_1d();
        self.draw_event_by(u, trace)
    }

    #[inline(always)]
    fn draw_event_by(&self, u: f32, trace: &mut Trace<'_>) -> Event {
        let event = self.event_at(u * self.tentative.hero());
        trace.notify(move || Note::Drawn { event, u });
        event
    }

    /// Selects the event at a number from 0 to the hero's tentative density. Absorption, scattering and null
    /// divide that range, in this order, by their densities.
    #[must_use]
    #[inline]
    pub fn event_at(&self, u: f32) -> Event {
        let (null, scattering) = (self.null_density.hero(), self.scattering_density.hero());
        // The three densities sum to the tentative density. An event of density zero is never selected, even
        // with rounding.
        if u < self.absorption_density {
            Event::Absorption
        } else if u < self.absorption_density + scattering {
            Event::Scattering
        } else if null > 0.0 {
            Event::Null
        } else if scattering > 0.0 {
            Event::Scattering
        } else {
            Event::Absorption
        }
    }
}

impl<const N: usize> Collision<N> {
    /// Record of the collision for an observer, after the majorant optical depth `passed`.
    pub(crate) fn found(&self, passed: Sampled<N>) -> CollisionRecord {
        let c = &self.coefficients;
        CollisionRecord {
            point: self.point,
            medium: self.medium,
            passed: passed.lanes(),
            absorption: c.absorption.lanes(),
            scattering: c.scattering.lanes(),
            null: c.null.lanes(),
            majorant: c.majorant.lanes(),
            tentative: self.tentative.lanes(),
            null_density: self.null_density.lanes(),
            scattering_density: self.scattering_density.lanes(),
        }
    }
}

/// Whether the majorant bounds the extinction at every component.
#[inline(always)]
fn is_bound<const N: usize>(c: &Coefficients<N>) -> bool {
    c.extinction().zip(c.majorant, |t, m| if t > m { 1.0 } else { 0.0 }).is_zero()
}
