//! Flights, connections and transmittance without path densities, as weights already divided by their
//! sampling density (the report's algorithms 1–3).

use super::{Aim, Event, Note, PathWeights, ScatteringPoint, Trace, WalkWeights, World};
use crate::math::{Ray, exp};
use crate::medium::{LocalMedia, Traversal};
use crate::spectrum::{Components, Sampled};

/// Free flight: φ_m of the report's algorithms 2 and 3.
#[derive(Clone, Copy, Debug)]
pub struct Flight<const N: usize> {
    /// Scattering point; `None` if the flight leaves all media.
    pub scattered_at: Option<ScatteringPoint>,
    /// Transmittance, times μs at a scattering position, divided by the sampling density.
    pub weight: Sampled<N>,
}

impl<M: LocalMedia<N>, C: Components<N>, const N: usize> World<'_, M, C, N> {
    /// Samples a flight to the next scattering: from the mean extinction where the medium is uniform
    /// (algorithm 2), by delta tracking elsewhere (algorithm 3), where all components must share one
    /// extinction.
    pub fn sample_distance(&self, ray: &Ray, t_max: f32, trace: &mut Trace<'_>) -> Flight<N> {
        let flight = self.fly(ray, t_max, trace);
        let Flight { scattered_at, weight } = flight;
        let point = scattered_at.map(|at| at.point);
        trace.notify(move || Note::Flight { scattered_at: point, weight: weight.lanes() });
        flight
    }

    fn fly(&self, ray: &Ray, t_max: f32, trace: &mut Trace<'_>) -> Flight<N> {
        if let Some((extinction, albedo)) = self.media.uniform() {
            let escaped = Flight { scattered_at: None, weight: Sampled::ONE };
            let Some((t0, traversal)) = self.media.traverse(ray, t_max) else { return escaped };
            let mean = extinction.mean();
            let t = trace.sampler.optical_depth() / mean.max(f32::MIN_POSITIVE);
            let beyond = (extinction - Sampled::splat(mean)) * -t.min(traversal.t_end());
            // e^(−t μt) / e^(−t mean), evaluated as one exponential so that it does not underflow.
            let ratio = beyond.exp();
            return if t < traversal.t_end() {
                trace.lookups += 1;
                Flight {
                    scattered_at: Some(ScatteringPoint { point: ray.at(t0 + t), medium: 0, share: 1.0 }),
                    weight: ratio * extinction * albedo * (1.0 / mean),
                }
            } else {
                Flight { weight: ratio, ..escaped }
            };
        }
        let mut weights = PathWeights::CAMERA;
        let mut walk = self.walk(ray, t_max);
        while let Some(collision) = walk.next_collision(trace, &mut weights) {
            if collision.draw_real(trace) == Event::Scattering {
                let c = &collision.coefficients;
                let weight = c.scattering.zip(c.extinction(), |s, t| if t > 0.0 { s / t } else { 0.0 });
                return Flight { scattered_at: Some((&collision).into()), weight };
            }
        }
        Flight { scattered_at: None, weight: Sampled::ONE }
    }

    /// [`Self::transmittance`] of a connection.
    pub fn transmittance_to(&self, aim: &Aim<C::Radiance>, trace: &mut Trace<'_>) -> Sampled<N> {
        let told = *aim;
        trace.notify(move || told.note());
        let transmittance = self.transmittance(&aim.ray, aim.distance, trace);
        trace.notify(move || Note::Connected { arrives: !transmittance.is_zero() });
        transmittance
    }

    /// Transmittance along a ray up to `t_max`: exact where the medium is uniform, estimated elsewhere, by
    /// ratio tracking unless the settings select another estimator.
    pub fn transmittance(&self, ray: &Ray, t_max: f32, trace: &mut Trace<'_>) -> Sampled<N> {
        if let Some((extinction, _)) = self.media.uniform() {
            let length = self.media.traverse(ray, t_max).map(|(_, traversal)| traversal.t_end());
            let estimate = length.map_or(Sampled::ONE, |length| extinction.map(|e| exp(-e * length)));
            trace.notify(move || Note::Transmittance { estimate: estimate.lanes() });
            return estimate;
        }
        self.estimate_transmittance(ray, t_max, trace)
    }
}
