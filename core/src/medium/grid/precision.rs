//! Precision and interpolation of grids.

use serde::{Deserialize, Serialize};

/// Precision of grid values in memory. Less than [`Self::F32`] renders a slightly different density; the
/// maximum error of any value is measured and displayed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Precision {
    /// Single precision, as read from the file.
    #[default]
    F32,
    /// Half precision: relative error at most 2^−11 above 6·10^−5.
    F16,
    /// 8 bits, in 255 steps from zero to the maximum: absolute error at most 1/510 of the maximum.
    U8,
}

/// Interpolation of a grid between samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Interpolation {
    /// Trilinear interpolation of eight samples.
    #[default]
    Trilinear,
    /// One of the eight samples, selected with its trilinear weight. Unbiased: events and transmittances are
    /// linear in every density that is looked up. A look-up is cheaper, but majorants are looser and
    /// connections noisier.
    Stochastic,
}
