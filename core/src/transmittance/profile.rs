//! What transmittance is estimated of: extinction along one ray, and what is known of it beforehand.

use crate::medium::MajorantSegment;
use crate::spectrum::Sampled;

/// A stretch of a ray with what is known of its extinction before any look-up.
#[derive(Clone, Copy, Debug)]
pub struct Piece<const N: usize> {
    /// Where it lies, and its majorant μ̄ per component and scene unit.
    pub segment: MajorantSegment<N>,
    /// A lower bound of the extinction.
    pub minorant: Sampled<N>,
    /// Mean extinction, as well as it is known. Where neither it nor the majorant exceeds the minorant, extinction is
    /// taken to be constant; otherwise a wrong mean costs variance, and nothing else.
    pub mean: Sampled<N>,
}

impl<const N: usize> Piece<N> {
    /// A stretch of no length.
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

    /// Scene units from end to end.
    #[must_use]
    #[inline]
    pub fn length(&self) -> f32 {
        self.segment.t1 - self.segment.t0
    }

    /// The majorant of the component that has the largest.
    #[must_use]
    #[inline]
    pub fn largest_majorant(&self) -> f32 {
        self.segment.majorant.max_component()
    }
}

/// Extinction μ(t) along a ray, at `N` components.
pub trait Profile<const N: usize> {
    /// Stretches of the ray.
    type Pieces<'a>: Iterator<Item = Piece<N>>
    where
        Self: 'a;

    /// Stretches in order; what they leave out is empty. Costs no look-up.
    fn pieces(&self) -> Self::Pieces<'_>;

    /// μ at `t` in a piece, per scene unit: one look-up.
    fn extinction(&self, t: f32, piece: &Piece<N>) -> Sampled<N>;
}
