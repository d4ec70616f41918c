//! Two Henyey–Greenstein lobes: p = w p_g₁ + (1 − w) p_g₂, mean cosine w g₁ + (1 − w) g₂.

use super::Lobe;
use super::henyey_greenstein::HenyeyGreenstein;
use crate::math::PolarAngle;

#[derive(Clone, Copy, Debug)]
pub(super) struct TwoLobe {
    pub first: HenyeyGreenstein,
    pub second: HenyeyGreenstein,
    /// Weight w of the first lobe, 0 to 1.
    pub share: f32,
}

impl Lobe for TwoLobe {
    #[inline]
    fn value(&self, theta: PolarAngle) -> f32 {
        self.share * self.first.value(theta) + (1.0 - self.share) * self.second.value(theta)
    }

    /// Selects a lobe and reuses the remainder of the random number to sample it.
    #[inline]
    fn sample(&self, u: f32) -> PolarAngle {
        if u < self.share {
            self.first.sample(u / self.share)
        } else {
            self.second.sample(((u - self.share) / (1.0 - self.share)).min(1.0))
        }
    }

    #[inline]
    fn mean_cosine(&self) -> f32 {
        self.share * self.first.g + (1.0 - self.share) * self.second.g
    }
}
