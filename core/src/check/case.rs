//! Validation cases and families of cases.

use super::{Answer, CheckError, Layout};
use crate::estimator::{Entry, REGISTRY};
use crate::io::{Library, scene_file};
use crate::scene::{Mode, Scene, SceneDoc, build};

/// A scene with its expected image.
#[derive(Clone, Debug)]
pub struct Case {
    /// Stable name, `family/what`.
    pub name: String,
    /// The scene; every estimator of `registry` is run on it in turn.
    pub doc: SceneDoc,
    /// Blocks in which the image is compared.
    pub layout: Layout,
    /// Expected image.
    pub answer: Answer,
    /// Source of the scene's files.
    pub library: Library,
    /// Candidate estimators.
    pub registry: &'static [Entry],
    /// Maximum number of paths per estimator, for cases where some are too inefficient for the requested
    /// power.
    pub budget: Option<u64>,
}

impl Case {
    /// Creates a case with one block and embedded files only.
    ///
    /// # Errors
    /// When the scene file cannot be parsed.
    pub fn new(name: impl Into<String>, toml: &str, answer: Answer) -> Result<Self, CheckError> {
        let name = name.into();
        let doc = scene_file::parse(toml, &name)?;
        Ok(Self {
            name,
            doc,
            layout: Layout::WHOLE,
            answer,
            library: Library::default(),
            registry: REGISTRY,
            budget: None,
        })
    }

    /// Replaces the division into blocks.
    #[must_use]
    pub fn in_blocks(mut self, columns: u32, rows: u32) -> Self {
        self.layout = Layout { columns, rows };
        self
    }

    /// Replaces the library that supplies files.
    #[must_use]
    pub fn with_files(mut self, library: Library) -> Self {
        self.library = library;
        self
    }

    /// Replaces the expected image.
    #[must_use]
    pub fn answered(mut self, answer: Answer) -> Self {
        self.answer = answer;
        self
    }

    /// Restricts the estimators.
    #[must_use]
    pub fn among(mut self, registry: &'static [Entry]) -> Self {
        self.registry = registry;
        self
    }

    /// Returns an edited copy under another name.
    #[must_use]
    pub fn varied(&self, name: impl Into<String>, edit: impl FnOnce(&mut SceneDoc)) -> Self {
        let mut varied = Self { name: name.into(), ..self.clone() };
        edit(&mut varied.doc);
        varied
    }

    /// Spectral or RGB mode of the scene.
    #[must_use]
    pub fn mode(&self) -> Mode {
        self.doc.estimator.mode
    }

    /// Estimators that are unbiased on this case and have finite variance.
    #[must_use]
    pub fn estimators(&self) -> Vec<&'static Entry> {
        let can_be_judged =
            |e: &&Entry| e.bias(&self.doc).is_none() && (e.infinite_variance)(&self.doc).is_none();
        self.registry.iter().filter(can_be_judged).collect()
    }

    /// Number of comparisons over all estimators.
    #[must_use]
    pub fn comparisons(&self) -> usize {
        let n = self.estimators().len();
        match self.answer {
            Answer::Known(_) => n * self.layout.comparisons(),
            // Every pair, and every estimator against the pooled others.
            Answer::Agreement => n * n.saturating_sub(1) / 2 * self.layout.comparisons() + n,
        }
    }

    /// Builds the scene.
    ///
    /// # Errors
    /// When the scene is invalid or names files that cannot be used.
    pub fn scene(&self) -> Result<Scene, CheckError> {
        build(&self.doc, &mut self.library.clone())
            .map_err(|source| CheckError::Build { name: self.name.clone(), source })
    }
}

/// Cases that share a derivation of the expected image.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Prefix of the names of its cases.
    pub id: &'static str,
    /// One sentence that states what is known, and why.
    pub about: &'static str,
    /// Whether it is part of deep checks only, because of its cost.
    pub deep_only: bool,
    /// Creates the cases and evaluates their expected images.
    pub cases: fn() -> Result<Vec<Case>, CheckError>,
}
