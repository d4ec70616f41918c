//! Ray marching with a fixed step: exp of minus a quadrature. **Biased**, towards too much light where places are
//! drawn at random, for the exponential is convex (Jensen), and any way where midpoints miss structure.

use super::comb::{Extent, comb};
use super::{Entry, Estimate, Profile, Technique};
use crate::math::Sampler;
use crate::spectrum::Sampled;

/// Where in its step a look-up is made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Offset {
    /// In the middle: the same number every time.
    Midpoint,
    /// Anywhere, independently in each step.
    #[default]
    Jittered,
}

/// Ray marching.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marching {
    /// Scene units per step; shortened until steps fill the ray. Not positive: one step.
    pub step: f32,
    /// Where in a step the look-up is made.
    pub offset: Offset,
}

impl Default for Marching {
    fn default() -> Self {
        Self { step: 0.05, offset: Offset::Jittered }
    }
}

/// The most steps along one ray: as many as places that a single-precision number tells apart.
const MAX_STEPS: f32 = 16_777_216.0;

impl Technique for Marching {
    const ENTRY: Entry = Entry {
        id: "marching",
        name: "Ray marching (biased)",
        formula: "T ≈ exp(−h Σ μ(tⱼ)) over steps of length h",
        summary: "What games and many tools do. Little noise at a known price, and wrong: more samples do not help, \
                  only shorter steps do. Wins nothing but time.",
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
        // As a maximum of 1 also where the step is zero, negative or not a number.
        let steps = if self.step > 0.0 { (extent.length / self.step).ceil().min(MAX_STEPS) } else { 1.0 };
        let count = steps.max(1.0) as u32;
        let depth = comb(profile, &extent, count, || match self.offset {
            Offset::Midpoint => 0.5,
            Offset::Jittered => sampler.next_1d(),
        });
        Estimate { weight: (-depth).exp(), lookups: count }
    }
}
