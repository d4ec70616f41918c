//! The same in every direction: p = 1/(4π).

use super::Lobe;
use crate::math::INV_4PI;

#[derive(Clone, Copy, Debug)]
pub(super) struct Isotropic;

impl Lobe for Isotropic {
    fn value(&self, _one_minus_cos: f32) -> f32 {
        INV_4PI
    }

    fn sample(&self, u: f32) -> f32 {
        2.0 * u
    }
}
