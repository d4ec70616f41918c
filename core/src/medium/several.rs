//! Any number of media: majorant segments merged along a ray.

use super::any::LocalAny;
use super::rgb_grids::Segments;
use super::{
    ExtinctionPrior, LocalMedia, LocalMedium, MajorantSegment, Medium, Member, PlacedMedium, Traversal,
};
use crate::math::{BoxRay, Ray};
use crate::spectrum::{Components, Sampled};
use smallvec::SmallVec;

/// All media of a scene, at the components of one path.
pub struct Several<'a, const N: usize> {
    parts: SmallVec<[Part<'a, N>; 2]>,
    /// Whether all components use the largest component's majorant of every medium.
    shared: bool,
}

struct Part<'a, const N: usize> {
    medium: LocalAny<'a, N>,
    placed: &'a PlacedMedium,
}

impl<'a, const N: usize> Several<'a, N> {
    /// Evaluates all media at a path's components. With `shared`, all components use the largest component's
    /// majorant of every medium.
    #[must_use]
    pub fn new<C: Components<N>>(
        media: impl IntoIterator<Item = &'a PlacedMedium>,
        components: &C,
        shared: bool,
    ) -> Self {
        let part = |placed: &'a PlacedMedium| Part { medium: placed.medium.local(components), placed };
        Self { parts: media.into_iter().map(part).collect(), shared }
    }
}

impl<'m, const N: usize> LocalMedia<N> for Several<'m, N> {
    type Traversal<'a>
        = SeveralTraversal<'a, 'm, N>
    where
        Self: 'a;

    fn traverse(&self, ray: &Ray, t_max: f32) -> Option<(f32, SeveralTraversal<'_, 'm, N>)> {
        let mut crossed: SmallVec<[Crossed<'_, 'm, N>; 2]> = SmallVec::new();
        let mut entry = f32::INFINITY;
        for (index, part) in self.parts.iter().enumerate() {
            part.placed.stretches(ray, t_max, |t0, inside| {
                entry = entry.min(t0);
                let segments = part.medium.segments(&inside);
                crossed.push(Crossed { part, index: index as u32, t0, inside, segments, segment: None });
            });
        }
        if crossed.is_empty() {
            return None;
        }
        let mut t_end = 0.0f32;
        for medium in &mut crossed {
            medium.t0 -= entry;
            t_end = t_end.max(medium.t0 + medium.inside.t_end);
            medium.advance(self.shared);
        }
        Some((entry, SeveralTraversal { crossed, t: 0.0, t_end, shared: self.shared }))
    }
}

/// Traversal of several media.
#[derive(Clone)]
pub struct SeveralTraversal<'a, 'm, const N: usize> {
    crossed: SmallVec<[Crossed<'a, 'm, N>; 2]>,
    /// End of the segment that was returned last.
    t: f32,
    t_end: f32,
    shared: bool,
}

/// A stretch of the ray through a medium; a medium that is not convex may have several.
#[derive(Clone)]
struct Crossed<'a, 'm, const N: usize> {
    part: &'a Part<'m, N>,
    index: u32,
    /// Parameter of the entry into this medium.
    t0: f32,
    inside: BoxRay,
    segments: Segments<'a, N>,
    /// Current or next segment of this medium, in parameters of the traversal; `None` behind the last.
    segment: Option<MajorantSegment<N>>,
}

impl<const N: usize> Crossed<'_, '_, N> {
    fn advance(&mut self, shared: bool) {
        self.segment = self.segments.next().map(|mut segment| {
            if shared {
                segment.majorant = Sampled::splat(segment.majorant.max_component());
            }
            segment.t0 += self.t0;
            segment.t1 += self.t0;
            segment
        });
    }

    /// The medium's segment at the start of a merged segment, if it has one there.
    fn covers(&self, merged: &MajorantSegment<N>) -> Option<&MajorantSegment<N>> {
        self.segment.as_ref().filter(|own| own.t0 <= merged.t0 && merged.t1 <= own.t1)
    }

    fn contains(&self, t: f32) -> bool {
        self.t0 <= t && t - self.t0 <= self.inside.t_end
    }
}

impl<const N: usize> Iterator for SeveralTraversal<'_, '_, N> {
    type Item = MajorantSegment<N>;

