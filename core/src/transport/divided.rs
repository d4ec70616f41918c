//! Flights, connections and transmittance without path densities, as weights already divided by their
//! sampling density (the report's algorithms 1–3).

use super::{Aim, Event, Note, PathWeights, Trace, WalkWeights, World};
use crate::math::{BoxRay, Ray, exp};
use crate::medium::LocalMedium;
use crate::spectrum::{Components, Sampled};
use glam::Vec3;

/// Free flight: φ_m of the report's algorithms 2 and 3.
#[derive(Clone, Copy, Debug)]
pub struct Flight<const N: usize> {
    /// Scattering position; `None` if the flight leaves the medium.
    pub scattered_at: Option<Vec3>,
    /// Transmittance, times μs at a scattering position, divided by the sampling density.
    pub weight: Sampled<N>,
}

impl<L: LocalMedium<N>, C: Components<N>, const N: usize> World<'_, L, C, N> {
    /// Samples a flight to the next scattering: from the mean extinction where the medium is uniform
    /// (algorithm 2), by delta tracking elsewhere (algorithm 3), where all components must share one
    /// extinction.
    pub fn sample_distance(&self, ray: &Ray, t_max: f32, trace: &mut Trace<'_>) -> Flight<N> {
        let flight = self.fly(ray, t_max, trace);
        let Flight { scattered_at, weight } = flight;
        trace.notify(move || Note::Flight { scattered_at, weight: weight.lanes() });
        flight
    }

    fn fly(&self, ray: &Ray, t_max: f32, trace: &mut Trace<'_>) -> Flight<N> {
        if let Some((extinction, albedo)) = self.medium.uniform() {
            let escaped = Flight { scattered_at: None, weight: Sampled::ONE };
            let Some((t0, inside)) = BoxRay::enter(ray, &self.scene.medium_from_world, t_max) else {
                return escaped;
            };
            let mean = extinction.mean();
            let t = trace.sampler.optical_depth() / mean.max(f32::MIN_POSITIVE);
            let beyond = (extinction - Sampled::splat(mean)) * -t.min(inside.t_end);
            // e^(−t μt) / e^(−t mean), evaluated as one exponential so that it does not underflow.
            let ratio = beyond.exp();
            return if t < inside.t_end {
                trace.lookups += 1;
                Flight {
                    scattered_at: Some(ray.at(t0 + t)),
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
                return Flight { scattered_at: Some(collision.point), weight };
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
        if let Some((extinction, _)) = self.medium.uniform() {
            let inside = BoxRay::enter(ray, &self.scene.medium_from_world, t_max);
            let exact = |(_, inside): (f32, BoxRay)| extinction.map(|e| exp(-e * inside.t_end));
            let estimate = inside.map_or(Sampled::ONE, exact);
            trace.notify(move || Note::Transmittance { estimate: estimate.lanes() });
            return estimate;
        }
        self.estimate_transmittance(ray, t_max, trace)
    }
}
