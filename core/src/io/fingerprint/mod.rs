//! Names of images and of samples, from the table of keys.
//!
//! The *target's* fingerprint names the image that unbiased estimates of a document converge to: it changes with what the
//! expected image depends on, and with nothing else. Keys at their default do not count, so that a new key renames no
//! image. The *samples'* fingerprint names the very samples: every key that they depend on, resolved, with the program's
//! version. Files count by their content in both.

mod legacy;

use super::{Library, scene_file};
use crate::scene::SceneDoc;
use crate::scene::keys::{Affects, Leaf, Type, leaves};
use sha2::{Digest, Sha256};
use std::io::Read;
use toml::Value;

/// Raised whenever the default or the meaning of a key changes that the expected image depends on: names from before
/// then stand for other images.
const RECIPE: u32 = 1;

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

/// Sixteen hexadecimal digits of SHA-256 of a file, read piece by piece.
///
/// # Errors
/// When the file cannot be read.
pub fn of_file(path: &std::path::Path) -> std::io::Result<String> {
    let mut file = std::fs::File::open(path)?;
    let (mut hash, mut piece) = (Sha256::new(), vec![0; 1 << 20]);
    loop {
        match file.read(&mut piece)? {
            0 => return Ok(digits(hash)),
            n => hash.update(&piece[..n]),
        }
    }
}

/// Hashes what the expected image depends on; `content` names what is in a file.
fn of_target(doc: &SceneDoc, content: impl FnMut(&str) -> String) -> String {
    let counts = |leaf: &Leaf| leaf.key().affects == Affects::Scene && !leaf.is_default();
    of_lines(&format!("target {RECIPE}"), doc, counts, content)
}

/// Hashes all that samples depend on.
fn of_samples(doc: &SceneDoc, content: impl FnMut(&str) -> String) -> String {
    let head = format!("samples {RECIPE} {}", env!("CARGO_PKG_VERSION"));
    of_lines(&head, doc, |leaf| matches!(leaf.key().affects, Affects::Scene | Affects::Estimate), content)
}

fn of_lines(
    head: &str,
    doc: &SceneDoc,
    counts: impl Fn(&Leaf) -> bool,
    mut content: impl FnMut(&str) -> String,
) -> String {
    // What no scene file can hold has no keys: it goes by its text.
    let Ok(leaves) = leaves(doc) else { return of_bytes(scene_file::to_toml(doc).as_bytes()) };
    let mut text = format!("{head}\n");
    // Other views are images of their own.
    for leaf in leaves.iter().filter(|leaf| !leaf.key().path.starts_with("compare.") && counts(leaf)) {
        let value = match (leaf.key().value, leaf.value.as_str()) {
            (Type::File, Some(file)) if !file.is_empty() => content(file),
            _ => canonical(&leaf.value),
        };
        text.push_str(&format!("{} = {value}\n", leaf.path));
    }
    of_bytes(text.as_bytes())
}

/// A value in one spelling, whatever writes files today.
fn canonical(value: &Value) -> String {
    match value {
        Value::Float(x) => format!("{:e}", *x as f32),
        Value::Array(entries) => {
            format!("[{}]", entries.iter().map(canonical).collect::<Vec<_>>().join(", "))
        }
        Value::Table(table) => {
            let entries = table.iter().map(|(key, value)| format!("{key} = {}", canonical(value)));
            format!("{{{}}}", entries.collect::<Vec<_>>().join(", "))
        }
        Value::String(text) => format!("{text:?}"),
        Value::Integer(n) => n.to_string(),
        Value::Boolean(on) => on.to_string(),
        Value::Datetime(time) => time.to_string(),
    }
}

impl Library {
    /// Names the image that a document's unbiased estimates converge to: two documents with the same name
    /// differ at most in how they are estimated.
    #[must_use]
    pub fn fingerprint(&mut self, doc: &SceneDoc) -> String {
        of_target(doc, |file| self.digest(file))
    }

