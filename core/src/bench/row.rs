//! Statistics over the trials of one estimator on one scene.

use crate::compare::report::words;
use serde::Serialize;
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Measurements of one run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// Samples per pixel.
    pub spp: u64,
    /// Wall-clock seconds from start to end.
    pub wall_seconds: f64,
    /// CPU seconds of all threads.
    pub cpu_seconds: f64,
    /// Paths traced.
    pub paths: u64,
    /// Look-ups of the medium.
    pub lookups: u64,
    /// Paths without a finite value, which are excluded from the film.
    pub non_finite: u64,
    /// Relative mean squared error, minus the expected contribution of the reference noise.
    pub relmse: f64,
}

/// A mean with its 95 % confidence interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Interval {
    /// The mean.
    pub mean: f64,
    /// Lower end.
    pub lo: f64,
    /// Upper end; infinite if there is no finite bound.
    pub hi: f64,
}

/// Statistics of one estimator on one scene. Every field is a key of the JSON output.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The scene.
    pub scene: String,
    /// Estimator id, or the name of the candidate with its settings.
    pub estimator: String,
    /// Number of runs.
    pub repeats: usize,
    /// Worker threads.
    pub threads: usize,
    /// Mean samples per pixel of a run.
    pub spp: f64,
    /// Mean wall-clock seconds of a run.
    pub wall_seconds: f64,
    /// Mean CPU seconds of a run.
    pub cpu_seconds: f64,
    /// Paths per second of wall-clock time.
    pub paths_per_second: f64,
    /// Look-ups per path.
    pub lookups_per_path: f64,
    /// Fraction of paths without a finite value. They are excluded, which biases the estimate.
    pub lost: f64,
    /// Relative mean squared error of a run.
    pub relmse: Interval,
    /// 1/(relMSE · CPU seconds).
    pub efficiency: Interval,
    /// Look-ups · relMSE: the number of look-ups that reduces the error to 1.
    pub lookups_to_unit_error: Interval,
    /// Efficiency relative to the first estimator.
    pub speedup: Interval,
    /// Whether one run has more than half of the total error. Rare bright paths then dominate, and the
    /// intervals are too narrow.
    pub heavy_tailed: bool,
    /// Origin of the reference.
    pub reference: String,
    /// The individual runs.
    #[serde(skip)]
    pub trials: Vec<Trial>,
}

/// Half width of a 95 % interval, in standard errors of a mean of `n` values.
fn quantile(n: usize) -> f64 {
    StudentsT::new(0.0, 1.0, n as f64 - 1.0).map_or(f64::INFINITY, |t| t.inverse_cdf(0.975))
}

/// Mean and standard error of the mean.
fn moments(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let n = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / n;
    let variance = values.map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0);
    (mean, (variance / n).sqrt())
}

impl Interval {
    fn of(values: impl Iterator<Item = f64> + Clone) -> Self {
        let t = quantile(values.clone().count());
        let (mean, error) = moments(values);
        Self { mean, lo: (mean - t * error).max(0.0), hi: mean + t * error }
    }

    /// Mean and interval with three digits each: `0.0123 [0.0120, 0.0126]`. The interval is omitted if its
    /// width is 0.
    #[must_use]
    pub fn in_words(&self) -> String {
        self.written(words::number)
    }

    /// Formatted as a ratio: `2.31 [2.10, 2.54]`.
    #[must_use]
    pub fn as_ratio(&self) -> String {
        self.written(words::times)
    }

    fn written(&self, write: fn(f64) -> String) -> String {
        if self.lo == self.hi {
            return write(self.mean);
        }
        format!("{} [{}, {}]", write(self.mean), write(self.lo), write(self.hi))
    }

    /// Interval of the reciprocal of a positive quantity.
    fn inverse(self) -> Self {
        Self { mean: 1.0 / self.mean, lo: 1.0 / self.hi, hi: 1.0 / self.lo }
    }
}

impl Row {
    /// Summarises trials; the speed-up is relative to `first`.
    #[must_use]
    pub fn new(
        scene: String,
        estimator: String,
        trials: &[Trial],
        first: &[Trial],
        (threads, reference): (usize, String),
    ) -> Self {
        let mean = |of: fn(&Trial) -> f64| trials.iter().map(of).sum::<f64>() / trials.len() as f64;
        let errors = trials.iter().map(|t| t.relmse);
        let total: f64 = errors.clone().sum();
        let largest = errors.clone().fold(0.0, f64::max);
        Self {
            scene,
            estimator,
            repeats: trials.len(),
            threads,
            spp: mean(|t| t.spp as f64),
            wall_seconds: mean(|t| t.wall_seconds),
            cpu_seconds: mean(|t| t.cpu_seconds),
            paths_per_second: mean(|t| t.paths as f64 / t.wall_seconds),
            lookups_per_path: mean(|t| t.lookups as f64 / t.paths as f64),
            lost: mean(|t| t.non_finite as f64 / t.paths as f64),
            relmse: Interval::of(errors),
            efficiency: Interval::of(trials.iter().map(cost)).inverse(),
            lookups_to_unit_error: Interval::of(trials.iter().map(|t| t.lookups as f64 * t.relmse)),
            speedup: speedup(trials.iter().map(cost), first.iter().map(cost)),
            heavy_tailed: trials.len() > 2 && largest > 0.5 * total,
            reference,
            trials: trials.to_vec(),
        }
    }

