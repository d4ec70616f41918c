//! Simulated noisier reference, which shows the effect of reference noise on measures that are not squares.

use std::f64::consts::TAU;

use super::average::Channel;
use crate::math::Sampler;

/// Fixed, so that measuring an image twice gives the same value.
const SEED: u64 = 0x6d65_6173_7572_6521;

/// Expected contribution of reference noise to `distance(A, R)`: distance(A, R + σξ) − distance(A, R) with
/// one standard normal ξ. The reference already differs from the truth by one σξ, and a second step of the
/// same size adds about as much as the first (simulation extrapolation: Cook and Stefanski,
/// "Simulation-Extrapolation Estimation in Parametric Measurement Error Models", 1994, linear form).
pub(super) fn added_by_noise(channel: Channel, distance: impl Fn(f64, f64) -> f64) -> f64 {
    let Channel { a, r, noise, key } = channel;
    if noise == 0.0 {
        return 0.0;
    }
    distance(a, r + noise * normal(key)) - distance(a, r)
}

/// Standard normal random number, by Box and Muller (1958).
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
        // Within five standard errors √(1, 2, 15, 96)/√n.
        for (m, (expected, sd)) in moments.iter().zip([(0.0, 1.0), (1.0, 1.5), (0.0, 3.9), (3.0, 9.8)]) {
            assert!((m - expected).abs() < 5.0 * sd / (n as f64).sqrt(), "{moments:?}");
        }
    }
}
