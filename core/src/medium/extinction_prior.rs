//! Prior knowledge of the extinction, without a look-up.

use crate::spectrum::Sampled;

/// Expected extinction in the majorant cell of a point, per component and scene unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExtinctionPrior<const N: usize> {
    /// Lower bound of the extinction; zero if unknown.
    pub minorant: Sampled<N>,
    /// Approximate mean of the extinction; zero if unknown.
    pub mean: Sampled<N>,
}

impl<const N: usize> ExtinctionPrior<N> {
    /// Unknown extinction.
    pub const UNKNOWN: Self = Self { minorant: Sampled::ZERO, mean: Sampled::ZERO };

    /// Prior of a constant extinction.
    #[must_use]
    pub fn exact(extinction: Sampled<N>) -> Self {
        Self { minorant: extinction, mean: extinction }
    }

    /// Prior of which only the mean is known.
    #[must_use]
    pub fn of_mean(mean: Sampled<N>) -> Self {
        Self { minorant: Sampled::ZERO, mean }
    }
}
