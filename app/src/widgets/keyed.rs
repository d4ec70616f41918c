//! Look-up of scene keys by path.

use majorant_core::scene::keys::{self, Affects, Default, Key, Type};

/// Fallback for an unknown path; a test checks that no panel uses one.
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

/// Returns the key with a path.
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

    /// Panels use existing keys, and define no ranges themselves.
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
            // The *Ray* tab has parameters that are not scene keys.
            if file.contains("/panels/") {
                for own in [".range(", "Value::new(", "DragValue::new(", "optional(ui"] {
                    assert!(!text.contains(own), "{file}: {own}");
                }
            }
        }
        assert!(named > 40, "{named}");
    }
}
