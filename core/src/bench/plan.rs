//! Description of a benchmark: scenes, candidates, references and budget.

use crate::compare::Reference;
use crate::estimator::Entry;
use crate::io::Library;
use crate::scene::{Bookkeeping, EstimatorDoc, SceneDoc};
use crate::session::Budget;

/// A scene with the candidates that are run on it.
#[derive(Clone, Debug)]
pub struct Subject {
    /// Display name.
    pub name: String,
    /// The scene.
    pub doc: SceneDoc,
    /// Library that locates the files of the scene.
    pub library: Library,
    /// Candidates in order; ratios are relative to the first.
    pub candidates: Vec<Candidate>,
    /// Reference from which errors are measured.
    pub reference: ReferencePlan,
}

/// An estimator with its settings.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Name of its row.
    pub name: String,
    /// The estimator.
    pub entry: &'static Entry,
    /// Settings that replace those of the scene.
    pub settings: EstimatorDoc,
    /// Whether the bias of its bookkeeping is the quantity under test; if so, it does not exclude the
    /// candidate.
    pub own_bias: bool,
}

impl Candidate {
    /// An estimator with the settings of a scene.
    #[must_use]
    pub fn of(entry: &'static Entry, doc: &SceneDoc) -> Self {
        Self { name: entry.id.to_owned(), entry, settings: doc.estimator.clone(), own_bias: false }
    }

    /// Reason why the estimate of a scene is biased, if it is. The bias under test (`own_bias`) is ignored.
    #[must_use]
    pub fn bias(&self, doc: &SceneDoc) -> Option<&'static str> {
        let mut doc = SceneDoc { estimator: self.settings.clone(), ..doc.clone() };
        if self.own_bias {
            doc.estimator.bookkeeping = Bookkeeping::default();
        }
        self.entry.bias(&doc)
    }
}

/// Source of the reference image of a scene.
#[derive(Clone, Debug)]
pub enum ReferencePlan {
    /// An existing image.
    Given(Box<Reference>),
    /// A separate run before the trials, with random numbers that no trial uses.
    Own {
        /// The estimator.
        estimator: &'static Entry,
        /// Wall-clock seconds.
        seconds: f64,
    },
}

/// Scenes with their candidates, the budget and the number of repeats.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Scenes, in order.
    pub subjects: Vec<Subject>,
    /// Budget of every trial.
    pub budget: Budget,
    /// Trials of every candidate on its scene, at least 2.
    pub repeats: u32,
    /// Worker threads; `None` for one per core.
    pub threads: Option<usize>,
}
