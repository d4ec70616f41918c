//! Ratio tracking: every collision is taken as null, and the probability of that is the weight.

use super::flight::{Choice, fly};
use super::{Entry, Estimate, Profile, Technique};
use crate::math::Sampler;

/// Ratio tracking at the rate of the largest component's majorant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RatioTracking;

impl Technique for RatioTracking {
    const ENTRY: Entry = Entry {
        id: "ratio",
        name: "Ratio tracking",
        formula: "T ≈ Π (μ̄ − μ(tᵢ))/μ̄ over collisions of rate μ̄ = max over components",
        summary: "Weights every collision instead of deciding it: never more variance than delta tracking \
                  under the same majorant, if that is a bound. Wins where majorants are low and fit tightly \
                  around empty space.",
        cost: "one look-up and one logarithm per collision: ∫μ̄ of them, whatever the transmittance",
        reference: "Cramer 1978; Novák, Selle and Jarosz 2014, \"Residual ratio tracking for estimating attenuation \
                    in participating media\"",
        unbiased: true,
        // With respect to a walk whose majorant is shared among components.
        has_pdf: true,
    };

    #[inline]
    fn estimate<P: Profile<N>, const N: usize>(&self, profile: &P, sampler: &mut Sampler) -> Estimate<N> {
        fly(
            profile,
            sampler,
            |piece| Choice::shared(piece.largest_majorant()),
            |choice, extinction, _| choice.ratio(extinction),
        )
    }
}
