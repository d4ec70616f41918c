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
            Absorption::Weighted => (extinction, 0.0),
        };
        let bounds = extinction.zip(c.majorant, |t, m| if t > m { 1.0 } else { 0.0 }).is_zero();
        if !bounds {
            let k = c.majorant.zip(extinction + null_density, |m, sum| m / sum.max(f32::MIN_POSITIVE));
            null_density *= k;
            scattering_density *= k;
            absorption_density *= k.hero();
        }
        Self { point, coefficients, null_density, scattering_density, absorption_density }
    }

    /// Draws the event from the hero's densities.
    pub fn draw_event(&self, trace: &mut Trace<'_>) -> Event {
        let (null, scattering) = (self.null_density.hero(), self.scattering_density.hero());
        let u = trace.sampler.next_1d() * self.coefficients.majorant.hero();
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Sampler;
    use crate::medium::MajorantSegment;
    use crate::transport::Wanted;

    fn collision(extinction: f32, albedo: f32, majorant: f32, absorption: Absorption) -> Collision<1> {
        let segment = MajorantSegment { t0: 0.0, t1: 1.0, majorant: Sampled([majorant]), clamp_null: false };
        let coefficients = Coefficients::new(Sampled([extinction]), Sampled([albedo]), &segment);
        Collision::new(Vec3::ZERO, coefficients, absorption)
    }

    #[test]
    fn events_come_as_often_as_their_densities_say() {
        // (μt, albedo, μ̄): bounding, tight, and exceeded.
        for (t, a, m) in
            [(3.0, 0.7, 5.0), (5.0, 0.7, 5.0), (8.0, 0.7, 5.0), (5.0, 0.0, 5.0), (5.0, 0.999, 5.0)]
        {
            for absorption in [Absorption::Analogue, Absorption::Weighted] {
                let c = collision(t, a, m, absorption);
                let null = (m - t).abs();
                let k = m / (t + null);
                let scatter = if absorption == Absorption::Analogue { t * a } else { t } * k;
                let expected = [null * k / m, scatter / m, 1.0 - (null * k + scatter) / m];
                let mut trace = Trace::new(Sampler::new(1, 2, 3), Wanted::ALWAYS);
                let n = 50_000;
                let mut counts = [0u32; 3];
                for _ in 0..n {
                    counts[match c.draw_event(&mut trace) {
                        Event::Null => 0,
                        Event::Scattering => 1,
                        Event::Absorption => 2,
                    }] += 1;
                }
                for (count, p) in counts.iter().zip(expected) {
                    let error = (f64::from(p * (1.0 - p)).max(0.0) / f64::from(n)).sqrt();
                    let share = f64::from(*count) / f64::from(n);
                    assert!((share - f64::from(p)).abs() <= 4.5 * error + 1e-6, "{t} {a} {m}: {share} {p}");
                }
            }
        }
    }
}
