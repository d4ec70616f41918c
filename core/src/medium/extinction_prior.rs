//! What is known of extinction before it is looked up.

use crate::spectrum::Sampled;

/// Extinction to be expected in the majorant cell of a point, per component and scene unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExtinctionPrior<const N: usize> {
    /// A lower bound of the extinction; zero if none is known.
    pub minorant: Sampled<N>,
    /// Its mean, roughly; zero if none is known.
    pub mean: Sampled<N>,
}

impl<const N: usize> ExtinctionPrior<N> {
    /// Nothing is known.
    pub const UNKNOWN: Self = Self { minorant: Sampled::ZERO, mean: Sampled::ZERO };

    /// Of constant extinction.
    #[must_use]
    pub fn exact(extinction: Sampled<N>) -> Self {
        Self { minorant: extinction, mean: extinction }
    }

    /// Of a mean alone.
    #[must_use]
    pub fn of_mean(mean: Sampled<N>) -> Self {
        Self { minorant: Sampled::ZERO, mean }
    }
}