    fn next(&mut self) -> Option<MajorantSegment<N>> {
        loop {
            let t0 = self.t;
            let mut merged = MajorantSegment {
                t0,
                t1: f32::INFINITY,
                majorant: Sampled::ZERO,
                clamp_null: false,
                watched: false,
            };
            let (mut any, mut covered) = (false, false);
            for medium in &mut self.crossed {
                while medium.segment.is_some_and(|own| own.t1 <= t0) {
                    medium.advance(self.shared);
                }
                let Some(own) = &medium.segment else { continue };
                any = true;
                if own.t0 <= t0 {
                    covered = true;
                    merged.t1 = merged.t1.min(own.t1);
                    merged.majorant += own.majorant;
                    merged.clamp_null |= own.clamp_null;
                    merged.watched |= own.watched;
                } else {
                    merged.t1 = merged.t1.min(own.t0);
                }
            }
            if !any {
                return None;
            }
            self.t = merged.t1;
            if covered {
                return Some(merged);
            }
        }
    }
}

impl<'a, 'm, const N: usize> Traversal<N> for SeveralTraversal<'a, 'm, N> {
    type Medium = LocalAny<'m, N>;

    fn t_end(&self) -> f32 {
        self.t_end
    }

    fn draw(
        &self,
        t: f32,
        segment: &MajorantSegment<N>,
        proportion: impl Fn(Sampled<N>) -> f32,
        u: impl FnOnce() -> f32,
    ) -> Member<N> {
        let covering =
            || self.crossed.iter().enumerate().filter_map(|(i, m)| Some((i, m, m.covers(segment)?)));
        let (mut count, mut total, mut mean) = (0, 0.0, 0.0);
        for (_, _, own) in covering() {
            count += 1;
            total += proportion(own.majorant);
            mean += own.majorant.mean();
        }
        let mut left = if count > 1 { u() * total } else { 0.0 };
        let mut drawn = None;
        for (slot, medium, own) in covering() {
            let part = proportion(own.majorant);
            if part <= 0.0 && drawn.is_some() {
                continue;
            }
            // With rounding, the last medium of positive probability is drawn.
            if part > 0.0 || drawn.is_none() {
                let share = if count > 1 { own.majorant.mean() / mean } else { 1.0 };
                let inside = medium.inside.at(t - medium.t0);
                drawn = Some(Member { slot, index: medium.index, inside, segment: *own, share });
            }
            if left < part {
                break;
            }
            left -= part;
        }
        drawn.unwrap_or(Member { slot: 0, index: 0, inside: glam::Vec3::ZERO, segment: *segment, share: 1.0 })
    }

    fn medium(&self, member: &Member<N>) -> &LocalAny<'m, N> {
        &self.crossed[member.slot].part.medium
    }

    fn placed(&self, member: &Member<N>) -> &PlacedMedium {
        self.crossed[member.slot].part.placed
    }

    fn extinction(&self, t: f32, segment: &MajorantSegment<N>) -> Sampled<N> {
        let mut sum = Sampled::ZERO;
        for crossed in self.crossed.iter().filter(|m| m.contains(t)) {
            let point = crossed.inside.at(t - crossed.t0);
            // The majorant of this medium alone matters only where it clamps the extinction.
            let own = if segment.clamp_null { crossed.own_segment(t, self.shared) } else { Some(*segment) };
            if let Some(own) = own {
                sum += crossed.part.medium.coefficients(point, &own).extinction();
            }
        }
        sum
    }

    fn extinction_prior(&self, t: f32) -> ExtinctionPrior<N> {
        let mut sum = ExtinctionPrior { minorant: Sampled::ZERO, mean: Sampled::ZERO };
        for crossed in self.crossed.iter().filter(|m| m.contains(t)) {
            let own = crossed.part.medium.extinction_prior(crossed.inside.at(t - crossed.t0));
            sum.minorant += own.minorant;
            sum.mean += own.mean;
        }
        sum
    }
}

