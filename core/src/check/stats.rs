//! Statistics for heavy-tailed estimates and many simultaneous comparisons.
//!
//! A render is repeated with independent random numbers. The block means of each repeat are *batch means*,
//! whose scatter gives the standard error of their mean, with `batches − 1` degrees of freedom. In a family
//! of `n` comparisons each is tested by Student's t at the two-sided significance 1 − (1 − α)^(1/n) of
//! Šidák's correction. A comparison has the *power* to detect a bias b if
//!
//! ```text
//!   b ≥ (t_critical + t_power) · standard error
//! ```
//!
//! Seeds are fixed, so that on one machine a check always passes or always fails. Exponentials may round
//! differently on another machine, which is equivalent to another seed: [`ALPHA`] is the probability that a
//! correct program fails there.

use statrs::distribution::{ContinuousCDF, StudentsT};

/// Probability of a false alarm per family of comparisons and choice of seeds.
pub const ALPHA: f64 = 1e-3;

/// Probability with which a bias of the stated size is detected.
pub const POWER: f64 = 0.95;

/// Mean and standard error of the mean.
#[must_use]
pub fn mean_and_error(batches: &[f64]) -> (f64, f64) {
    let n = batches.len() as f64;
    let mean = batches.iter().sum::<f64>() / n;
    let variance = batches.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0);
    (mean, (variance / n).sqrt())
}

/// The t that |difference| / error exceeds with probability [`ALPHA`] in any of `comparisons` without a bias,
/// where each comparison has `dof` degrees of freedom.
#[must_use]
pub fn critical_t(comparisons: usize, dof: f64) -> f64 {
    let each = -((-ALPHA).ln_1p() / comparisons.max(1) as f64).exp_m1();
    upper_t(0.5 * each, dof)
}

/// Excess over [`critical_t`], in standard errors, with which a bias is detected with probability [`POWER`].
#[must_use]
pub fn power_t(dof: f64) -> f64 {
    upper_t(1.0 - POWER, dof)
}

/// P(|T| > |t|) for Student's t.
#[must_use]
pub fn two_sided_p(t: f64, dof: f64) -> f64 {
    StudentsT::new(0.0, 1.0, dof).map_or(f64::NAN, |d| 2.0 * d.cdf(-t.abs()))
}

/// The t with P(T > t) = p, by bisection on the lower tail, where small probabilities keep their precision.
fn upper_t(p: f64, dof: f64) -> f64 {
    let (mut lo, mut hi) = (0.0f64, 1e3);
    for _ in 0..80 {
        let mid = 0.5 * (lo + hi);
        if 0.5 * two_sided_p(mid, dof) > p { lo = mid } else { hi = mid }
    }
    hi
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_match_tables() {
        // Two-sided 10⁻³: 3.633 for 31 degrees of freedom, 3.300 for 1000.
        assert!((critical_t(1, 31.0) - 3.633).abs() < 2e-3, "{}", critical_t(1, 31.0));
        assert!((critical_t(1, 1000.0) - 3.300).abs() < 2e-3, "{}", critical_t(1, 1000.0));
        // One-sided 5 %: 1.6955 for 31.
        assert!((power_t(31.0) - 1.6955).abs() < 1e-3, "{}", power_t(31.0));
        // Far tail: two-sided 10⁻⁹ for 63 degrees of freedom is 7.13.
        assert!((two_sided_p(7.13, 63.0) / 1e-9 - 1.0).abs() < 0.3, "{}", two_sided_p(7.13, 63.0));
        assert!(critical_t(100, 31.0) > critical_t(10, 31.0));
    }

    #[test]
    fn means_and_errors_are_those_of_the_batches() {
        let (mean, error) = mean_and_error(&[1.0, 2.0, 3.0, 4.0]);
        assert_eq!(mean, 2.5);
        assert!((error - (5.0f64 / 12.0).sqrt()).abs() < 1e-12);
    }
}
