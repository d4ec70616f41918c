//! A second, noisier reference, to see what a noisy reference does to a measure that is not a square.

use std::f64::consts::TAU;

use super::average::Channel;
use crate::math::Sampler;

/// Fixed, so that a picture measured twice gives the same number.
const SEED: u64 = 0x6d65_6173_7572_6521;

/// What noise as large as the reference's adds to `distance(A, R)`: distance(A, R + σξ) − distance(A, R)
/// with one standard normal ξ. The reference has moved from the truth by one σξ already; a second step of
/// the same size shows about what the first has added (simulation extrapolation: Cook and Stefanski,
/// "Simulation-Extrapolation Estimation in Parametric Measurement Error Models", 1994, linear form).
pub(super) fn added_by_noise(channel: Channel, distance: impl Fn(f64, f64) -> f64) -> f64 {
    let Channel { a, r, noise, key } = channel;
    if noise == 0.0 {
        return 0.0;
    }
    distance(a, r + noise * normal(key)) - distance(a, r)
}

/// A standard normal number, by Box and Muller (1958).
fn normal(key: u64) -> f64 {
    let u = Sampler::new(SEED, key, 0).next_2d();
    // The first is below 1, so the logarithm is finite.
    (-2.0 * (-f64::from(u.x)).ln_1p()).sqrt() * (TAU * f64::from(u.y)).cos()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_replicate_is_normal() {
        let n = 100_000u64;
        let mut moments = [0.0; 4];
        for key in 0..n {
            let x = normal(key);
            for (k, m) in moments.iter_mut().enumerate() {
                *m += x.powi(k as i32 + 1) / n as f64;
            }
        }
        // Standard errors √(1, 2, 15, 96)/√n, five of them.
        for (m, (expected, sd)) in moments.iter().zip([(0.0, 1.0), (1.0, 1.5), (0.0, 3.9), (3.0, 9.8)]) {
            assert!((m - expected).abs() < 5.0 * sd / (n as f64).sqrt(), "{moments:?}");
        }
    }
}
