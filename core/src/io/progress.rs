//! How far the reading of a file is, for whoever waits for it.

use std::sync::{Arc, Mutex, PoisonError};

/// A file that is being read.
#[derive(Clone, Debug, PartialEq)]
pub struct Loading {
    /// Its name as the scene has it.
    pub file: String,
    /// The share that is done, from 0 to 1; it never falls.
    pub fraction: f64,
}

/// A place where readers leave how far they are. Clones are the same place.
#[derive(Clone, Debug, Default)]
pub struct Progress(Arc<Mutex<Option<Loading>>>);

impl Progress {
    /// What is being read, if anything is.
    #[must_use]
    pub fn loading(&self) -> Option<Loading> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// A file is opened.
    pub(super) fn begin(&self, file: &str) {
        self.set(Some(Loading { file: file.to_owned(), fraction: 0.0 }));
    }

    /// A share of it is done; less than was done before is no news.
    pub(super) fn at(&self, fraction: f64) {
        if let Some(loading) = self.0.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
            loading.fraction = loading.fraction.max(fraction.clamp(0.0, 1.0));
        }
    }

    /// It is read, or cannot be.
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
