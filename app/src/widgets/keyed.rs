//! Rows of the table of keys, as panels name them.

use majorant_core::scene::keys::{self, Affects, Default, Key, Type};

/// A row that says nothing: for a path that there is none for, which a test rules out.
static BLANK: Key = Key {
    path: "",
    kinds: &[],
    value: Type::Text,
    unit: "",
    default: Default::Required,
    label: "",
    tip: "",
    affects: Affects::View,
    biases: None,
    cure: "",
};

/// The row of a key.
#[must_use]
pub fn key(path: &str) -> &'static Key {
    keys::find(path, None).unwrap_or(&BLANK)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn sources(folder: &Path, found: &mut Vec<String>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                sources(&path, found);
            } else {
                found.push(format!("{}\n{}", path.display(), std::fs::read_to_string(&path).unwrap()));
            }
        }
    }

    /// Panels name keys that exist, and have no ranges of their own.
    #[test]
    fn panels_take_their_ranges_from_the_table() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let mut files = Vec::new();
        for folder in ["panels", "wall"] {
            sources(&root.join(folder), &mut files);
        }
        let mut named = 0;
        for text in files {
            let file = text.lines().next().unwrap_or_default();
            for path in text.split("key(\"").skip(1).filter_map(|rest| rest.split('"').next()) {
                assert!(keys::find(path, None).is_some(), "{file}: {path}");
                named += 1;
            }
            // The bench of the dock has numbers of its own, which no scene holds.
            if file.contains("/panels/") {
                for own in [".range(", "Value::new(", "DragValue::new(", "optional(ui"] {
                    assert!(!text.contains(own), "{file}: {own}");
                }
            }
        }
        assert!(named > 40, "{named}");
    }
}
