//! One path, replayed while somebody takes notes.

use crate::estimator::{Kernel, PathEstimate, PathIndex, Settings};
use crate::scene::Scene;
use crate::transport::{Company, Note, Observer, Wanted};

/// Every step of one path.
#[derive(Clone, Debug)]
pub struct Recording {
    /// Which path.
    pub at: PathIndex,
    /// What it was traced with.
    pub settings: Settings,
    /// Its steps, from the camera to its end.
    pub notes: Vec<Note>,
    /// Its estimate, as the film has received it.
    pub estimate: PathEstimate,
}

struct Notes(Vec<Note>);

impl Observer for Notes {
    fn note(&mut self, note: &Note) {
        self.0.push(*note);
    }
}

impl Recording {
    /// Replays a path with the random numbers that it has; meaningless if it is not wanted any more.
    #[must_use]
    pub fn new(
        scene: &Scene,
        kernel: Kernel,
        settings: &Settings,
        at: PathIndex,
        wanted: Wanted<'_>,
    ) -> Self {
        let mut notes = Notes(Vec::new());
        let estimate = kernel(scene, settings, at, Company::observed(wanted, &mut notes));
        Self { at, settings: *settings, notes: notes.0, estimate }
    }
}
