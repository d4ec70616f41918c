//! A scene with its answer, and families of them.

use super::{Answer, CheckError, Layout};
use crate::estimator::{Entry, REGISTRY};
use crate::io::{Library, scene_file};
use crate::scene::{Mode, Scene, SceneDoc, build};

/// A scene with a derived answer.
#[derive(Clone, Debug)]
pub struct Case {
    /// Stable name, `family/what`.
    pub name: String,
    /// The scene; its estimator's id is replaced in turn by every id of the registry.
    pub doc: SceneDoc,
    /// Blocks in which the image is compared.
    pub layout: Layout,
    /// What the image should be.
    pub answer: Answer,
    /// Where the scene's files come from.
    pub library: Library,
    /// The estimators to choose from.
    pub registry: &'static [Entry],
    /// The most paths of one estimator, where some are too inefficient for the power that is wished for.
    pub budget: Option<u64>,
}

impl Case {
    /// A case in one block whose scene needs no files but embedded ones.
    ///
    /// # Errors
    /// When the scene file is not one.
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

    /// The same with other blocks.
    #[must_use]
    pub fn in_blocks(mut self, columns: u32, rows: u32) -> Self {
        self.layout = Layout { columns, rows };
        self
    }

    /// The same with files from here.
    #[must_use]
    pub fn with_files(mut self, library: Library) -> Self {
        self.library = library;
        self
    }

    /// The same with this answer.
    #[must_use]
    pub fn answered(mut self, answer: Answer) -> Self {
        self.answer = answer;
        self
    }

    /// The same for some of the estimators only.
    #[must_use]
    pub fn among(mut self, registry: &'static [Entry]) -> Self {
        self.registry = registry;
        self
    }

    /// The same after an edit, under another name.
    #[must_use]
    pub fn varied(&self, name: impl Into<String>, edit: impl FnOnce(&mut SceneDoc)) -> Self {
        let mut varied = Self { name: name.into(), ..self.clone() };
        edit(&mut varied.doc);
        varied
    }

    /// Spectral or RGB.
    #[must_use]
    pub fn mode(&self) -> Mode {
        self.doc.estimator.mode
    }

    /// The estimators that are unbiased for it.
    #[must_use]
    pub fn estimators(&self) -> Vec<&'static Entry> {
        let can_be_judged =
            |e: &&Entry| e.bias(&self.doc).is_none() && (e.infinite_variance)(&self.doc).is_none();
        self.registry.iter().filter(can_be_judged).collect()
    }

    /// Comparisons that it amounts to over all its estimators.
    #[must_use]
    pub fn comparisons(&self) -> usize {
        let n = self.estimators().len();
        match self.answer {
            Answer::Known(_) => n * self.layout.comparisons(),
            // Every pair, and every one against all others together.
            Answer::Agreement => n * n.saturating_sub(1) / 2 * self.layout.comparisons() + n,
        }
    }

    /// The frozen scene.
    ///
    /// # Errors
    /// When the scene makes no sense or names files that cannot be used.
    pub fn scene(&self) -> Result<Scene, CheckError> {
        build(&self.doc, &mut self.library.clone())
            .map_err(|source| CheckError::Build { name: self.name.clone(), source })
    }
}

/// Cases that share a derivation.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// What the names of its cases begin with.
    pub id: &'static str,
    /// One sentence: what is known, and why.
    pub about: &'static str,
    /// Whether it is left to a thorough look, for its cost.
    pub deep_only: bool,
    /// Makes the cases; answers are evaluated here.
    pub cases: fn() -> Result<Vec<Case>, CheckError>,
}
