//! Lists of the grids of volume files.

use std::collections::BTreeMap;

/// Names of the grids of files, by the file's name in the document; `None` while a list is being read.
#[derive(Clone, Debug, Default)]
pub struct GridLists(BTreeMap<String, Option<Vec<String>>>);

impl GridLists {
    /// Whether the file was listed, or is being listed.
    #[must_use]
    pub fn is_listed(&self, file: &str) -> bool {
        self.0.contains_key(file)
    }

    /// Names of the grids, once they are known and not empty.
    #[must_use]
    pub fn names(&self, file: &str) -> Option<&[String]> {
        self.0.get(file)?.as_deref().filter(|names| !names.is_empty())
    }

    pub(crate) fn begin(&mut self, file: &str) {
        self.0.insert(file.to_owned(), None);
    }

    pub(crate) fn finish(&mut self, file: String, names: Vec<String>) {
        self.0.insert(file, Some(names));
    }

    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }
}
