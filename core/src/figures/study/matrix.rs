//! Table of all answers: a line per question, a column per scene.

use super::{Outcome, SceneStudy, TOPICS, name};
use serde::Serialize;

/// Answers of a study as text.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Matrix {
    /// Scenes, the column headings.
    pub scenes: Vec<&'static str>,
    /// A block per topic, with its heading.
    pub blocks: Vec<(&'static str, Vec<Line>)>,
}

/// Answers to one question.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Line {
    /// Variant under test.
    pub variant: &'static str,
    /// Variant that it is compared with.
    pub against: &'static str,
    /// Criterion of the comparison.
    pub by: &'static str,
    /// Ratio with its interval and outcome per scene; `None` where one of the two did not run.
    pub cells: Vec<Option<(String, Outcome)>>,
}

impl Matrix {
    /// Creates the table of a study.
    #[must_use]
    pub fn of(studies: &[SceneStudy]) -> Self {
        let block = |topic: &'static super::Topic| {
            let lines = topic.questions.iter().map(|question| Line {
                variant: name(question.variant),
                against: name(question.against),
                by: question.criterion.unit(),
                cells: studies
                    .iter()
                    .map(|study| study.answer(question).map(|a| (a.ratio.as_ratio(), a.outcome)))
                    .collect(),
            });
            (topic.heading, lines.collect())
        };
        Self {
            scenes: studies.iter().map(|study| study.scene).collect(),
            blocks: TOPICS.iter().map(block).collect(),
        }
    }
}
