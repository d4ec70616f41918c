//! What happens at a tentative collision.
//!
//! The density of each event per component, with k = μ̄ / (μt + |μn|):
//!
//! | event | analogue | albedo-weighted |
//! | --- | --- | --- |
//! | null | \|μn\| k | \|μn\| k |
//! | scattering | μs k | μt k |
//! | absorption | μa k | never drawn |
//!
//! Where the majorant bounds the extinction, k = 1 and they are the coefficients themselves. Where it
//! does not, μn is negative and k keeps the densities a partition of μ̄: together they are μ̄ always.

use super::Trace;
use crate::medium::Coefficients;
use crate::scene::Absorption;
use crate::spectrum::Sampled;
use glam::Vec3;

/// The outcome of a collision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// Nothing: the path goes straight on.
    Null,
    /// The path changes direction.
    Scattering,
    /// The path ends.
    Absorption,
}

/// A tentative collision of the walk, drawn with density μ̄ e^(−μ̄ t) of the hero.
#[derive(Clone, Copy, Debug)]
pub struct Collision<const N: usize> {
    /// Where, in world space.
    pub point: Vec3,
    /// μa, μs, μn, μ̄ there.
    pub coefficients: Coefficients<N>,
    /// Density of taking it as null, per component.
    pub null_density: Sampled<N>,
    /// Density of taking it as scattering, per component.
    pub scattering_density: Sampled<N>,
    /// Density of taking it as absorption, for the hero.
    absorption_density: f32,
    /// Whether the majorant bounds the extinction here, at every component.
    pub bounds: bool,
}

impl<const N: usize> Collision<N> {
    /// Prepares the event densities of a collision.
    #[must_use]
    pub fn new(point: Vec3, coefficients: Coefficients<N>, absorption: Absorption) -> Self {
        let c = &coefficients;
        let extinction = c.extinction();
        let mut null_density = c.null.abs();
        let (mut scattering_density, mut absorption_density) = match absorption {
            Absorption::Analogue => (c.scattering, c.absorption.hero()),
            Absorption::Weighted | Absorption::Roulette => (extinction, 0.0),
        };
        let bounds = extinction.zip(c.majorant, |t, m| if t > m { 1.0 } else { 0.0 }).is_zero();
        if !bounds {
            let k = c.majorant.zip(extinction + null_density, |m, sum| m / sum.max(f32::MIN_POSITIVE));
            null_density *= k;
            scattering_density *= k;
            absorption_density *= k.hero();
        }
        Self { point, coefficients, null_density, scattering_density, absorption_density, bounds }
    }

    /// Draws whether the collision is real, by μt / μ̄ of the hero (the report's algorithm 3): where the majorant is
    /// exceeded it always is.
    pub fn draw_real(&self, trace: &mut Trace<'_>) -> Event {
        let c = &self.coefficients;
        let real = trace.sampler.event() * c.majorant.hero() < c.extinction().hero();
        if real { Event::Scattering } else { Event::Null }
    }

    /// Draws the event from the hero's densities.
    pub fn draw_event(&self, trace: &mut Trace<'_>) -> Event {
        let (null, scattering) = (self.null_density.hero(), self.scattering_density.hero());
        let u = trace.sampler.event() * self.coefficients.majorant.hero();
        // The three densities add up to μ̄. An event of density zero is never drawn, even by rounding.
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
