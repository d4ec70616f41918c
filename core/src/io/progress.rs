//! Progress of file reading, shared between threads.

use std::sync::{Arc, Mutex, PoisonError};

/// A file that is being read.
#[derive(Clone, Debug, PartialEq)]
pub struct Loading {
    /// Name in the scene.
    pub file: String,
    /// Completed fraction, from 0 to 1; never decreases.
    pub fraction: f64,
}

/// Shared progress of a reader. Clones refer to the same state.
#[derive(Clone, Debug, Default)]
pub struct Progress(Arc<Mutex<Option<Loading>>>);

impl Progress {
    /// File that is being read, if any.
    #[must_use]
    pub fn loading(&self) -> Option<Loading> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Records that a file was opened.
    pub(super) fn begin(&self, file: &str) {
        self.set(Some(Loading { file: file.to_owned(), fraction: 0.0 }));
    }

    /// Records the completed fraction; a smaller value is ignored.
    pub(super) fn at(&self, fraction: f64) {
        if let Some(loading) = self.0.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
            loading.fraction = loading.fraction.max(fraction.clamp(0.0, 1.0));
        }
    }

    /// Records that reading has succeeded or failed.
    pub(super) fn end(&self) {
        self.set(None);
    }

    fn set(&self, loading: Option<Loading>) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = loading;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_never_falls_and_belongs_to_a_file() {
        let progress = Progress::default();
        progress.at(0.5);
        assert_eq!(progress.loading(), None);
        progress.begin("cloud.vdb");
        for (told, seen) in [(0.3, 0.3), (0.2, 0.3), (7.0, 1.0)] {
            progress.clone().at(told);
            assert_eq!(progress.loading(), Some(Loading { file: "cloud.vdb".into(), fraction: seen }));
        }
        progress.end();
        assert_eq!(progress.loading(), None);
    }
}
