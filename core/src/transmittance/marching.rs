//! Ray marching with a fixed step: exp of minus a quadrature. **Biased.**
//!
//! The estimate is too bright where positions are random, because the exponential is convex (Jensen), and
//! wrong either way where midpoints miss structure.

use super::comb::{Extent, comb};
use super::{Entry, Estimate, Profile, Technique};
use crate::math::Sampler;
use crate::spectrum::Sampled;

/// Position of a look-up within its step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Offset {
    /// In the middle: deterministic.
    Midpoint,
    /// Uniformly random, independently in each step.
    #[default]
    Jittered,
}

/// Ray marching.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marching {
    /// Step length in scene units, shortened so that whole steps fill the ray. Not positive: one step.
    pub step: f32,
    /// Position of the look-up within a step.
    pub offset: Offset,
}

impl Default for Marching {
    fn default() -> Self {
        Self { step: 0.05, offset: Offset::Jittered }
    }
}

/// Largest number of steps along one ray: the number of positions that single precision distinguishes.
const MAX_STEPS: f32 = 16_777_216.0;

impl Technique for Marching {
    const ENTRY: Entry = Entry {
        id: "marching",
        name: "Ray marching (biased)",
        formula: "T ≈ exp(−h Σ μ(tⱼ)) over steps of length h",
        summary: "Common in games and many tools. Low noise at a fixed cost, and biased: only shorter steps \
                  reduce the error, more samples do not. Wins nothing but time.",
        cost: "one look-up per step, one exponential",
        reference: "Perlin and Hoffert 1989, \"Hypertexture\"; jittered: Pauly, Kollig and Keller 2000, \
                    \"Metropolis light transport for participating media\"",
        unbiased: false,
        has_pdf: false,
    };

    #[inline]
    fn estimate<P: Profile<N>, const N: usize>(&self, profile: &P, sampler: &mut Sampler) -> Estimate<N> {
        let Some(extent) = Extent::of(profile) else {
            return Estimate { weight: Sampled::ONE, lookups: 0 };
        };
        // At least 1, also where the step is zero, negative or NaN.
        let steps = if self.step > 0.0 { (extent.length / self.step).ceil().min(MAX_STEPS) } else { 1.0 };
        let count = steps.max(1.0) as u32;
        let depth = comb(profile, &extent, count, || match self.offset {
            Offset::Midpoint => 0.5,
            Offset::Jittered => sampler.next_1d(),
        });
        Estimate { weight: (-depth).exp(), lookups: count }
    }
}
