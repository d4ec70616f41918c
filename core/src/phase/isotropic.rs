//! Isotropic phase function: p = 1/(4π).

use super::Lobe;
use crate::math::{INV_4PI, PolarAngle};

#[derive(Clone, Copy, Debug)]
pub(super) struct Isotropic;

impl Lobe for Isotropic {
    #[inline]
    fn value(&self, _theta: PolarAngle) -> f32 {
        INV_4PI
    }

    #[inline]
    fn sample(&self, u: f32) -> PolarAngle {
        PolarAngle::from_one_minus_cos(2.0 * u)
    }

    #[inline]
    fn mean_cosine(&self) -> f32 {
        0.0
    }
}
