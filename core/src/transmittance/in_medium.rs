//! Extinction profile of a ray through a medium.

use super::{Piece, Profile};
use crate::math::BoxRay;
use crate::medium::LocalMedium;
use crate::spectrum::Sampled;

/// Extinction of a medium along a ray, for the transmittance of a connection in a scene.
#[derive(Clone, Copy, Debug)]
pub struct InMedium<'m, L, const N: usize> {
    medium: &'m L,
    ray: BoxRay,
}

impl<'m, L: LocalMedium<N>, const N: usize> InMedium<'m, L, N> {
    /// Creates the profile along `ray` from its start to its end.
    #[must_use]
    #[inline]
    pub fn new(medium: &'m L, ray: BoxRay) -> Self {
        Self { medium, ray }
    }
}

impl<L: LocalMedium<N>, const N: usize> Profile<N> for InMedium<'_, L, N> {
    type Pieces<'a>
        = Pieces<'a, L, N>
    where
        Self: 'a;

    #[inline]
    fn pieces(&self) -> Pieces<'_, L, N> {
        Pieces { medium: self.medium, ray: &self.ray, segments: self.medium.segments(&self.ray) }
    }

    #[inline]
    fn extinction(&self, t: f32, piece: &Piece<N>) -> Sampled<N> {
        self.medium.coefficients(self.ray.at(t), &piece.segment).extinction()
    }
}

/// The majorant segments of a ray, with the medium's prior minorant and mean.
pub struct Pieces<'a, L: LocalMedium<N> + 'a, const N: usize> {
    medium: &'a L,
    ray: &'a BoxRay,
    segments: L::Segments<'a>,
}

impl<L: LocalMedium<N>, const N: usize> Iterator for Pieces<'_, L, N> {
    type Item = Piece<N>;

    #[inline]
    fn next(&mut self) -> Option<Piece<N>> {
        let segment = self.segments.next()?;
        let mut known = self.medium.extinction_prior(self.ray.at(0.5 * (segment.t0 + segment.t1)));
        if segment.clamp_null {
            // The extinction is clamped at the majorant.
            known.minorant = known.minorant.zip(segment.majorant, f32::min);
            known.mean = known.mean.zip(segment.majorant, f32::min);
        }
        Some(Piece { segment, minorant: known.minorant, mean: known.mean })
    }
}
