//! Residual ratio tracking: a constant control per piece is integrated exactly, the residual is tracked.
//!
//! Per piece, with spread μr = max over components of (μ̄ − μmin) and length D,
//!
//! ```text
//!   μc = min(mean, μmin + μr (γ^(1/(D μr)) − 1)),   γ = 2
//!   T ≈ Π over pieces e^(−μc D) Π (μr + μc − μ(tᵢ))/μr,   collisions of rate μr
//! ```
//!
//! The limit on μc keeps the largest weight of the expected D μr collisions below γ per piece. Novák et al.
//! choose it in this way for the cells of a coarse grid; here D is the length of the ray within the cell.

use super::flight::{Choice, fly};
use super::{Entry, Estimate, Piece, Profile, Technique};
use crate::math::{self, Sampler};
use crate::spectrum::Sampled;
use std::f32::consts::LN_2;

/// Ratio tracking of the residual beside a constant control per piece.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ResidualRatioTracking;

impl Technique for ResidualRatioTracking {
    const ENTRY: Entry = Entry {
        id: "residual-ratio",
        name: "Residual ratio tracking",
        formula: "T ≈ e^(−∫μc) Π (μr + μc − μ(tᵢ))/μr over collisions of rate μr = μ̄ − μmin",
        summary: "Exact where extinction is constant, with fewer collisions where it is far from zero. Wins \
                  inside dense media that vary little within a majorant cell; with a minorant of zero it \
                  costs as much as ratio tracking and gains only from the prediction of the mean.",
        cost: "one look-up and one logarithm per collision: ∫(μ̄ − μmin) of them; two exponentials per piece",
        reference: "Novák, Selle and Jarosz 2014, \"Residual ratio tracking for estimating attenuation in \
                    participating media\"",
        unbiased: true,
        has_pdf: false,
    };

    #[inline]
    fn estimate<P: Profile<N>, const N: usize>(&self, profile: &P, sampler: &mut Sampler) -> Estimate<N> {
        fly(profile, sampler, control, |choice, extinction, _| choice.ratio(extinction))
    }
}

/// Residual rate and control of a piece.
#[inline]
fn control<const N: usize>(piece: &Piece<N>) -> Choice<N> {
    // A majorant that is not a bound may lie below the minorant; the rate is zero only for constant
    // extinction.
    let largest = piece.segment.majorant.zip(piece.mean, f32::max);
    let rate = (largest - piece.minorant).max_component().max(0.0);
    // Infinite where few collisions are expected: the control is then the mean.
    let lift = rate * (math::exp(LN_2 / (piece.length() * rate)) - 1.0);
    let control: Sampled<N> = if rate > 0.0 {
        piece.mean.zip(piece.minorant, |mean, least| mean.min(least + lift))
    } else {
        piece.mean
    };
    Choice { rate, base: control + Sampled::splat(rate) }
}
