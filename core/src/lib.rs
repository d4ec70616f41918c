//! Monte Carlo light transport in participating media, on the null-scattering path integral.
//!
//! ```text
//!   math ─► spectrum ─► medium, phase, surface, light ─► scene ─► transport ─► estimator
//!   medium ─► transmittance (of a ray) ─► transport
//!   scene ─► io (scenes, volumes, images, results) ─► session
//!   estimator ─► inspect (analysis of paths) ─► session ─► compare ─► bench ─► figures
//!   film ─► measure (errors of an image against a reference) ─► compare
//! ```
//!
//! A [`scene::SceneDoc`] is the editable document; [`scene::build`] freezes it into a [`scene::Scene`]; a
//! [`session::Session`] renders views of it in the background and publishes [`film::Snapshot`]s. Modules
//! follow concepts: one estimator, medium, phase function or light per file. Imports follow the arrows only.
//! The crate does not depend on the window.

pub mod bench;
pub mod check;
pub mod compare;
pub mod estimator;
pub mod figures;
pub mod film;
pub mod inspect;
pub mod io;
pub mod light;
pub mod math;
pub mod measure;
pub mod medium;
pub mod phase;
pub mod scene;
pub mod session;
pub mod spectrum;
pub mod surface;
pub mod transmittance;
pub mod transport;

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    /// Modules from the lowest to the highest layer; modules of one layer may use each other.
    const LAYERS: &[&[&str]] = &[
        &["math"],
        &["spectrum"],
        &["phase", "surface", "film"],
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

    fn layer(module: &str) -> usize {
        LAYERS.iter().position(|l| l.contains(&module)).unwrap_or_else(|| panic!("no layer for `{module}`"))
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
        assert!(files.len() > 50);
        for file in files {
            let relative = file.strip_prefix(&root).unwrap();
            let module = relative.iter().next().unwrap().to_str().unwrap();
            if module == "lib.rs"
                || file.file_name().is_some_and(|name| name.to_string_lossy().ends_with("tests.rs"))
            {
                continue;
            }
            // Tests and comments may refer to any module.
            let text = std::fs::read_to_string(&file).unwrap();
            let code = text.split("#[cfg(test)]").next().unwrap_or_default();
            for line in code.lines().filter(|l| !l.trim_start().starts_with("//")) {
                for used in line.split("crate::").skip(1) {
                    let name: String =
                        used.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                    assert!(
                        layer(&name) <= layer(module),
                        "{}: {module} must not use {name}: {line}",
                        relative.display()
                    );
                }
            }
        }
    }
}