    /// Names the samples of a document: with the same name, sample 17 of a pixel is the same path with the same value.
    #[must_use]
    pub fn sample_fingerprint(&mut self, doc: &SceneDoc) -> String {
        of_samples(doc, |file| self.digest(file))
    }

    /// Whether a name that a file holds stands for the image of a document: its fingerprint, or the name that
    /// version 0.1 gave it.
    #[must_use]
    pub fn is_named(&mut self, name: &str, doc: &SceneDoc) -> bool {
        name == self.fingerprint(doc)
            || legacy::of_scene(doc, |file| self.digest(file)).as_deref() == Some(name)
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
        assert_ne!(library.sample_fingerprint(&edited), library.sample_fingerprint(&with("a.vdb")));
        edited.medium.scale = 2.0;
        assert_ne!(library.fingerprint(&edited), library.fingerprint(&with("a.vdb")));
    }

    #[test]
    fn samples_depend_on_seed_and_estimator_and_not_on_limits() {
        let mut library = Library::default();
        let doc = SceneDoc::default();
        let mut same = |edit: fn(&mut SceneDoc)| {
            let mut edited = doc.clone();
            edit(&mut edited);
            library.sample_fingerprint(&edited) == library.sample_fingerprint(&doc)
        };
        assert!(same(|d| d.render.threads = Some(3)) && same(|d| d.render.spp = None));
        assert!(same(|d| d.view.exposure_ev = 2.0) && same(|d| d.title = "another".into()));
        assert!(!same(|d| d.render.seed = 1) && !same(|d| d.estimator.roulette_depth = None));
        assert!(!same(|d| d.medium.majorant.shared = true) && !same(|d| d.camera.fov_deg = 30.0));
    }

    #[test]
    fn a_file_is_hashed_piece_by_piece_to_the_same_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bytes");
        let bytes: Vec<u8> = (0..3_000_000u32).map(|i| (i % 251) as u8).collect();
        std::fs::write(&path, &bytes).unwrap();
        assert_eq!(of_file(&path).unwrap(), of_bytes(&bytes));
    }

    /// Images of the embedded scenes: the name of today, and that of version 0.1. Another name today is another recipe.
    #[test]
    fn embedded_scenes_keep_their_names() {
        let golden = concat!(env!("CARGO_MANIFEST_DIR"), "/src/io/fingerprint/golden.txt");
        let golden = std::fs::read_to_string(golden).unwrap();
        let mut library = Library::default();
        let named: Vec<String> = crate::io::embedded::SCENES
            .iter()
            .map(|scene| {
                let doc = scene_file::parse(scene.toml, scene.name).unwrap();
                let legacy = legacy::of_scene(&doc, |file| library.digest(file)).unwrap();
                let name = library.fingerprint(&doc);
                assert!(library.is_named(&name, &doc) && library.is_named(&legacy, &doc));
                assert!(!library.is_named(&of_bytes(b"another"), &doc));
                format!("{} {name} {legacy}", scene.name)
            })
            .collect();
        assert_eq!(named, golden.lines().collect::<Vec<_>>());
    }

    /// What counts as version 0.1 had it: a change of what did not count then leaves the name alone, any other changes it.
    #[test]
    fn the_legacy_name_depends_on_what_it_did() {
        let name = |edit: fn(&mut SceneDoc)| {
            let mut doc = SceneDoc::default();
            edit(&mut doc);
            legacy::of_scene(&doc, str::to_owned)
        };
        let plain = name(|_| ());
        assert!(plain.is_some());
        assert_eq!(name(|d| d.medium.majorant.factor = 0.5), plain);
        assert_eq!(
            name(|d| d.estimator = crate::scene::EstimatorDoc { id: "nee".into(), ..d.estimator.clone() }),
            plain
        );
        assert_eq!(name(|d| (d.title, d.render.seed, d.view.exposure_ev) = ("x".into(), 3, 2.0)), plain);
        assert_ne!(name(|d| d.medium.scale = 2.0), plain);
        assert_ne!(name(|d| d.estimator.max_depth = Some(2)), plain);
        assert_ne!(name(|d| d.lights.clear()), plain);
    }
}
