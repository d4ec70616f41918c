//! Free flight through majorant segments.
//!
//! An optical depth with density e^(−τ) is drawn once per collision and spent segment by segment, so
//! that a ray may cross any number of segments at the price of one logarithm.

use super::{Collision, PathWeights, Trace};
use crate::math::{Ray, UnitBox};
use crate::medium::{LocalMedium, MajorantSegment};
use crate::scene::{Absorption, Scene};
use crate::spectrum::Sampled;

/// A walk along one ray, from tentative collision to tentative collision.
pub struct Walk<'m, L: LocalMedium<N> + 'm, const N: usize> {
    medium: &'m L,
    ray_in_world: Ray,
    ray_in_medium: Ray,
    segments: Option<L::Segments<'m>>,
    segment: Option<MajorantSegment<N>>,
    t: f32,
    absorption: Absorption,
}

impl<'m, L: LocalMedium<N>, const N: usize> Walk<'m, L, N> {
    /// Starts at the ray's origin and ends where the ray leaves the medium, at `t_max` at the latest.
    #[must_use]
    pub fn new(medium: &'m L, scene: &Scene, ray: &Ray, t_max: f32, absorption: Absorption) -> Self {
        let ray_in_medium = Ray {
            origin: scene.medium_from_world.transform_point3(ray.origin),
            direction: scene.medium_from_world.transform_vector3(ray.direction),
        };
        // The walk counts from where it enters: a camera far away must not cost it digits.
        let inside =
            UnitBox::interval(&ray_in_medium).map(|(t0, t1)| (t0, t1.min(t_max))).filter(|(t0, t1)| t0 < t1);
        let from_entry = |ray: &Ray, t0: f32| Ray { origin: ray.at(t0), direction: ray.direction };
        let (t0, length) = inside.map_or((0.0, 0.0), |(t0, t1)| (t0, t1 - t0));
        let ray_in_medium = from_entry(&ray_in_medium, t0);
        let mut segments = inside.map(|_| medium.segments(&ray_in_medium, 0.0, length));
        let segment = segments.as_mut().and_then(Iterator::next);
        let ray_in_world = from_entry(ray, t0);
        Self { medium, ray_in_world, ray_in_medium, segments, segment, t: 0.0, absorption }
    }

    /// Flies to the next tentative collision and multiplies the way there into `weights`; `None` once
    /// the walk has left the medium, or the path is not wanted any more.
    #[inline]
    pub fn next_collision(
        &mut self,
        trace: &mut Trace<'_>,
        weights: &mut PathWeights<N>,
    ) -> Option<Collision<N>> {
        self.segment?;
        if trace.must_stop() {
            return None;
        }
        let mut optical_depth = trace.sampler.next_optical_depth();
        let mut passed = Sampled::ZERO;
        while let Some(segment) = self.segment {
            // Stretches between segments are empty.
            let t = self.t.max(segment.t0);
            let hero = segment.majorant.hero();
            let in_segment = hero * (segment.t1 - t);
            if optical_depth < in_segment {
                let distance = optical_depth / hero;
                weights.pass(passed + segment.majorant * distance);
                self.t = t + distance;
                trace.lookups += 1;
                let coefficients = self.medium.coefficients(self.ray_in_medium.at(self.t), &segment);
                return Some(Collision::new(self.ray_in_world.at(self.t), coefficients, self.absorption));
            }
            optical_depth -= in_segment;
            passed += segment.majorant * (segment.t1 - t);
            self.t = segment.t1;
            self.segment = self.segments.as_mut().and_then(Iterator::next);
        }
        weights.pass(passed);
        None
    }
}
