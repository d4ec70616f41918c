//! File names inside a document: relative to its scene file when stored, absolute when rendered.

use majorant_core::scene::SceneDoc;
use std::path::{Path, PathBuf};

/// The names that depend on where a scene lies.
fn files(doc: &mut SceneDoc) -> Vec<&mut String> {
    let mut files = doc.files_mut();
    // `embedded:plume.vdb` is part of the program.
    files.retain(|file| !file.starts_with("embedded:"));
    files
}

/// The document with every file name absolute, as the session gets it.
#[must_use]
pub fn resolved(doc: &SceneDoc, base: &Path) -> SceneDoc {
    let mut doc = doc.clone();
    for file in files(&mut doc) {
        *file = base.join(&*file).to_string_lossy().into_owned();
    }
    doc
}

/// The document with names that were relative to `from` made relative to `to` where they lie below
/// it, and absolute elsewhere: a scene saved beside its volumes can be moved together with them.
#[must_use]
pub fn rebase(doc: &SceneDoc, from: &Path, to: &Path) -> SceneDoc {
    let mut doc = doc.clone();
    for file in files(&mut doc) {
        let absolute: PathBuf = from.join(&*file);
        let short = absolute.strip_prefix(to).map_or(absolute.as_path(), |below| below);
        *file = short.to_string_lossy().into_owned();
    }
    doc
}

#[cfg(test)]
mod tests {
    use super::*;
    use majorant_core::scene::{DensityDoc, GridRef};

    fn with_volume(file: &str) -> SceneDoc {
        let mut doc = SceneDoc::default();
        doc.medium.density = DensityDoc::Grid(GridRef { file: file.into(), grid: None });
        doc
    }

    fn volume(doc: &SceneDoc) -> &str {
        doc.medium.density.grid().map_or("", |grid| grid.file.as_str())
    }

    #[test]
    fn names_survive_a_move() {
        let (old, new) = (Path::new("/scenes"), Path::new("/scenes/smoke"));
        assert_eq!(volume(&resolved(&with_volume("smoke/a.vdb"), old)), "/scenes/smoke/a.vdb");
        assert_eq!(volume(&rebase(&with_volume("smoke/a.vdb"), old, new)), "a.vdb");
        assert_eq!(volume(&rebase(&with_volume("b.vdb"), old, new)), "/scenes/b.vdb");
    }

    #[test]
    fn embedded_volumes_are_left_alone() {
        let doc = with_volume("embedded:plume.vdb");
        assert_eq!(volume(&resolved(&doc, Path::new("/x"))), "embedded:plume.vdb");
        assert_eq!(volume(&rebase(&doc, Path::new("/x"), Path::new("/y"))), "embedded:plume.vdb");
    }
}
