//! A scene with a single medium, monomorphic in its kind.

use super::{ExtinctionPrior, LocalMedia, LocalMedium, MajorantSegment, Member, PlacedMedium, Traversal};
use crate::math::{BoxRay, Ray};
use crate::spectrum::Sampled;

/// The only medium of a scene, at the components of one path.
#[derive(Clone, Copy, Debug)]
pub struct One<'a, L> {
    /// The medium.
    pub medium: L,
    /// Its region and its record of violations.
    pub placed: &'a PlacedMedium,
}

impl<L: LocalMedium<N>, const N: usize> LocalMedia<N> for One<'_, L> {
    type Traversal<'a>
        = OneTraversal<'a, L, N>
    where
        Self: 'a;

    #[inline(always)]
    fn uniform(&self) -> Option<(Sampled<N>, Sampled<N>)> {
        self.medium.uniform()
    }

    #[inline(always)]
    fn traverse(&self, ray: &Ray, t_max: f32) -> Option<(f32, OneTraversal<'_, L, N>)> {
        let (t0, inside) = self.placed.region.enter(ray, t_max)?;
        let segments = self.medium.segments(&inside);
        Some((t0, OneTraversal { medium: &self.medium, placed: self.placed, inside, segments }))
    }
}

/// Traversal of a single medium.
pub struct OneTraversal<'a, L: LocalMedium<N> + 'a, const N: usize> {
    medium: &'a L,
    placed: &'a PlacedMedium,
    inside: BoxRay,
    segments: L::Segments<'a>,
}

impl<'a, L: LocalMedium<N> + 'a, const N: usize> Clone for OneTraversal<'a, L, N> {
    #[inline]
    fn clone(&self) -> Self {
        Self { segments: self.segments.clone(), ..*self }
    }
}

impl<'a, L: LocalMedium<N> + 'a, const N: usize> Iterator for OneTraversal<'a, L, N> {
    type Item = MajorantSegment<N>;

    #[inline(always)]
    fn next(&mut self) -> Option<MajorantSegment<N>> {
        self.segments.next()
    }
}

impl<'a, L: LocalMedium<N> + 'a, const N: usize> Traversal<N> for OneTraversal<'a, L, N> {
    type Medium = L;

    #[inline(always)]
    fn t_end(&self) -> f32 {
        self.inside.t_end
    }

    #[inline(always)]
    fn draw(
        &self,
        t: f32,
        segment: &MajorantSegment<N>,
        _: impl Fn(Sampled<N>) -> f32,
        _: impl FnOnce() -> f32,
    ) -> Member<N> {
        Member { slot: 0, index: 0, inside: self.inside.at(t), segment: *segment, share: 1.0 }
    }

    #[inline(always)]
    fn medium(&self, _: &Member<N>) -> &L {
        self.medium
    }

    #[inline(always)]
    fn placed(&self, _: &Member<N>) -> &PlacedMedium {
        self.placed
    }

    #[inline(always)]
    fn extinction(&self, t: f32, segment: &MajorantSegment<N>) -> Sampled<N> {
        self.medium.coefficients(self.inside.at(t), segment).extinction()
    }

    #[inline(always)]
    fn extinction_prior(&self, t: f32) -> ExtinctionPrior<N> {
        self.medium.extinction_prior(self.inside.at(t))
    }
}
