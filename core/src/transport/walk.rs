//! Free flight through majorant segments.
//!
//! One optical depth with density e^(−τ) is drawn per collision and consumed segment by segment, so
//! that a ray may cross any number of segments at the cost of one logarithm.

use super::{Collision, EventRule, Note, Trace, WalkWeights};
use crate::math::{BoxRay, Ray};
use crate::medium::{LocalMedium, MajorantSegment, Violations};
use crate::scene::{DistanceSampling, Scene};
use crate::spectrum::Sampled;
use glam::Vec3;

/// A walk along one ray, from tentative collision to tentative collision.
pub struct Walk<'m, L: LocalMedium<N> + 'm, const N: usize> {
    medium: &'m L,
    violations: &'m Violations,
    rule: EventRule,
    /// Whether the walk searches for the path's next vertex, with the path's random numbers, or runs beside
    /// the path, with those of the side stream.
    to_vertex: bool,
    /// Remainder of the traversal; `None` if the ray misses the medium, or has left it.
    way: Option<Way<'m, L, N>>,
}

struct Way<'m, L: LocalMedium<N> + 'm, const N: usize> {
    /// Ray from its entry into the medium, from which every `t` is measured.
    in_world: Ray,
    in_medium: BoxRay,
    segments: L::Segments<'m>,
    segment: MajorantSegment<N>,
    t: f32,
}

impl<'m, L: LocalMedium<N>, const N: usize> Walk<'m, L, N> {
    /// Starts a walk at the ray's origin; it ends where the ray leaves the medium, or at `t_max`.
    #[must_use]
    #[inline(always)]
    pub fn new(medium: &'m L, scene: &'m Scene, ray: &Ray, t_max: f32, rule: impl Into<EventRule>) -> Self {
        Self::along(medium, scene, ray, t_max, rule.into(), true)
    }

    /// As [`Self::new`]; `to_vertex` is true for a walk to the path's next vertex, false for one beside the
    /// path.
    #[must_use]
    #[inline(always)]
    pub fn along(
        medium: &'m L,
        scene: &'m Scene,
        ray: &Ray,
        t_max: f32,
        rule: EventRule,
        to_vertex: bool,
    ) -> Self {
        let violations = &*scene.violations;
        let outside = Self { medium, violations, rule, to_vertex, way: None };
        let Some((t0, in_medium)) = BoxRay::enter(ray, &scene.medium_from_world, t_max) else {
            return outside;
        };
        let mut segments = medium.segments(&in_medium);
        let Some(segment) = segments.next() else { return outside };
        let in_world = Ray { origin: ray.at(t0), direction: ray.direction };
        Self {
            medium,
            violations,
            rule,
            to_vertex,
            way: Some(Way { in_world, in_medium, segments, segment, t: segment.t0 }),
        }
    }

    /// Flies to the next tentative collision and multiplies the traversed stretch into `weights`; `None` once
    /// the walk has left the medium, or the path has been cancelled.
    #[inline(always)]
    pub fn next_collision(
        &mut self,
        trace: &mut Trace<'_>,
        weights: &mut impl WalkWeights<N>,
    ) -> Option<Collision<N>> {
        let before = *weights;
        trace.notify(move || Note::Weights(before.weight_record()));
        let way = self.way.as_mut()?;
        if trace.must_stop() {
            return None;
        }
        let mut optical_depth = if self.to_vertex {
            trace.sampler.optical_depth()
        } else {
            trace.connection.next_optical_depth()
        };
        let mut passed = Sampled::ZERO;
        loop {
            let segment = &way.segment;
            let hero = segment.majorant.hero();
            let in_segment = hero * (segment.t1 - way.t);
            if optical_depth < in_segment {
                let distance = optical_depth / hero;
                let passed = passed + segment.majorant * distance;
                weights.pass(passed);
                way.t += distance;
                let (point, inside) = (way.in_world.at(way.t), way.in_medium.at(way.t));
                let place = Place { point, inside, segment };
                let part =
                    if self.to_vertex { place.draw_part(self.medium, self.rule, trace) } else { Part::Whole };
                trace.lookups += u64::from(part.needs_lookup());
                let collision = place.collide(self.medium, self.rule, part);
                if collision.coefficients.excess > 1.0 {
                    trace.exceeded += 1;
                    self.violations.note(inside, collision.coefficients.excess);
                }
                let weight_record = *weights;
                trace.notify(move || Note::Collision(collision.found(passed), weight_record.weight_record()));
                return Some(collision);
            }
            optical_depth -= in_segment;
            passed += segment.majorant * (segment.t1 - way.t);
            let Some(next) = way.segments.next() else { break };
            // Stretches between segments are empty.
            way.t = next.t0;
            way.segment = next;
        }
        weights.pass(passed);
        let weight_record = *weights;
        trace.notify(move || Note::Exit {
            passed: passed.lanes(),
            weight_record: weight_record.weight_record(),
        });
        self.way = None;
        None
    }
}

