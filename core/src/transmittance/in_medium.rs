//! Extinction profile of a ray through the media of a scene.

use super::{Piece, Profile};
use crate::medium::Traversal;
use crate::spectrum::Sampled;

/// Extinction of all media along a ray, for the transmittance of a connection in a scene.
#[derive(Clone, Copy, Debug)]
pub struct InMedium<T>(T);

impl<T> InMedium<T> {
    /// Creates the profile along a traversal, which must not have been advanced.
    #[must_use]
    #[inline]
    pub fn new(traversal: T) -> Self {
        Self(traversal)
    }
}

impl<T: Traversal<N>, const N: usize> Profile<N> for InMedium<T> {
    type Pieces<'a>
        = Pieces<'a, T, N>
    where
        Self: 'a;

    #[inline]
    fn pieces(&self) -> Pieces<'_, T, N> {
        Pieces { along: &self.0, segments: self.0.clone() }
    }

    #[inline]
    fn extinction(&self, t: f32, piece: &Piece<N>) -> Sampled<N> {
        self.0.extinction(t, &piece.segment)
    }
}

/// The majorant segments of a ray, with the prior minorant and mean of the media.
pub struct Pieces<'a, T, const N: usize> {
    along: &'a T,
    segments: T,
}

impl<T: Traversal<N>, const N: usize> Iterator for Pieces<'_, T, N> {
    type Item = Piece<N>;

    #[inline]
    fn next(&mut self) -> Option<Piece<N>> {
        let segment = self.segments.next()?;
        let mut known = self.along.extinction_prior(0.5 * (segment.t0 + segment.t1));
        if segment.clamp_null {
            // The extinction is clamped at the majorant.
            known.minorant = known.minorant.zip(segment.majorant, f32::min);
            known.mean = known.mean.zip(segment.majorant, f32::min);
        }
        Some(Piece { segment, minorant: known.minorant, mean: known.mean })
    }
}
