//! Henyey and Greenstein 1941: p(cos θ) = (1 − g²) / (4π (1 + g² − 2 g cos θ)^(3/2)), mean cosine g.

use super::Lobe;
use crate::math::{INV_4PI, PolarAngle};

#[derive(Clone, Copy, Debug)]
pub(super) struct HenyeyGreenstein {
    /// Mean cosine, −1 < g < 1.
    pub g: f32,
}

impl Lobe for HenyeyGreenstein {
    /// For g < 0 the lobe is that of −g, mirrored. With g ≥ 0, 1 + g² − 2 g cos θ is evaluated as
    /// (1 − g)² + 2 g (1 − cos θ), whose terms do not cancel for sharp lobes.
    #[inline]
    fn value(&self, theta: PolarAngle) -> f32 {
        let (g, theta) = if self.g < 0.0 { (-self.g, theta.mirrored()) } else { (self.g, theta) };
        let d = (1.0 - g) * (1.0 - g) + 2.0 * g * theta.one_minus_cos;
        INV_4PI * (1.0 - g) * (1.0 + g) / (d * d.sqrt())
    }

    /// Inverts the cumulative distribution, solved for 1 − cos θ: with d = 1 − g + 2 g ξ it is
    /// 2 (1 − g)² (1 − ξ)(1 + g ξ) / d², well-conditioned for every g ≥ 0 including 0.
    #[inline]
    fn sample(&self, u: f32) -> PolarAngle {
        let g = self.g.abs();
        let d = 1.0 - g + 2.0 * g * u;
        let r = (1.0 - g) / d;
        let theta = PolarAngle::from_one_minus_cos(2.0 * r * r * (1.0 - u) * (1.0 + g * u));
        if self.g < 0.0 { theta.mirrored() } else { theta }
    }

    #[inline]
    fn mean_cosine(&self) -> f32 {
        self.g
    }
}
