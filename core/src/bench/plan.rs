//! What is run.

use crate::compare::Reference;
use crate::estimator::Entry;
use crate::io::Library;
use crate::scene::SceneDoc;
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
    /// What errors are measured against.
    pub reference: ReferencePlan,
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

/// Scenes, estimators, and how long and how often each is run.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Scenes, in order.
    pub subjects: Vec<Subject>,
    /// Estimators, in order; ratios are relative to the first.
    pub estimators: Vec<&'static Entry>,
    /// Of every trial.
    pub budget: Budget,
    /// Trials of every estimator on every scene, at least 2.
    pub repeats: u32,
    /// Worker threads; one per core if absent.
    pub threads: Option<usize>,
}
