//! χ² tests of samples against their probability density.
//!
//! A family of `n` tests is judged together, with Šidák's correction: the significance level of each is
//! 1 − (1 − α)^(1/n). Seeds are fixed, so that on one machine a test passes always or never.

mod directions;

use statrs::distribution::{ChiSquared, ContinuousCDF, StudentsT};

/// Probability of a false positive per family and choice of seeds; ten families in a file stay below 10⁻⁵.
pub const ALPHA: f64 = 1e-6;

/// Minimum expected count of a bin; bins with less are merged, because their counts are not normally
/// distributed.
const FEWEST: f64 = 20.0;

/// A family of tests that is judged together.
#[derive(Default)]
pub struct Family {
    /// Name, result and p-value of each test.
    tests: Vec<(String, String, f64)>,
}

impl Family {
    /// Tests observed counts against expected shares, which add up to one.
    pub fn counts(&mut self, name: &str, observed: &[u64], shares: &[f64]) {
        let total: f64 = shares.iter().sum();
        assert!((total - 1.0).abs() < 1e-9, "{name}: the shares add up to {total}");
        for (bin, (count, share)) in observed.iter().zip(shares).enumerate() {
            assert!(*share > 0.0 || *count == 0, "{name}: {count} samples in bin {bin}, which has no share");
        }
        self.chi2(name, observed, shares);
    }

    /// Tests numbers for uniformity over 0 to 1: samples mapped by their cumulative distribution.
    pub fn uniform(&mut self, name: &str, values: impl IntoIterator<Item = f64>) {
        const BINS: usize = 100;
        let mut observed = [0; BINS];
        for value in values {
            assert!((-1e-6..=1.0 + 1e-6).contains(&value), "{name}: {value} lies outside 0 to 1");
            observed[((value * BINS as f64) as usize).min(BINS - 1)] += 1;
        }
        self.chi2(name, &observed, &[1.0 / BINS as f64; BINS]);
    }

    /// Tests the mean of independent numbers by Student's t-test.
    pub fn mean(&mut self, name: &str, values: &[f64], expected: f64) {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let variance = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0);
        let t = (mean - expected) / (variance / n).sqrt();
        let p = 2.0 * StudentsT::new(0.0, 1.0, n - 1.0).unwrap().sf(t.abs());
        self.tests.push((name.to_owned(), format!("mean {mean}, not {expected}: t = {t:.2}"), p));
    }

    fn chi2(&mut self, name: &str, observed: &[u64], shares: &[f64]) {
        assert_eq!(observed.len(), shares.len());
        let n = observed.iter().sum::<u64>() as f64;
        assert!(n > 0.0, "{name}: no samples");
        let bins = merged(observed.iter().zip(shares).map(|(o, s)| (*o as f64, s * n)));
        // A single bin cannot be tested.
        if bins.len() < 2 {
            return;
        }
        let chi2: f64 = bins.iter().map(|(o, e)| (o - e).powi(2) / e).sum();
        let dof = (bins.len() - 1) as f64;
        let p = ChiSquared::new(dof).unwrap().sf(chi2);
        self.tests.push((name.to_owned(), format!("χ² = {chi2:.1} with {dof} degrees of freedom"), p));
    }

    /// Fails if the p-value of any test is below the significance level.
    pub fn judge(self) {
        let n = self.tests.len() as f64;
        let allowed = -((-ALPHA).ln_1p() / n).exp_m1();
        let worst = self.tests.iter().min_by(|a, b| a.2.total_cmp(&b.2)).expect("a family of no tests");
        println!("{n} tests at {allowed:.1e} each; the least likely: {worst:?}");
        let failed: Vec<_> = self.tests.iter().filter(|t| t.2.is_nan() || t.2 < allowed).collect();
        assert!(failed.is_empty(), "{} of {n} tests at {allowed:.1e} each: {failed:#?}", failed.len());
    }
}

/// Bins as (observed, expected), with those below [`FEWEST`] expected samples merged.
fn merged(bins: impl Iterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    let mut bins: Vec<_> = bins.collect();
    bins.sort_by(|a, b| b.1.total_cmp(&a.1));
    let kept = bins.partition_point(|b| b.1 >= FEWEST);
    let rest = bins.split_off(kept).into_iter().fold((0.0, 0.0), |sum, b| (sum.0 + b.0, sum.1 + b.1));
    match bins.last_mut() {
        Some(last) if rest.1 < FEWEST => *last = (last.0 + rest.0, last.1 + rest.1),
        _ => bins.push(rest),
    }
    bins
}

#[cfg(test)]
mod tests {
    use super::*;

    fn passes(family: Family) -> bool {
        std::panic::catch_unwind(|| family.judge()).is_ok()
    }

    fn coin(heads: u64, share: f64) -> bool {
        let mut family = Family::default();
        family.counts("coin", &[heads, 10_000 - heads], &[share, 1.0 - share]);
        passes(family)
    }

    #[test]
    fn a_bias_is_seen_and_a_coincidence_is_not() {
        // The standard deviation is 50; 10⁻⁶ corresponds to 4.9 standard deviations.
        assert!(coin(5100, 0.5) && coin(5240, 0.5));
        assert!(!coin(5250, 0.5) && !coin(4750, 0.5));
        // A family of a hundred tests allows 5.7.
        let together = |heads: u64| {
            let mut family = Family::default();
            (0..100).for_each(|_| family.counts("coin", &[heads, 10_000 - heads], &[0.5, 0.5]));
            passes(family)
        };
        assert!(together(5280) && !together(5290));
    }

    #[test]
    fn small_bins_are_merged() {
        let bins = merged([(30.0, 25.0), (3.0, 4.0), (1.0, 2.0), (50.0, 53.0)].into_iter());
        assert_eq!(bins, [(50.0, 53.0), (34.0, 31.0)]);
    }

    #[test]
    fn a_mean_is_judged_by_its_own_scatter() {
        let values: Vec<f64> = (0..1000).map(|i| f64::from(i % 10)).collect();
        let mean_is = |expected: f64| {
            let mut family = Family::default();
            family.mean("digits", &values, expected);
            passes(family)
        };
        // The standard error is 0.091.
        assert!(mean_is(4.5) && mean_is(4.1) && !mean_is(4.0));
    }
}
