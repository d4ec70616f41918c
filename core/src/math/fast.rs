//! Elementary functions for inner loops: branchless polynomials, accurate to a few units in the last place,
//! which the compiler inlines and vectorises over all components of a path.
//!
//! They also return the same bits on every platform, which the standard library does not guarantee.

use std::f32::consts::{LN_2, LOG2_E};

/// Nearest integer, ties to even, for |x| < 2^22. The library function is a call on processors without an
/// instruction for it.
#[inline]
fn nearest(x: f32) -> f32 {
    const SHIFT: f32 = 12_582_912.0;
    (x + SHIFT) - SHIFT
}

/// ln x for a positive, normal x; absolute error below 1.2e-7 times the larger of 1 and |ln x|.
///
/// x = 2^k m with m in [√½, √2); ln m by the odd series in s = (m − 1)/(m + 1), |s| < 0.172.
#[must_use]
#[inline]
pub fn ln(x: f32) -> f32 {
    const SQRT_HALF_BITS: u32 = 0x3f35_04f3;
    let shifted = x.to_bits().wrapping_sub(SQRT_HALF_BITS);
    let exponent = (shifted as i32) >> 23;
    let mantissa = f32::from_bits((shifted & 0x007f_ffff) + SQRT_HALF_BITS);
    let f = mantissa - 1.0;
    let s = f / (2.0 + f);
    let z = s * s;
    // 2 atanh(s) = 2 s (1 + z/3 + z²/5 + …), the last factor fitted.
    let series = z * (0.666_666_6 + z * (0.400_009_7 + z * (0.284_987_87 + z * 0.242_790_79)));
    let half = 0.5 * f * f;
    exponent as f32 * LN_2 + (f - (half - s * (half + series)))
}

/// e^x; relative error below 2e-7 for |x| ≤ 87, zero below −103, infinite above 89.
///
/// x = k ln 2 + r with |r| ≤ ½ ln 2; e^r by a polynomial.
#[must_use]
#[inline]
pub fn exp(x: f32) -> f32 {
    // ln 2 in two parts, the first with few digits, so that its product with k is exact.
    const HIGH: f32 = 0.693_359_4;
    const LOW: f32 = -2.121_944_4e-4;
    let x = x.clamp(-104.0, 90.0);
    let k = nearest(x * LOG2_E);
    let r = x - k * HIGH - k * LOW;
    let p = 1.987_569_1e-4;
    let p = p * r + 1.398_199_9e-3;
    let p = p * r + 8.333_452e-3;
    let p = p * r + 4.166_579_6e-2;
    let p = p * r + 1.666_666_5e-1;
    let p = p * r + 0.5;
    let e = p * r * r + r + 1.0;
    // 2^k in two factors, so that results near the smallest and largest numbers are representable.
    let k = k as i32;
    let half = k >> 1;
    let power = |n: i32| f32::from_bits(((n + 127) as u32) << 23);
    e * power(half) * power(k - half)
}

/// Sine and cosine of an angle in turns, 0 ≤ u ≤ 1; absolute error below 2e-7.
#[must_use]
#[inline]
pub fn sin_cos_turns(u: f32) -> (f32, f32) {
    // The nearest quarter turn, and a remainder of at most an eighth of a turn.
    let quarter = nearest(4.0 * u);
    let x = (u - 0.25 * quarter) * std::f32::consts::TAU;
    let z = x * x;
    let sin = x + x * z * (-1.666_665_5e-1 + z * (8.332_161e-3 - z * 1.951_529_6e-4));
    let cos = 1.0 - 0.5 * z + z * z * (4.166_664_6e-2 + z * (-1.388_731_6e-3 + z * 2.443_315_7e-5));
    let q = quarter as i32;
    let (s, c) = if q & 1 == 0 { (sin, cos) } else { (cos, sin) };
    (if q & 2 == 0 { s } else { -s }, if (q + 1) & 2 == 0 { c } else { -c })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithms_and_exponentials_keep_their_digits() {
        for i in 1..=(1u32 << 24) {
            if i % 997 != 0 && i > 4096 && i < (1 << 24) - 4096 {
                continue;
            }
            let x = i as f32 / 16_777_216.0;
            let exact = f64::from(x).ln();
            let error = (f64::from(ln(x)) - exact).abs();
            assert!(error <= 1.2e-7 * exact.abs().max(1.0), "ln {x}: {error:e}");
        }
        for i in -87_000..=87_000i32 {
            let x = i as f32 * 1e-3;
            let exact = f64::from(x).exp();
            let error = (f64::from(exp(x)) / exact - 1.0).abs();
            assert!(error <= 2e-7, "exp {x}: {error:e}");
        }
        assert_eq!((exp(0.0), exp(-200.0), exp(200.0)), (1.0, 0.0, f32::INFINITY));
        assert_eq!(ln(1.0), 0.0);
    }

    #[test]
    fn angles_keep_their_digits_all_around() {
        for i in 0..=100_000u32 {
            let u = i as f32 / 100_000.0;
            let (s, c) = (f64::from(u) * std::f64::consts::TAU).sin_cos();
            let (sin, cos) = sin_cos_turns(u);
            let error = (f64::from(sin) - s).abs().max((f64::from(cos) - c).abs());
            assert!(error <= 2e-7, "{u}: {error:e}");
        }
    }
}
