//! Results of a check.

use crate::film::NonFinite;
use crate::scene::Mode;
use serde::Serialize;
use std::fmt;

/// Result of one estimator on one case.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "verdict", rename_all = "kebab-case")]
pub enum Verdict {
    /// All differences are within statistical error.
    Agrees,
    /// The image is too noisy for a verdict: a bias of a quarter could be hidden, or rare paths dominate.
    Undecided,
    /// At least one difference is significant.
    Differs {
        /// Expected answer, or ids of other estimators, from which it differs.
        from: Vec<String>,
    },
    /// A sample was not finite.
    NotFinite {
        /// Column.
        x: u32,
        /// Row from the top.
        y: u32,
        /// Sample number within the pixel.
        sample: u64,
    },
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Agrees => f.write_str("agrees"),
            Self::Undecided => f.write_str("too noisy to tell"),
            Self::Differs { from } => write!(f, "differs from {}", from.join(", ")),
            Self::NotFinite { x, y, sample } => write!(f, "not finite in pixel ({x}, {y}), sample {sample}"),
        }
    }
}

impl From<NonFinite> for Verdict {
    fn from(at: NonFinite) -> Self {
        Self::NotFinite { x: at.x, y: at.y, sample: at.sample }
    }
}

/// One line of the table: a scene and an estimator.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Name of the case.
    pub scene: String,
    /// Estimator id.
    pub estimator: &'static str,
    /// Spectral or RGB mode.
    pub mode: Mode,
    /// Mean over the image and its channels.
    pub measured: f64,
    /// Standard error of `measured`.
    pub error: f64,
    /// Expected mean; without a known answer, the mean of the other estimators, weighted by inverse variance.
    pub expected: f64,
    /// (measured − expected) / standard error of the difference.
    pub z: f64,
    /// Largest |z| of any block and channel, or against any other estimator.
    pub worst_z: f64,
    /// The |z| that is exceeded by chance anywhere in the whole run with probability [`super::stats::ALPHA`].
    pub critical_z: f64,
    /// Relative bias of the mean that would have been detected with 95 % probability.
    pub detectable: f64,
    /// Paths traced.
    pub paths: u64,
    /// Verdict.
    #[serde(flatten)]
    pub verdict: Verdict,
}

impl Row {
    /// Whether no difference was found.
    #[must_use]
    pub fn passes(&self) -> bool {
        matches!(self.verdict, Verdict::Agrees | Verdict::Undecided)
    }
}

/// The complete table.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Report {
    /// Rows by scene, with estimators in the order of the registry.
    pub rows: Vec<Row>,
    /// Skipped cases with the reason.
    pub notes: Vec<String>,
    /// Duration in seconds.
    pub seconds: f64,
}

impl Report {
    /// Whether no row fails.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.rows.iter().all(Row::passes)
    }

    /// Number of rows that agree, and number that are undecided.
    #[must_use]
    pub fn agreeing_and_undecided(&self) -> (usize, usize) {
        let count = |v: &Verdict| self.rows.iter().filter(|row| row.verdict == *v).count();
        (count(&Verdict::Agrees), count(&Verdict::Undecided))
    }

    /// Rows that fail.
    pub fn failures(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| !row.passes())
    }
}
