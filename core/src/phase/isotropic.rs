//! Isotropic phase function: p = 1/(4π).

use super::Lobe;
use crate::math::{INV_4PI, PolarAngle};

#[derive(Clone, Copy, Debug)]
pub(super) struct Isotropic;

impl Lobe for Isotropic {
    fn value(&self, _theta: PolarAngle) -> f32 {
        INV_4PI
    }

    fn sample(&self, u: f32) -> PolarAngle {
        PolarAngle::from_one_minus_cos(2.0 * u)
    }

    fn mean_cosine(&self) -> f32 {
        0.0
    }
}
