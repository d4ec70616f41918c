//! Products of hundreds of factors, without overflow.

use crate::spectrum::Lanes;
use std::fmt;

/// A product that neither overflows nor underflows, stored as its sign and the logarithm of its magnitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Product {
    negative: bool,
    ln: f64,
}

impl Product {
    /// The empty product.
    pub const ONE: Self = Self { negative: false, ln: 0.0 };

    /// Multiplies by a factor.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self { negative: self.negative != (factor < 0.0), ln: self.ln + factor.abs().ln() }
    }

    /// Multiplies by e^(−τ).
    #[must_use]
    pub fn attenuated(self, optical_depth: f64) -> Self {
        Self { ln: self.ln - optical_depth, ..self }
    }

    /// Natural logarithm of the magnitude; −∞ for zero.
    #[must_use]
    pub fn ln(self) -> f64 {
        self.ln
    }

    /// Divides by e^`ln`.
    #[must_use]
    pub fn over(self, ln: f64) -> f64 {
        let size = (self.ln - ln).exp();
        if self.negative { -size } else { size }
    }
}

/// Formats a number of any magnitude, e.g. `-1.25e-312`.
impl fmt::Display for Product {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.ln == f64::NEG_INFINITY {
            return f.write_str("0");
        }
        let log10 = self.ln / std::f64::consts::LN_10;
        // Values that round to 10.00 belong to the next power.
        let exponent = (log10 + 0.002).floor();
        let digits = 10f64.powf(log10 - exponent).max(1.0);
        let sign = if self.negative { "-" } else { "" };
        if (-3.0..4.0).contains(&exponent) {
            let value = digits * 10f64.powf(exponent);
            let decimals = (3.0 - exponent).clamp(0.0, 6.0) as usize;
            return write!(f, "{sign}{value:.decimals$}");
        }
        write!(f, "{sign}{digits:.2}e{exponent}")
    }
}

/// One product per component.
pub(super) type Products = [Product; 4];

/// Multiplies `products` by `factors`, component by component.
pub(super) fn times(products: &mut Products, factors: &Lanes) {
    for (product, factor) in products.iter_mut().zip(factors) {
        *product = product.times(f64::from(*factor));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_beyond_any_float_are_kept_and_written() {
        let tiny = (0..1000).fold(Product::ONE, |p, _| p.times(-1e-3));
        assert_eq!(tiny.to_string(), "1.00e-3000");
        assert!((tiny.over(tiny.ln() - 2.0).ln() - 2.0).abs() < 1e-9);
        assert_eq!(Product::ONE.times(-0.25).to_string(), "-0.2500");
        assert_eq!(Product::ONE.times(0.0).to_string(), "0");
        assert_eq!(Product::ONE.times(123.4).to_string(), "123.4");
        assert_eq!(Product::ONE.attenuated(1.0).times(0.0).over(5.0), 0.0);
    }
}
