//! What a check has found.

use crate::film::NonFinite;
use crate::scene::Mode;
use serde::Serialize;
use std::fmt;

/// How one estimator fares on one case.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "verdict", rename_all = "kebab-case")]
pub enum Verdict {
    /// All comparisons are within what chance allows.
    Agrees,
    /// The image is too noisy to tell: a bias of a quarter could hide in it, or rare paths decide.
    Undecided,
    /// At least one is not.
    Differs {
        /// From whom: the answer, or the ids of other estimators.
        from: Vec<String>,
    },
    /// A sample was not a finite number.
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

/// One line of the table: scene × estimator.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The case.
    pub scene: String,
    /// The estimator's id.
    pub estimator: &'static str,
    /// Spectral or RGB.
    pub mode: Mode,
    /// Mean over the image and its channels.
    pub measured: f64,
    /// Its standard error.
    pub error: f64,
    /// What it should be; among estimators that can only be held against each other, the pooled mean of
    /// the others, by inverse variance.
    pub expected: f64,
    /// (measured − expected) / standard error of the difference.
    pub z: f64,
    /// The largest |z| of any block and channel, or against any other estimator.
    pub worst_z: f64,
    /// The |z| that chance exceeds anywhere in the whole run with probability [`super::stats::ALPHA`].
    pub critical_z: f64,
    /// Relative bias of the mean that would have been found with 95 % probability.
    pub detectable: f64,
    /// Paths traced.
    pub paths: u64,
    /// What comes of it.
    #[serde(flatten)]
    pub verdict: Verdict,
}

impl Row {
    /// Whether nothing is wrong.
    #[must_use]
    pub fn passes(&self) -> bool {
        matches!(self.verdict, Verdict::Agrees | Verdict::Undecided)
    }
}

/// The whole table.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Report {
    /// Scene by scene, estimators in the order of the registry.
    pub rows: Vec<Row>,
    /// What was left out, and why.
    pub notes: Vec<String>,
    /// Seconds that it took.
    pub seconds: f64,
}

impl Report {
    /// Whether nothing is wrong with any row.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.rows.iter().all(Row::passes)
    }

    /// How many rows agree, and of how many nothing can be said.
    #[must_use]
    pub fn agreeing_and_undecided(&self) -> (usize, usize) {
        let count = |v: &Verdict| self.rows.iter().filter(|row| row.verdict == *v).count();
        (count(&Verdict::Agrees), count(&Verdict::Undecided))
    }

    /// The rows that something is wrong with.
    pub fn failures(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| !row.passes())
    }
}
