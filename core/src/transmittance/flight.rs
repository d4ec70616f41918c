//! Flights: a Poisson process of collisions along a ray, each of which multiplies the weight.
//!
//! With any base a(t) per component and any rate r(t) > 0 wherever a ≠ μ,
//!
//! ```text
//!   E[ e^(−∫(a − r) dt) · Π (a(tᵢ) − μ(tᵢ))/r(tᵢ) ] = e^(−∫μ dt)
//! ```
//!
//! over the collisions tᵢ of a Poisson process of rate r. A technique is defined by its choice of a and r.

use super::{Estimate, Piece, Profile};
use crate::math::Sampler;
use crate::spectrum::Sampled;

/// Rate and base that a technique chooses for a piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Choice<const N: usize> {
    /// Collision rate r per scene unit.
    pub rate: f32,
    /// Base a, per component and scene unit.
    pub base: Sampled<N>,
}

impl<const N: usize> Choice<N> {
    /// a = r for every component: only collisions change the weight.
    #[inline]
    pub fn shared(rate: f32) -> Self {
        Self { rate, base: Sampled::splat(rate) }
    }

    /// Ratio (a − μ)/r.
    #[inline]
    pub fn ratio(&self, extinction: Sampled<N>) -> Sampled<N> {
        (self.base - extinction) / self.rate
    }
}

/// Flies along the ray; every collision costs a look-up and multiplies the weight by `factor`, whose
/// expectation has to be [`Choice::ratio`]. Ends early once the weight is zero at all components.
#[inline]
pub(super) fn fly<P: Profile<N>, const N: usize>(
    profile: &P,
    sampler: &mut Sampler,
    choose: impl Fn(&Piece<N>) -> Choice<N>,
    factor: impl Fn(&Choice<N>, Sampled<N>, &mut Sampler) -> Sampled<N>,
) -> Estimate<N> {
    let mut weight = Sampled::ONE;
    let mut lookups = 0;
    let mut depth = sampler.next_optical_depth();
    for piece in profile.pieces() {
        let choice = choose(&piece);
        let beside = choice.base - Sampled::splat(choice.rate);
        if !beside.is_zero() {
            weight *= (-beside * piece.length()).exp();
        }
        let mut t = piece.segment.t0;
        loop {
            let left = choice.rate * (piece.segment.t1 - t);
            // Not `depth < left`, so that a rate of zero moves on to the next piece.
            if depth >= left {
                depth -= left;
                break;
            }
            t += depth / choice.rate;
            lookups += 1;
            weight *= factor(&choice, profile.extinction(t, &piece), sampler);
            if weight.is_zero() {
                return Estimate { weight, lookups };
            }
            depth = sampler.next_optical_depth();
        }
    }
    Estimate { weight, lookups }
}
