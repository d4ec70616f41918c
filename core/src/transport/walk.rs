//! Free flight through majorant segments.
//!
//! One optical depth with density e^(−τ) is drawn per collision and consumed segment by segment, so
//! that a ray may cross any number of segments at the cost of one logarithm.

use super::{Collision, EventRule, Note, Trace, WalkWeights};
use crate::math::Ray;
use crate::medium::{LocalMedia, LocalMedium, MajorantSegment, Member, Traversal};
use crate::scene::DistanceSampling;
use crate::spectrum::Sampled;
use glam::Vec3;

/// A walk along one ray, from tentative collision to tentative collision.
pub struct Walk<'m, M: LocalMedia<N> + 'm, const N: usize> {
    rule: EventRule,
    /// Whether the walk searches for the path's next vertex, with the path's random numbers, or runs beside
    /// the path, with those of the side stream.
    to_vertex: bool,
    /// Remainder of the traversal; `None` if the ray misses all media, or has left them.
    way: Option<Way<'m, M, N>>,
}

struct Way<'m, M: LocalMedia<N> + 'm, const N: usize> {
    /// Ray from its entry into the media, from which every `t` is measured.
    in_world: Ray,
    traversal: M::Traversal<'m>,
    segment: MajorantSegment<N>,
    t: f32,
}

impl<'m, M: LocalMedia<N>, const N: usize> Walk<'m, M, N> {
    /// Starts a walk at the ray's origin; it ends where the ray leaves the last medium, or at `t_max`.
    #[must_use]
    #[inline(always)]
    pub fn new(media: &'m M, ray: &Ray, t_max: f32, rule: impl Into<EventRule>) -> Self {
        Self::along(media, ray, t_max, rule.into(), true)
    }

    /// As [`Self::new`]; `to_vertex` is true for a walk to the path's next vertex, false for one beside the
    /// path.
    #[must_use]
    #[inline(always)]
    pub fn along(media: &'m M, ray: &Ray, t_max: f32, rule: EventRule, to_vertex: bool) -> Self {
        let outside = Self { rule, to_vertex, way: None };
        let Some((t0, mut traversal)) = media.traverse(ray, t_max) else { return outside };
        let Some(segment) = traversal.next() else { return outside };
        let in_world = Ray { origin: ray.at(t0), direction: ray.direction };
        Self { way: Some(Way { in_world, traversal, segment, t: segment.t0 }), ..outside }
    }

    /// Flies to the next tentative collision and multiplies the traversed stretch into `weights`; `None` once
    /// the walk has left all media, or the path has been cancelled.
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
                // The medium of the collision, in proportion to the hero's majorants.
                let number = || {
                    if self.to_vertex { trace.sampler.next_1d() } else { trace.connection.next_1d() }
                };
                let member = way.traversal.draw(way.t, segment, |majorant| majorant.hero(), number);
                let medium = way.traversal.medium(&member);
                let place = Place::of(way.in_world.at(way.t), &member);
                let part =
                    if self.to_vertex { place.draw_part(medium, self.rule, trace) } else { Part::Whole };
                trace.lookups += u64::from(part.needs_lookup());
                let collision = place.collide(medium, self.rule, part).in_medium(&member);
                if collision.coefficients.excess > 1.0 {
                    trace.exceeded += 1;
                    way.traversal
                        .placed(&member)
                        .violations
                        .note(place.inside, collision.coefficients.excess);
                }
                let weight_record = *weights;
                trace.notify(move || Note::Collision(collision.found(passed), weight_record.weight_record()));
                return Some(collision);
            }
            optical_depth -= in_segment;
            passed += segment.majorant * (segment.t1 - way.t);
            let Some(next) = way.traversal.next() else { break };
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
    /// Segment with the majorant of the medium.
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

impl<'s, const N: usize> Place<'s, N> {
    /// Position in one of the media.
    #[must_use]
    #[inline(always)]
    pub fn of(point: Vec3, member: &'s Member<N>) -> Self {
        Self { point, inside: member.inside, segment: &member.segment }
    }

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
