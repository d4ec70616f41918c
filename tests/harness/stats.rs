//! Statistics that hold for heavy tails and for many comparisons at once.
//!
//! A render is repeated with independent seeds; each repeat's block means are batch means, whose own
//! scatter gives the standard error. A family of `n` comparisons is judged at the two-sided
//! significance that Šidák's correction leaves to each: 1 − (1 − α)^(1/n). Seeds are fixed, so on one
//! machine a test passes always or never. Another machine's exponentials may round otherwise, which is
//! as good as another seed: α is how often that would fail a true program.

/// False alarms per family and choice of seeds.
pub const ALPHA: f64 = 1e-5;

/// Mean and standard error of the mean.
pub fn mean_and_error(batches: &[f64]) -> (f64, f64) {
    let n = batches.len() as f64;
    let mean = batches.iter().sum::<f64>() / n;
    let variance = batches.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0);
    (mean, (variance / n).sqrt())
}

/// The two-sided quantile of Student's t distribution with `dof` degrees of freedom that a family of
/// `n` comparisons at level [`ALPHA`] allows to each.
pub fn sidak_t(n: usize, dof: f64) -> f64 {
    let p = 0.5 * -((-ALPHA).ln_1p() / n as f64).exp_m1();
    // Normal quantile by bisection on the complementary error function, then Hill's expansion to t.
    let (mut lo, mut hi) = (0.0f64, 40.0);
    for _ in 0..200 {
        let mid = 0.5 * (lo + hi);
        if t_tail(mid, dof) > p { lo = mid } else { hi = mid }
    }
    hi
}

/// P(T > t) for Student's t, by Simpson's rule on the density.
fn t_tail(t: f64, dof: f64) -> f64 {
    // Substituting t = tan θ √dof makes the density cos^(dof − 1) θ over a finite range.
    let theta = (t / dof.sqrt()).atan();
    let density = |x: f64| x.cos().powf(dof - 1.0);
    let simpson = |a: f64, b: f64| {
        let n = 2000;
        let h = (b - a) / f64::from(n);
        let mut sum = density(a) + density(b);
        for i in 1..n {
            sum += density(a + f64::from(i) * h) * if i % 2 == 1 { 4.0 } else { 2.0 };
        }
        sum * h / 3.0
    };
    let half = std::f64::consts::FRAC_PI_2;
    simpson(theta, half) / (2.0 * simpson(0.0, half))
}

/// One comparison of two independent estimates.
#[derive(Clone, Copy, Debug)]
pub struct Comparison {
    pub difference: f64,
    pub error: f64,
}

/// How a family of comparisons has come out.
#[derive(Debug)]
pub struct Verdict {
    pub comparisons: usize,
    /// Largest |difference| / error.
    pub worst: f64,
    /// What Šidák allows.
    pub allowed: f64,
}

impl Verdict {
    pub fn agrees(&self) -> bool {
        self.worst <= self.allowed
    }
}

/// Judges a family, each comparison resting on `dof` degrees of freedom. Differences up to `exact`,
/// such as single precision leaves where nothing is random, always pass.
pub fn judge(family: &[Comparison], dof: f64, exact: f64) -> Verdict {
    let worst = family
        .iter()
        .map(|c| if c.difference.abs() <= exact { 0.0 } else { c.difference.abs() / c.error.max(1e-300) })
        .fold(0.0, f64::max);
    Verdict { comparisons: family.len(), worst, allowed: sidak_t(family.len(), dof) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_match_tables() {
        // t for 31 degrees of freedom, two-sided 10⁻⁵: 5.267.
        assert!((sidak_t(1, 31.0) - 5.267).abs() < 5e-3, "{}", sidak_t(1, 31.0));
        assert!(sidak_t(100, 31.0) > sidak_t(10, 31.0));
        // 1000 degrees of freedom: 4.440.
        assert!((sidak_t(1, 1000.0) - 4.440).abs() < 5e-3, "{}", sidak_t(1, 1000.0));
    }

    #[test]
    fn a_bias_is_seen_and_a_coincidence_is_not() {
        let c = |difference| Comparison { difference, error: 0.01 };
        assert!(judge(&[c(0.02), c(-0.03)], 31.0, 0.0).agrees());
        assert!(!judge(&[c(0.0), c(0.08)], 31.0, 0.0).agrees());
    }
}
