//! Names the image that a scene's unbiased estimates converge to.

use super::{Library, scene_file};
use crate::scene::SceneDoc;
use sha2::{Digest, Sha256};

/// Sixteen hexadecimal digits of SHA-256.
fn digits(hash: Sha256) -> String {
    hash.finalize().iter().take(8).map(|byte| format!("{byte:02x}")).collect()
}

/// Sixteen hexadecimal digits of SHA-256 of some bytes.
#[must_use]
pub fn of_bytes(bytes: &[u8]) -> String {
    let mut hash = Sha256::new();
    hash.update(bytes);
    digits(hash)
}

/// Hashes what the expected image depends on: the scene without estimator, majorant, seed and limits, but
/// with mode and depth; files count by their content, not by their names.
pub(super) fn of_scene(doc: &SceneDoc, mut content: impl FnMut(&str) -> String) -> String {
    let mut part = doc.target_part();
    for file in part.files_mut() {
        *file = content(file);
    }
    of_bytes(scene_file::to_toml(&part).as_bytes())
}

impl Library {
    /// Names the image that a document's unbiased estimates converge to: two documents with the same name
    /// differ at most in how they are estimated.
    #[must_use]
    pub fn fingerprint(&mut self, doc: &SceneDoc) -> String {
        of_scene(doc, |file| self.digest(file))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{DensityDoc, GridRef};

    #[test]
    fn content_counts_and_names_do_not() {
        let with = |file: &str| {
            let mut doc = SceneDoc::default();
            doc.medium.density = DensityDoc::Grid(GridRef { file: file.into(), grid: None });
            doc
        };
        let mut library = Library::default().with_volume("a.vdb", *b"cloud").with_volume("b.vdb", *b"cloud");
        library = library.with_volume("c.vdb", *b"smoke");
        let mut name = |file: &str| library.fingerprint(&with(file));
        assert_eq!(name("a.vdb"), name("b.vdb"));
        assert_ne!(name("a.vdb"), name("c.vdb"));
        assert_eq!(name("a.vdb").len(), 16);
        // Nothing that estimates it counts.
        let mut edited = with("a.vdb");
        edited.estimator.id = "nee".into();
        edited.render.seed = 9;
        edited.medium.majorant.factor = 2.0;
        assert_eq!(library.fingerprint(&edited), library.fingerprint(&with("a.vdb")));
        edited.medium.scale = 2.0;
        assert_ne!(library.fingerprint(&edited), library.fingerprint(&with("a.vdb")));
    }
}
