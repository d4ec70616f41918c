//! The study that the report leaves to future work: estimators and path-weight bookkeeping at equal time,
//! with confidence intervals.
//!
//! ```text
//!   VARIANTS (an estimator and settings) ──► bench (turns, repeats) ──► Row each ──► TOPICS ──► Answer each
//! ```
//!
//! Every variant runs on the scene of the figure with the settings of the scene, several times for the same
//! wall-clock time, and is measured against the reference of the figure. Answers are ratios of efficiency,
//! 1/(relMSE · CPU seconds), or of paths per CPU second, with 95 % intervals from the scatter of the repeats.

mod answer;
mod conclusion;
mod matrix;
mod question;
mod variant;

pub use answer::{Answer, Outcome};
pub use conclusion::conclusion;
pub use matrix::{Line, Matrix};
pub use question::{Criterion, Question, TOPICS, Topic, questions};
pub use variant::{VARIANTS, Variant, name};

use super::render::Rendered;
use super::{FiguresError, Options, StudyOptions};
use crate::bench::{self, Plan, Progress, ReferencePlan, Row, Subject};
use crate::io::Library;
use crate::session::Budget;
use serde::Serialize;

/// Results on one scene.
#[derive(Clone, Debug, Serialize)]
pub struct SceneStudy {
    /// Row of the figure.
    pub scene: &'static str,
    /// Description of the scene in a few words.
    pub about: &'static str,
    /// Results of every variant.
    pub rows: Vec<Row>,
    /// Variants that did not run.
    pub left_out: Vec<LeftOut>,
    /// Answers to the questions.
    pub answers: Vec<Answer>,
}

/// A variant that did not run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    /// Id of the variant.
    pub variant: &'static str,
    /// Reason.
    pub reason: String,
}

/// Runs every variant on the scene of a row of a figure.
///
/// # Errors
/// When the scene cannot be built, or threads cannot be started.
pub fn run(
    rendered: &Rendered,
    study: StudyOptions,
    options: &Options,
    progress: impl FnMut(&Progress),
) -> Result<SceneStudy, FiguresError> {
    let (mut candidates, mut left_out) = (Vec::new(), Vec::new());
    for variant in VARIANTS {
        match variant.candidate(&rendered.scene) {
            Ok(candidate) => candidates.push(candidate),
            Err(reason) => left_out.push(LeftOut { variant: variant.id, reason }),
        }
    }
    let plan = Plan {
        subjects: vec![Subject {
            name: rendered.strip.name.to_owned(),
            doc: rendered.scene.clone(),
            library: Library::default(),
            candidates,
            reference: ReferencePlan::Given(Box::new(rendered.compared_with())),
        }],
        budget: Budget::Seconds(study.seconds),
        repeats: study.repeats,
        threads: options.threads,
    };
    let rows = bench::run(&plan, progress)?;
    let answers = questions().filter_map(|question| question.answer(&rows)).collect();
    Ok(SceneStudy { scene: rendered.strip.name, about: rendered.strip.about, rows, left_out, answers })
}

impl SceneStudy {
    /// Answer to a question.
    #[must_use]
    pub fn answer(&self, question: &Question) -> Option<&Answer> {
        self.answers.iter().find(|answer| answer.question == question.id)
    }
}
