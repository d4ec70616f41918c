//! Extinction along one ray, with the bounds and means known before any look-up.

use crate::medium::MajorantSegment;
use crate::spectrum::Sampled;

/// Stretch of a ray with the prior knowledge of its extinction, before any look-up.
#[derive(Clone, Copy, Debug)]
pub struct Piece<const N: usize> {
    /// Range on the ray, and majorant μ̄ per component and scene unit.
    pub segment: MajorantSegment<N>,
    /// Lower bound of the extinction.
    pub minorant: Sampled<N>,
    /// Approximate mean extinction. Where neither the mean nor the majorant exceeds the minorant, extinction
    /// is assumed constant; otherwise a wrong mean only increases the variance.
    pub mean: Sampled<N>,
}

impl<const N: usize> Piece<N> {
    /// Piece of length zero.
    pub const EMPTY: Self = Self {
        segment: MajorantSegment {
            t0: 0.0,
            t1: 0.0,
            majorant: Sampled::ZERO,
            clamp_null: false,
            watched: false,
        },
        minorant: Sampled::ZERO,
        mean: Sampled::ZERO,
    };

    /// Length in scene units.
    #[must_use]
    #[inline]
    pub fn length(&self) -> f32 {
        self.segment.t1 - self.segment.t0
    }

    /// Largest majorant over components.
    #[must_use]
    #[inline]
    pub fn largest_majorant(&self) -> f32 {
        self.segment.majorant.max_component()
    }
}

/// Extinction μ(t) along a ray, at `N` components.
pub trait Profile<const N: usize> {
    /// Iterator over the pieces of the ray.
    type Pieces<'a>: Iterator<Item = Piece<N>>
    where
        Self: 'a;

    /// Pieces in order along the ray; gaps between them are empty. Costs no look-up.
    fn pieces(&self) -> Self::Pieces<'_>;

    /// μ at `t` in a piece, per scene unit: one look-up.
    fn extinction(&self, t: f32, piece: &Piece<N>) -> Sampled<N>;
}
