//! Ratio tracking as in the connections of a path: collisions at the rate of the hero's majorant, and a
//! majorant per component.

use super::flight::{Choice, fly};
use super::{Entry, Estimate, Profile, Technique};
use crate::math::Sampler;

/// Ratio tracking at the rate of the hero's majorant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HeroRatioTracking;

impl Technique for HeroRatioTracking {
    const ENTRY: Entry = Entry {
        id: "ratio-hero",
        name: "Ratio tracking by the hero",
        formula: "T_l ≈ e^(−∫(μ̄_l − μ̄₁)) Π (μ̄_l − μ_l(tᵢ))/μ̄₁ over collisions of rate μ̄₁",
        summary: "The default for connections. Alone it is noisy wherever the hero is thinner than other \
                  components; it is meant for multiple importance sampling over heroes, which removes this \
                  noise.",
        cost: "one look-up and one logarithm per collision of the hero, one exponential per piece",
        reference: "Miller, Georgiev and Jarosz 2019, \"A null-scattering path integral formulation of light \
                    transport\"",
        unbiased: true,
        has_pdf: true,
    };

    #[inline]
    fn estimate<P: Profile<N>, const N: usize>(&self, profile: &P, sampler: &mut Sampler) -> Estimate<N> {
        fly(
            profile,
            sampler,
            |piece| {
                let hero = piece.segment.majorant.hero();
                // With the hero's majorant zero, the other components need a rate of their own.
                let rate = if hero > 0.0 { hero } else { piece.largest_majorant() };
                Choice { rate, base: piece.segment.majorant }
            },
            |choice, extinction, _| choice.ratio(extinction),
        )
    }
}
