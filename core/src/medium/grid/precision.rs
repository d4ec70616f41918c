//! How densities are kept and looked up.

use serde::{Deserialize, Serialize};

/// How many bits a value takes in memory. Less than [`Self::F32`] renders a slightly different density; the
/// largest error in any value is measured and shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Precision {
    /// As read.
    #[default]
    F32,
    /// Half floats: relative error at most 2^−11 above 6·10^−5.
    F16,
    /// 255 steps from zero to the largest value: absolute error at most 1/510 of that.
    U8,
}

/// How a density is looked up between samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Interpolation {
    /// Eight samples, weighted.
    #[default]
    Trilinear,
    /// One of the eight, drawn by its weight. Unbiased: events and transmittances are linear in every density
    /// that is looked up. A look-up is cheaper, majorants are looser, and connections are noisier.
    Stochastic,
}