/// Position of a collision on a walk.
#[derive(Clone, Copy, Debug)]
pub struct Place<'s, const N: usize> {
    /// Position in world space.
    pub point: Vec3,
    /// Position in medium space.
    pub inside: Vec3,
    /// Segment with its majorant.
    pub segment: &'s MajorantSegment<N>,
}

/// Part of the medium that a walk collides with; under decomposition tracking a label of the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Part<const N: usize> {
    /// The whole medium, not split.
    Whole,
    /// The control, with its extinction and albedo, known without a look-up.
    Control(Sampled<N>, Sampled<N>),
    /// The residual beside a control with this extinction and albedo.
    Rest(Sampled<N>, Sampled<N>),
}

impl<const N: usize> Part<N> {
    fn needs_lookup(&self) -> bool {
        !matches!(self, Self::Control(..))
    }
}

impl<const N: usize> Place<'_, N> {
    /// Extinction and albedo of the control; `None` under rules other than decomposition tracking, and where
    /// the majorant may be exceeded (see the module docs of `event.rs`).
    #[must_use]
    #[inline(always)]
    pub fn control<L: LocalMedium<N>>(
        &self,
        medium: &L,
        rule: EventRule,
    ) -> Option<(Sampled<N>, Sampled<N>)> {
        if rule.distances != DistanceSampling::Decomposition || self.segment.watched {
            return None;
        }
        let (control, albedo) = medium.control(self.inside)?;
        // The control is a lower bound of the extinction, except for rounding.
        Some((control.zip(self.segment.majorant, f32::min), albedo))
    }

    /// Draws the part that the walk collides with: the control with probability μc / μ̄ of the hero.
    #[inline(always)]
    fn draw_part<L: LocalMedium<N>>(&self, medium: &L, rule: EventRule, trace: &mut Trace<'_>) -> Part<N> {
        let Some((control, albedo)) = self.control(medium, rule) else { return Part::Whole };
        let hero = control.hero();
        if hero > 0.0 && trace.sampler.next_1d() * self.segment.majorant.hero() < hero {
            Part::Control(control, albedo)
        } else {
            Part::Rest(control, albedo)
        }
    }

    /// The collision with a part of the medium. Connections are not split: a null collision on a connection
    /// has the coefficients of the whole medium.
    #[must_use]
    #[inline(always)]
    pub fn collide<L: LocalMedium<N>>(&self, medium: &L, rule: EventRule, part: Part<N>) -> Collision<N> {
        let coefficients = || medium.coefficients(self.inside, self.segment);
        match part {
            Part::Whole => Collision::new(self.point, coefficients(), rule),
            Part::Control(control, albedo) => {
                Collision::with_control(self.point, control, albedo, self.segment.majorant, rule.absorption)
            }
            Part::Rest(control, albedo) => {
                Collision::with_rest(self.point, coefficients(), control, albedo, rule.absorption)
            }
        }
    }
}
