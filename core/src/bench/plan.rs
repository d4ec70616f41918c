//! What is run.

use crate::compare::Reference;
use crate::estimator::Entry;
use crate::io::Library;
use crate::scene::{Bookkeeping, EstimatorDoc, SceneDoc};
use crate::session::Budget;

/// A scene to be run.
#[derive(Clone, Debug)]
pub struct Subject {
    /// How it is called.
    pub name: String,
    /// The scene.
    pub doc: SceneDoc,
    /// Finds its files.
    pub library: Library,
    /// What is run on it, in order; ratios are relative to the first.
    pub entrants: Vec<Candidate>,
    /// What errors are measured against.
    pub reference: ReferencePlan,
}

/// An estimator with its settings.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// How its row is called.
    pub name: String,
    /// The estimator.
    pub entry: &'static Entry,
    /// Its settings, in place of the scene's.
    pub settings: EstimatorDoc,
    /// Whether the bias of its bookkeeping is what is measured: it takes part all the same.
    pub own_bias: bool,
}

impl Candidate {
    /// An estimator with a scene's own settings.
    #[must_use]
    pub fn of(entry: &'static Entry, doc: &SceneDoc) -> Self {
        Self { name: entry.id.to_owned(), entry, settings: doc.estimator.clone(), own_bias: false }
    }

    /// Why its estimate of a scene is biased, if it is by anything but what it is there to measure.
    #[must_use]
    pub fn bias(&self, doc: &SceneDoc) -> Option<&'static str> {
        let mut doc = SceneDoc { estimator: self.settings.clone(), ..doc.clone() };
        if self.own_bias {
            doc.estimator.bookkeeping = Bookkeeping::default();
        }
        self.entry.bias(&doc)
    }
}

/// Where a scene's reference comes from.
#[derive(Clone, Debug)]
pub enum ReferencePlan {
    /// A picture that is there already.
    Given(Box<Reference>),
    /// A run of its own before the others, with independent random numbers that no trial has.
    Own {
        /// The estimator.
        estimator: &'static Entry,
        /// Wall-clock seconds.
        seconds: f64,
    },
}

/// Scenes with their entrants, and how long and how often each is run.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Scenes, in order.
    pub subjects: Vec<Subject>,
    /// Of every trial.
    pub budget: Budget,
    /// Trials of every entrant on its scene, at least 2.
    pub repeats: u32,
    /// Worker threads; one per core if absent.
    pub threads: Option<usize>,
}