impl<const N: usize> Crossed<'_, '_, N> {
    /// This medium's segment at `t`, found independently of the state of the traversal; `None` in an empty
    /// cell.
    fn own_segment(&self, t: f32, shared: bool) -> Option<MajorantSegment<N>> {
        let onward =
            BoxRay { origin: self.inside.at(t - self.t0).into(), t_end: f32::INFINITY, ..self.inside };
        let mut segment = self.part.medium.segments(&onward).next().filter(|own| own.t0 <= 0.0)?;
        if shared {
            segment.majorant = Sampled::splat(segment.majorant.max_component());
        }
        Some(segment)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::medium::{AnyMedium, Homogeneous, MajorantDoc, MajorantPolicy, Region};
    use crate::spectrum::{Quantity, RgbChannels, Spectrum, SpectrumDoc};
    use glam::{Affine3A, Vec3};

    const GREY: RgbChannels<1> = RgbChannels { channel: [0] };

    fn cube(extinction: f32, from: f32, to: f32, factor: f32) -> PlacedMedium {
        let spectrum = |value| Spectrum::new(&SpectrumDoc::Constant(value), Quantity::Coefficient);
        let majorant = MajorantPolicy::new(&MajorantDoc { factor, ..MajorantDoc::default() });
        let medium = Homogeneous { extinction: spectrum(extinction), albedo: spectrum(0.5), majorant };
        let world_from_medium = Affine3A::from_translation(Vec3::new(from, -0.5, -0.5))
            * Affine3A::from_scale(Vec3::new(to - from, 1.0, 1.0));
        PlacedMedium::new(AnyMedium::Homogeneous(medium), Region::Cube(world_from_medium.inverse()))
    }

    fn ray() -> Ray {
        Ray { origin: Vec3::new(-1.0, 0.0, 0.0), direction: Vec3::X }
    }

    /// Overlaps, a gap, and media that begin or end together.
    #[test]
    fn segments_merge_at_the_union_of_the_breakpoints() {
        let media = [cube(1.0, 0.0, 2.0, 1.0), cube(2.0, 1.0, 3.0, 1.0), cube(4.0, 5.0, 6.0, 2.0)];
        let several = Several::<1>::new(&media, &GREY, false);
        let (entry, traversal) = several.traverse(&ray(), f32::INFINITY).unwrap();
        assert_eq!((entry, traversal.t_end()), (1.0, 6.0));
        let found: Vec<_> = traversal.clone().map(|s| [s.t0, s.t1, s.majorant.hero()]).collect();
        let expected = [[0.0, 1.0, 1.0], [1.0, 2.0, 3.0], [2.0, 3.0, 2.0], [5.0, 6.0, 8.0]];
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for (found, expected) in found.iter().zip(expected) {
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5), "{found:?} {expected:?}");
        }
        for (t, sum) in [(0.5, 1.0), (1.5, 3.0), (2.5, 2.0), (4.0, 0.0), (5.5, 4.0)] {
            let segment = traversal.clone().next().unwrap();
            assert_eq!(traversal.extinction(t, &segment).hero(), sum, "{t}");
            assert_eq!(traversal.extinction_prior(t).minorant.hero(), sum, "{t}");
        }
        assert!(several.traverse(&ray(), 0.5).is_none());
        let cut = several.traverse(&ray(), 2.5).unwrap().1;
        assert!((cut.last().unwrap().t1 - 1.5).abs() < 1e-6);
    }

    /// A random number is requested only where media overlap; it selects in proportion to the majorants, and
    /// never a medium of majorant zero.
    #[test]
    fn a_collision_belongs_to_a_medium_in_proportion_to_its_majorant() {
        let media = [cube(0.0, 0.0, 2.0, 1.0), cube(1.0, 0.0, 2.0, 1.0), cube(3.0, 1.0, 2.0, 1.0)];
        let several = Several::<1>::new(&media, &GREY, false);
        let mut traversal = several.traverse(&ray(), f32::INFINITY).unwrap().1;
        let first = traversal.next().unwrap();
        let at = |traversal: &SeveralTraversal<'_, '_, 1>, t, segment: &_, u| {
            let member = traversal.draw(t, segment, |m| m.hero(), || u);
            (member.index, member.share)
        };
        assert_eq!([0.0, 0.5, 1.0].map(|u| at(&traversal, 0.5, &first, u)), [(1, 1.0); 3]);
        let second = traversal.next().unwrap();
        assert_eq!([0.0, 0.24, 0.26, 1.0].map(|u| at(&traversal, 1.5, &second, u).0), [1, 1, 2, 2]);
        assert_eq!([0.1, 0.9].map(|u| at(&traversal, 1.5, &second, u).1), [0.25, 0.75]);

        let alone = [cube(1.0, 0.0, 2.0, 1.0)];
        let several = Several::<1>::new(&alone, &GREY, false);
        let mut traversal = several.traverse(&ray(), f32::INFINITY).unwrap().1;
        let segment = traversal.next().unwrap();
        let member = traversal.draw(0.5, &segment, |m| m.hero(), || panic!("a number"));
        assert_eq!((member.index, member.share), (0, 1.0));
        assert!((member.inside.x - 0.25).abs() < 1e-6);
    }
}
