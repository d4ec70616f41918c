//! Figures and studies completed so far.

use super::Figure;
use super::render::Rendered;
use super::study::{self, SceneStudy};
use std::path::PathBuf;

/// Results so far.
#[derive(Clone, Debug, Default)]
pub struct Results {
    /// Completed figures with their rows.
    pub figures: Vec<(&'static Figure, Vec<Rendered>)>,
    /// Completed scenes of the study.
    pub studies: Vec<SceneStudy>,
    /// Seconds from the start.
    pub seconds: f64,
    /// Files that were written, without duplicates.
    pub files: Vec<PathBuf>,
}

impl Results {
    /// Rows of all figures.
    pub fn rows(&self) -> impl Iterator<Item = &Rendered> {
        self.figures.iter().flat_map(|(_, rows)| rows)
    }

    /// Conclusions of the study, derived from its numbers.
    #[must_use]
    pub fn conclusion(&self) -> Vec<String> {
        study::conclusion(&self.studies)
    }

    /// Notices, one sentence each.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        let mut notes: Vec<String> = Vec::new();
        for rendered in self.rows() {
            for note in &rendered.notes {
                let note = format!("{}: {note}", rendered.strip.name);
                if !notes.contains(&note) {
                    notes.push(note);
                }
            }
        }
        notes
    }
}
