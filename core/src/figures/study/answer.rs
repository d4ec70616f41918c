//! Answers to questions, derived from the rows of a scene.

use super::{Criterion, Question};
use crate::bench::{Interval, Row};
use serde::Serialize;

/// Answer to a question on one scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Answer {
    /// Id of the question.
    pub question: &'static str,
    /// Variant under test.
    pub variant: &'static str,
    /// Variant that it is compared with.
    pub against: &'static str,
    /// Criterion: `efficiency` or `paths per second`.
    pub by: &'static str,
    /// Ratio of the criterion, with its 95 % interval.
    pub ratio: Interval,
    /// Interpretation of the ratio.
    pub outcome: Outcome,
}

/// Interpretation of an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// The interval is above 1.
    Better,
    /// The interval is below 1.
    Worse,
    /// The interval contains 1, or is not known.
    Open,
    /// The interval excludes 1, but one run has most of the error of the variant that appears better. Rare
    /// bright paths that it mostly missed could make it appear so.
    HeavyTailed,
}

impl Outcome {
    /// Display text.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Better => "better",
            Self::Worse => "worse",
            Self::Open => "not decided",
            Self::HeavyTailed => "not decided: rare bright paths",
        }
    }
}

impl Question {
    /// Answers the question; `None` if one of the two variants did not run.
    #[must_use]
    pub fn answer(&self, rows: &[Row]) -> Option<Answer> {
        let row = |id: &str| rows.iter().find(|row| row.estimator == id);
        let (variant, against) = (row(self.variant)?, row(self.against)?);
        let (ratio, [own_tail, other_tail]) = match self.criterion {
            Criterion::Efficiency => {
                (variant.speedup_over(against), [variant.heavy_tailed, against.heavy_tailed])
            }
            Criterion::Pace => (variant.pace_over(against), [false; 2]),
        };
        // An outlier in the worse variant does not weaken its result: runs that missed rare paths
        // underestimate the error.
        let outcome = match ratio {
            // An error that does not exceed the noise of the reference is not significant.
            Interval { mean, .. } if !(mean > 0.0 && mean.is_finite()) => Outcome::Open,
            Interval { lo, .. } if lo > 1.0 && own_tail => Outcome::HeavyTailed,
            Interval { hi, .. } if hi < 1.0 && other_tail => Outcome::HeavyTailed,
            Interval { lo, .. } if lo > 1.0 => Outcome::Better,
            Interval { hi, .. } if hi < 1.0 => Outcome::Worse,
            _ => Outcome::Open,
        };
        let (question, variant, against) = (self.id, self.variant, self.against);
        Some(Answer { question, variant, against, by: self.criterion.unit(), ratio, outcome })
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::bench::Trial;
    use crate::figures::study::questions;

    /// Rows with these errors; each run takes one CPU second for the given number of paths, of which one was
    /// lost.
    pub fn row(scene: &str, id: &str, errors: &[f64], paths: u64) -> Row {
        let trial = |e: &f64| Trial {
            spp: 4,
            wall_seconds: 1.0,
            cpu_seconds: 1.0,
            paths,
            lookups: 500,
            non_finite: u64::from(id == "uni-nee-mis-apart-f32"),
            relmse: *e,
        };
        let trials: Vec<_> = errors.iter().map(trial).collect();
        Row::new(scene.into(), id.into(), &trials, &trials, (1, "a reference".into()))
    }

    fn outcome(question: &str, new: (&[f64], u64), old: (&[f64], u64)) -> (Outcome, f64) {
        let question = questions().find(|q| q.id == question).unwrap();
        let rows = [row("s", question.variant, new.0, new.1), row("s", question.against, old.0, old.1)];
        let answer = question.answer(&rows).unwrap();
        (answer.outcome, answer.ratio.mean)
    }

    #[test]
    fn intervals_decide_and_outliers_count_only_against_their_variant() {
        let by_error = |new: &[f64], old: &[f64]| outcome("null-scattering", (new, 100), (old, 100));
        let even = [0.10, 0.11, 0.09, 0.10];
        let better = even.map(|e| e / 4.0);
        let (found, ratio) = by_error(&better, &even);
        assert!(found == Outcome::Better && (ratio - 4.0).abs() < 1e-9);
        assert_eq!(by_error(&even, &better).0, Outcome::Worse);
        assert_eq!(by_error(&even, &[0.12, 0.08, 0.13, 0.09]).0, Outcome::Open);
        // Errors dominated by one run are accepted if the variant is worse …
        let outlier = [1.0, 1.0, 1.0, 3.1];
        assert!(row("s", "nee", &outlier, 100).heavy_tailed);
        assert_eq!(by_error(&even, &outlier).0, Outcome::Better);
        // … and not if it is better.
        assert_eq!(by_error(&outlier, &even.map(|e| 1e3 * e)).0, Outcome::HeavyTailed);
        // Errors below the noise of the reference decide nothing.
        assert_eq!(by_error(&even, &even.map(|e| e - 0.2)).0, Outcome::Open);
        let first = questions().next().unwrap();
        assert_eq!(first.answer(&[row("s", "uni-nee-mis", &even, 100)]), None);
    }

    #[test]
    fn pace_counts_paths_and_nothing_else() {
        let (noisy, quiet) = ([0.2, 0.9, 0.3, 3.0], [0.1; 4]);
        assert_eq!(outcome("books-pairwise", (&noisy, 300), (&quiet, 100)), (Outcome::Better, 3.0));
        assert_eq!(outcome("books-pairwise", (&quiet, 50), (&noisy, 100)), (Outcome::Worse, 0.5));
        assert_eq!(outcome("books-pairwise", (&quiet, 100), (&noisy, 100)), (Outcome::Open, 1.0));
    }
}