    /// Efficiency relative to another row of the same scene, with its 95 % interval.
    #[must_use]
    pub fn speedup_over(&self, other: &Self) -> Interval {
        speedup(self.trials.iter().map(cost), other.trials.iter().map(cost))
    }

    /// Paths per CPU second relative to another row of the same scene, with its 95 % interval. Measures the
    /// cost of a path independently of its variance.
    #[must_use]
    pub fn pace_over(&self, other: &Self) -> Interval {
        let seconds = |t: &Trial| t.cpu_seconds / t.paths as f64;
        speedup(self.trials.iter().map(seconds), other.trials.iter().map(seconds))
    }
}

/// Error times CPU seconds, the reciprocal of the efficiency.
fn cost(trial: &Trial) -> f64 {
    trial.relmse * trial.cpu_seconds
}

/// Ratio of the mean costs, `first` over `own`. The interval is that of the logarithm, to first order.
fn speedup(own: impl Iterator<Item = f64> + Clone, first: impl Iterator<Item = f64> + Clone) -> Interval {
    if own.clone().eq(first.clone()) {
        return Interval { mean: 1.0, lo: 1.0, hi: 1.0 };
    }
    let t = quantile(own.clone().count());
    let ((own, own_error), (first, first_error)) = (moments(own), moments(first));
    let ratio = first / own;
    let spread = (t * (own_error / own).hypot(first_error / first)).exp();
    Interval { mean: ratio, lo: ratio / spread, hi: ratio * spread }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Sampler;

    fn trial(relmse: f64, cpu_seconds: f64) -> Trial {
        Trial { spp: 8, wall_seconds: 1.0, cpu_seconds, paths: 100, lookups: 400, non_finite: 1, relmse }
    }

    fn row(trials: &[Trial], first: &[Trial]) -> Row {
        Row::new("scene".into(), "nee".into(), trials, first, (2, "itself".into()))
    }

    #[test]
    fn figures_follow_their_definitions() {
        let trials = [trial(0.1, 2.0), trial(0.3, 2.0)];
        let r = row(&trials, &[trial(0.4, 2.0), trial(0.4, 2.0)]);
        assert!((r.relmse.mean - 0.2).abs() < 1e-12 && (r.efficiency.mean - 2.5).abs() < 1e-12);
        assert!((r.speedup.mean - 2.0).abs() < 1e-12 && r.speedup.lo < 2.0 && r.speedup.hi > 2.0);
        assert!((r.lookups_to_unit_error.mean - 80.0).abs() < 1e-9);
        assert_eq!((r.lookups_per_path, r.paths_per_second, r.lost), (4.0, 100.0, 0.01));
        // With so large a difference between two trials, the interval of the error includes zero.
        assert_eq!((r.relmse.lo, r.efficiency.hi), (0.0, f64::INFINITY));
        assert_eq!(row(&trials, &trials).speedup, Interval { mean: 1.0, lo: 1.0, hi: 1.0 });
        let other = [trial(0.4, 2.0), trial(0.4, 2.0)];
        assert_eq!(row(&trials, &trials).speedup_over(&row(&other, &trials)), r.speedup);
        // Half the error in the same time leaves the pace unchanged; the same error in half the time doubles
        // it.
        let pace = |seconds: f64| row(&[0.1, 0.3].map(|e| trial(e, seconds)), &trials);
        assert_eq!(pace(2.0).pace_over(&row(&other, &trials)).mean, 1.0);
        assert_eq!(pace(1.0).pace_over(&pace(2.0)), Interval { mean: 2.0, lo: 2.0, hi: 2.0 });
        assert_eq!(Interval { mean: 2.0, lo: 1.5, hi: 12.0 }.as_ratio(), "2.00 [1.50, 12.0]");
        assert_eq!(Interval { mean: 2.0, lo: 2.0, hi: 2.0 }.in_words(), "2.00");
        assert!(!r.heavy_tailed && row(&[0.1, 0.1, 0.9].map(|e| trial(e, 1.0)), &trials).heavy_tailed);
    }

    #[test]
    fn intervals_hold_the_truth_as_often_as_they_say() {
        let runs = 400u64;
        let held = |which: fn(&Row) -> (Interval, f64)| {
            let holds = |run: &u64| {
                let mut random = Sampler::new(11, *run, 0);
                // A sum of a few exponentials of mean 1, skewed as errors are.
                let mut error =
                    || (0..24).map(|_| f64::from(random.next_optical_depth())).sum::<f64>() / 24.0;
                let own: Vec<_> = (0..6).map(|_| trial(error(), 1.0)).collect();
                let first: Vec<_> = (0..6).map(|_| trial(3.0 * error(), 1.0)).collect();
                let (interval, truth) = which(&row(&own, &first));
                (interval.lo..=interval.hi).contains(&truth)
            };
            (0..runs).filter(holds).count()
        };
        for count in [held(|r| (r.efficiency, 1.0)), held(|r| (r.speedup, 3.0)), held(|r| (r.relmse, 1.0))] {
            assert!((365..=396).contains(&count), "{count} of {runs}");
        }
    }
}
