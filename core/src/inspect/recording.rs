//! Recording of one path, replayed with an observer.

use crate::estimator::{Kernel, PathEstimate, PathIndex, Settings};
use crate::scene::Scene;
use crate::transport::{CancelToken, Note, Observer, PathContext};

/// All steps of one path.
#[derive(Clone, Debug)]
pub struct Recording {
    /// Index of the path.
    pub at: PathIndex,
    /// Settings with which it was traced.
    pub settings: Settings,
    /// Steps from the camera to the end. For very long paths the first [`Self::MOST_NOTES`] steps, and the
    /// end.
    pub notes: Vec<Note>,
    /// Whether all steps are included.
    pub complete: bool,
    /// Estimate of the path, as added to the film.
    pub estimate: PathEstimate,
}

#[derive(Default)]
struct Notes {
    taken: Vec<Note>,
    left_out: bool,
}

impl Observer for Notes {
    fn note(&mut self, note: &Note) {
        // Deep in a dense medium a single path may have millions of collisions.
        if self.taken.len() < Recording::MOST_NOTES || matches!(note, Note::End { .. }) {
            self.taken.push(*note);
        } else {
            self.left_out = true;
        }
    }
}

impl Recording {
    /// Maximum number of recorded steps.
    pub const MOST_NOTES: usize = 50_000;

    /// Replays a path with its own random numbers. The result is meaningless after cancellation.
    #[must_use]
    pub fn new(
        scene: &Scene,
        kernel: Kernel,
        settings: &Settings,
        at: PathIndex,
        cancel: CancelToken<'_>,
    ) -> Self {
        let mut notes = Notes::default();
        let estimate = kernel(scene, settings, at, PathContext::observed(cancel, &mut notes));
        Self { at, settings: *settings, notes: notes.taken, complete: !notes.left_out, estimate }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimator::find;
    use crate::io::{Library, scene_file};
    use crate::scene::build;

    /// Hundreds of mean free paths of albedo 1 in every direction, with the camera in the middle.
    #[test]
    fn a_path_that_hardly_ends_is_cut_off_and_keeps_its_estimate() {
        let doc = scene_file::parse(
            "majorant = 1
            [camera]
            origin = [0.0, 0.0, 0.0]
            target = [0.0, 0.0, -1.0]
            [medium]
            extinction = 400.0
            albedo = 1.0
            [[lights]]
            kind = \"environment\"",
            "dense",
        );
        let doc = doc.unwrap();
        let scene = build(&doc, &mut Library::default()).unwrap();
        let settings = Settings::new(&doc.estimator, 1);
        let kernel = find("spectral-mis").unwrap().kernel;
        let at = PathIndex { x: 0, y: 0, sample: 0 };
        let recording = Recording::new(&scene, kernel, &settings, at, CancelToken::NEVER);
        assert!(!recording.complete && recording.notes.len() == Recording::MOST_NOTES + 1);
        assert!(
            matches!(recording.notes.last(), Some(Note::End { film, .. }) if *film == recording.estimate.rgb)
        );
    }
}
