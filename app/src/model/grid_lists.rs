//! Lists of the grids in volume files.

use std::collections::BTreeMap;

/// Names of the grids in files, by the name that the document has for the file.
#[derive(Clone, Debug, Default)]
pub struct GridLists(BTreeMap<String, Option<Vec<String>>>);

impl GridLists {
    /// Whether the file was listed or is being listed.
    #[must_use]
    pub fn is_listed(&self, file: &str) -> bool {
        self.0.contains_key(file)
    }

    /// The names, once they are known.
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
