//! Delta tracking as a transmittance estimator: 1 if a walk reaches the end, 0 if it collides.
//!
//! Collisions are drawn at the rate of the largest majorant; component l survives one with probability μn/μ̄.
//! All components use the same random number, so that their real collisions coincide as often as possible.
//! Where the majorant is not a bound, a null collision is drawn with probability |μn|/(μt + |μn|) and has the
//! weight −(μt + |μn|)/μ̄, as in the walk of a path.

use super::flight::{Choice, fly};
use super::{Entry, Estimate, Profile, Technique};
use crate::math::Sampler;

/// Delta (Woodcock) tracking.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DeltaTracking;

impl Technique for DeltaTracking {
    const ENTRY: Entry = Entry {
        id: "delta",
        name: "Delta tracking",
        formula: "T ≈ 1 if no collision of rate μ̄ is real, else 0",
        summary: "The baseline: 0 or 1, with variance T (1 − T) whatever the majorant. Wins where \
                  transmittance is low and a look-up is expensive, since it stops at the first real \
                  collision.",
        cost: "one look-up, one logarithm and one decision per collision, up to the first real one",
        reference: "Woodcock et al. 1965; Raab, Seibert and Keller 2008, \"Unbiased global illumination with \
                    participating media\"",
        unbiased: true,
        has_pdf: true,
    };

    #[inline]
    fn estimate<P: Profile<N>, const N: usize>(&self, profile: &P, sampler: &mut Sampler) -> Estimate<N> {
        fly(
            profile,
            sampler,
            |piece| Choice::shared(piece.largest_majorant()),
            |choice, extinction, sampler| {
                let u = sampler.next_1d();
                extinction.map(|real| survives(real, choice.rate, u))
            },
        )
    }
}

/// Weight factor of one component; its expectation over u is (majorant − real)/majorant.
#[inline]
fn survives(real: f32, majorant: f32, u: f32) -> f32 {
    let null = majorant - real;
    let total = real + null.abs();
    if u * total >= null.abs() {
        0.0
    } else if null > 0.0 {
        1.0
    } else {
        -total / majorant
    }
}
