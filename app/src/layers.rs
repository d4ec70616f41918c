//! Test of the import order between the modules of this crate.

use std::path::{Path, PathBuf};

/// Modules from the lowest layer to the highest; modules on one line may use each other.
const LAYERS: &[&[&str]] = &[
    &["background", "theme"],
    &["model"],
    &["widgets"],
    &["view"],
    &["panels"],
    &["wall"],
    &["lessons"],
    &["screenshot"],
    &["lab"],
    &["cli"],
];

fn layer(name: &str) -> usize {
    LAYERS.iter().position(|l| l.contains(&name)).unwrap_or_else(|| panic!("no layer for `{name}`"))
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn imports_point_one_way() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    sources(&root, &mut files);
    assert!(files.len() > 100);
    for file in files {
        let relative = file.strip_prefix(&root).unwrap();
        let own = relative.iter().next().unwrap().to_str().unwrap().trim_end_matches(".rs");
        if ["lib", "main", "layers"].contains(&own) {
            continue;
        }
        let text = std::fs::read_to_string(&file).unwrap();
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        for line in code.lines().filter(|l| !l.trim_start().starts_with("//")) {
            for used in line.split("crate::").skip(1) {
                let name: String = used.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                assert!(layer(&name) <= layer(own), "{}: {own} must not use {name}", relative.display());
            }
        }
    }
}
