//! Henyey and Greenstein 1941: p(cos θ) = (1 − g²) / (4π (1 + g² − 2 g cos θ)^(3/2)), mean cosine g.

use super::Lobe;
use crate::math::INV_4PI;

#[derive(Clone, Copy, Debug)]
pub(super) struct HenyeyGreenstein {
    /// Mean cosine, −1 < g < 1.
    pub g: f32,
}

impl Lobe for HenyeyGreenstein {
    fn value(&self, one_minus_cos: f32) -> f32 {
        let g = self.g;
        // 1 + g² − 2 g cos θ = (1 − g)² + 2 g (1 − cos θ), whose terms do not cancel for g → 1.
        let d = (1.0 - g) * (1.0 - g) + 2.0 * g * one_minus_cos;
        INV_4PI * (1.0 - g) * (1.0 + g) / (d * d.sqrt())
    }

    /// The inverse of the cumulative distribution, solved for 1 − cos θ; with d = 1 − g + 2 g ξ it is
    /// 2 (1 − g)² (1 − ξ)(1 + g ξ) / d², well-behaved for every g including 0.
    fn sample(&self, u: f32) -> f32 {
        let g = self.g;
        let d = 1.0 - g + 2.0 * g * u;
        let r = (1.0 - g) / d;
        2.0 * r * r * (1.0 - u) * (1.0 + g * u)
    }
}
