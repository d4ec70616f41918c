//! Imports between the modules of a package point one way.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may panic")]

use std::path::{Path, PathBuf};

type Layers = &'static [&'static [&'static str]];

/// Modules of the core from the lowest layer to the highest; those of one line may use each other.
const CORE: Layers = &[
    &["math"],
    &["spectrum"],
    &["phase", "material", "film"],
    &["surface"],
    &["medium", "light"],
    &["transmittance"],
    &["scene", "measure"],
    &["transport"],
    &["estimator"],
    &["inspect"],
    &["io"],
    &["session", "check"],
    &["compare"],
    &["bench"],
    &["figures"],
];

/// Modules of the window, likewise.
const APP: Layers = &[
    &["background", "background_query", "theme"],
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

/// Checks every import of the package's own modules. Tests and comments may refer to any module.
fn check(package: &str, layers: Layers) {
    let layer = |module: &str| {
        layers.iter().position(|l| l.contains(&module)).unwrap_or_else(|| panic!("no layer for `{module}`"))
    };
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(package).join("src");
    let mut files = Vec::new();
    sources(&root, &mut files);
    assert!(files.len() > 50, "{}", files.len());
    for file in files {
        let relative = file.strip_prefix(&root).unwrap();
        let own = relative.iter().next().unwrap().to_str().unwrap().trim_end_matches(".rs");
        let is_test = file.file_name().is_some_and(|name| name.to_string_lossy().ends_with("tests.rs"));
        if ["lib", "main"].contains(&own) || is_test {
            continue;
        }
        let text = std::fs::read_to_string(&file).unwrap();
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        for line in code.lines().filter(|l| !l.trim_start().starts_with("//")) {
            for used in line.split("crate::").skip(1) {
                let name: String = used.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                assert!(
                    layer(&name) <= layer(own),
                    "{}: {own} must not use {name}: {line}",
                    relative.display()
                );
            }
        }
    }
}

#[test]
fn imports_of_the_core_point_one_way() {
    check("core", CORE);
}

#[test]
fn imports_of_the_window_point_one_way() {
    check("app", APP);
}
