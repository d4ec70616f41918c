//! File names inside a document: relative to its scene file when stored, absolute when rendered.

use majorant_core::scene::SceneDoc;
use std::path::{Path, PathBuf};

/// File names that depend on the location of the scene.
fn files(doc: &mut SceneDoc) -> Vec<&mut String> {
    let mut files = doc.files_mut();
    // Embedded files, as `embedded:plume.vdb`, have no location.
    files.retain(|file| !file.starts_with("embedded:"));
    files
}

/// Returns the document with absolute file names, for the session.
#[must_use]
pub fn resolved(doc: &SceneDoc, base: &Path) -> SceneDoc {
    let mut doc = doc.clone();
    for file in files(&mut doc) {
        *file = base.join(&*file).to_string_lossy().into_owned();
    }
    doc
}

/// Returns the document with file names relative to `from` converted to names relative to `to` where the
/// files are below it, and to absolute names elsewhere: a scene can be moved together with its volumes.
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
        doc.medium_mut().density = DensityDoc::Grid(GridRef { file: file.into(), grid: None });
        doc
    }

    fn volume(doc: &SceneDoc) -> &str {
        doc.medium().density.grid().map_or("", |grid| grid.file.as_str())
    }

    #[test]
    fn names_survive_a_move() {
        let (old, new) = (Path::new("/scenes"), Path::new("/scenes/smoke"));
        assert_eq!(volume(&resolved(&with_volume("smoke/a.vdb"), old)), "/scenes/smoke/a.vdb");
        assert_eq!(volume(&rebase(&with_volume("smoke/a.vdb"), old, new)), "a.vdb");
        assert_eq!(volume(&rebase(&with_volume("b.vdb"), old, new)), "/scenes/b.vdb");
    }

    #[test]
    fn embedded_volumes_are_unchanged() {
        let doc = with_volume("embedded:plume.vdb");
        assert_eq!(volume(&resolved(&doc, Path::new("/x"))), "embedded:plume.vdb");
        assert_eq!(volume(&rebase(&doc, Path::new("/x"), Path::new("/y"))), "embedded:plume.vdb");
    }
}
