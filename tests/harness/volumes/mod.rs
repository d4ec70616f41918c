//! Volume files for the tests, and their ground truth.

use std::path::{Path, PathBuf};

pub mod mutate;
pub mod truth;
pub mod write;

/// Folder of external test volumes, if `MAJORANT_VOLUMES` is set.
pub fn volumes() -> Option<PathBuf> {
    let folder = std::env::var_os("MAJORANT_VOLUMES").map(PathBuf::from);
    if folder.is_none() {
        println!("skipped: MAJORANT_VOLUMES is not set");
    }
    folder
}

/// Folder of the volumes that are part of the project.
pub fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("volumes")
}

/// Path of a file of the ground truth, in the folder or in its subfolder of generated files.
pub fn find(folder: &Path, name: &str) -> Option<PathBuf> {
    [folder.join(name), folder.join("corpus").join(name)].into_iter().find(|path| path.is_file())
}

/// Files of a folder, sorted.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.is_file());
    paths.sort();
    paths
}
