//! All answers as one table: a line per question, a column per scene.

use super::{Outcome, SceneStudy, TOPICS, name};
use serde::Serialize;

/// The answers of a study, in words.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Matrix {
    /// The scenes: what stands above the columns.
    pub scenes: Vec<&'static str>,
    /// A block per topic, with its heading.
    pub blocks: Vec<(&'static str, Vec<Line>)>,
}

/// A question with its answers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Line {
    /// The variant that it is about.
    pub variant: &'static str,
    /// What it is held against.
    pub against: &'static str,
    /// What they are compared by.
    pub by: &'static str,
    /// A ratio with its interval and what that means, per scene; none where one of the two did not run.
    pub cells: Vec<Option<(String, Outcome)>>,
}

impl Matrix {
    /// The table of a study.
    #[must_use]
    pub fn of(studies: &[SceneStudy]) -> Self {
        let block = |topic: &'static super::Topic| {
            let lines = topic.questions.iter().map(|question| Line {
                variant: name(question.variant),
                against: name(question.against),
                by: question.yardstick.unit(),
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
