//! Optical depth from look-ups at equal distances over the pieces of a ray; gaps between pieces are left out.

use super::{Piece, Profile};
use crate::spectrum::Sampled;

/// Extent of all pieces of a ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent<const N: usize> {
    /// Total length in scene units, without gaps.
    pub length: f32,
    /// ∫μ̄ of the largest component.
    pub majorant_depth: f32,
    /// First and last piece.
    pub ends: [Piece<N>; 2],
}

impl<const N: usize> Extent<N> {
    /// Measures a ray; `None` for a ray without pieces.
    #[inline]
    pub fn of<P: Profile<N>>(profile: &P) -> Option<Self> {
        let mut pieces = profile.pieces();
        let first = pieces.next()?;
        let depth = |piece: &Piece<N>| piece.largest_majorant() * piece.length();
        let start = Self { length: first.length(), majorant_depth: depth(&first), ends: [first; 2] };
        Some(pieces.fold(start, |all, piece| Self {
            length: all.length + piece.length(),
            majorant_depth: all.majorant_depth + depth(&piece),
            ends: [all.ends[0], piece],
        }))
    }
}

/// length/count · Σ μ(position in step j), with the position of step j at `offset()`, in units of a step.
#[inline]
pub(super) fn comb<P: Profile<N>, const N: usize>(
    profile: &P,
    extent: &Extent<N>,
    count: u32,
    mut offset: impl FnMut() -> f32,
) -> Sampled<N> {
    let step = extent.length / count as f32;
    let mut sum = Sampled::ZERO;
    let mut taken = 0;
    let mut place = offset() * step;
    let mut start = 0.0;
    for piece in profile.pieces() {
        let end = start + piece.length();
        while taken < count && place < end {
            sum += profile.extinction(piece.segment.t0 + (place - start), &piece);
            taken += 1;
            place = (taken as f32 + offset()) * step;
        }
        start = end;
    }
    // Rounding may put the last position beyond the end.
    let last = &extent.ends[1];
    for _ in taken..count {
        sum += profile.extinction(last.segment.t1, last);
    }
    sum * step
}
