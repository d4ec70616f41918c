//! Fingerprints of images and of samples, derived from the table of keys.
//!
//! The fingerprint of the *target* identifies the image to which unbiased estimates of a document converge:
//! it changes only with keys that affect the expected image. Keys at their default are not hashed, so that a
//! new key does not change existing fingerprints. The fingerprint of the *samples* identifies the individual
//! samples: all keys that affect them, resolved, with the version of the program. Files are hashed by content
//! in both.

mod legacy;

use super::{Library, scene_file};
use crate::scene::SceneDoc;
use crate::scene::keys::{Affects, Leaf, Type, leaves};
use sha2::{Digest, Sha256};
use std::io::Read;
use toml::Value;

/// Version of the fingerprint. Incremented whenever the default or the meaning of a key that affects the
/// expected image changes: older fingerprints then identify other images.
const RECIPE: u32 = 1;

/// First sixteen hexadecimal digits of a SHA-256 hash.
fn digits(hash: Sha256) -> String {
    hash.finalize().iter().take(8).map(|byte| format!("{byte:02x}")).collect()
}

/// First sixteen hexadecimal digits of the SHA-256 hash of some bytes.
#[must_use]
pub fn of_bytes(bytes: &[u8]) -> String {
    let mut hash = Sha256::new();
    hash.update(bytes);
    digits(hash)
}

/// First sixteen hexadecimal digits of the SHA-256 hash of a file, read in blocks.
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

/// Hashes the keys that affect the expected image; `content` identifies the content of a file.
fn of_target(doc: &SceneDoc, content: impl FnMut(&str) -> String) -> String {
    let counts = |leaf: &Leaf| leaf.key().affects == Affects::Scene && !leaf.is_default();
    of_lines(&format!("target {RECIPE}"), doc, counts, content)
}

/// Hashes all keys that affect the samples.
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
    // A document that cannot be written as a scene file has no keys; its text is hashed.
    let Ok(leaves) = leaves(doc) else { return of_bytes(scene_file::to_toml(doc).as_bytes()) };
    let mut text = format!("{head}\n");
    // Other views are separate images.
    for leaf in leaves.iter().filter(|leaf| !leaf.key().path.starts_with("compare.") && counts(leaf)) {
        let value = match (leaf.key().value, leaf.value.as_str()) {
            (Type::File, Some(file)) if !file.is_empty() => content(file),
            _ => canonical(&leaf.value),
        };
        // The name that the key had before objects had materials.
        let path = leaf.path.replace(".material.albedo", ".albedo");
        text.push_str(&format!("{path} = {value}\n"));
    }
    of_bytes(text.as_bytes())
}

/// Canonical spelling of a value, independent of the file writer.
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
    /// Fingerprint of the image to which unbiased estimates of a document converge: two documents with the
    /// same fingerprint differ only in how the image is estimated.
    #[must_use]
    pub fn fingerprint(&mut self, doc: &SceneDoc) -> String {
        of_target(doc, |file| self.digest(file))
    }

    /// Fingerprint of the samples of a document: with the same fingerprint, each numbered sample of a pixel
    /// is the same path with the same value.
    #[must_use]
    pub fn sample_fingerprint(&mut self, doc: &SceneDoc) -> String {
        of_samples(doc, |file| self.digest(file))
    }

    /// Whether a fingerprint in a file identifies the image of a document, in the current format or in that
    /// of version 0.1.
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
            doc.medium_mut().density = DensityDoc::Grid(GridRef { file: file.into(), grid: None });
            doc
        };
        let mut library = Library::default().with_volume("a.vdb", *b"cloud").with_volume("b.vdb", *b"cloud");
        library = library.with_volume("c.vdb", *b"smoke");
        let mut name = |file: &str| library.fingerprint(&with(file));
        assert_eq!(name("a.vdb"), name("b.vdb"));
        assert_ne!(name("a.vdb"), name("c.vdb"));
        assert_eq!(name("a.vdb").len(), 16);
        // Estimation settings are not hashed.
        let mut edited = with("a.vdb");
        edited.estimator.id = "nee".into();
        edited.render.seed = 9;
        edited.medium_mut().majorant.factor = 2.0;
        assert_eq!(library.fingerprint(&edited), library.fingerprint(&with("a.vdb")));
        assert_ne!(library.sample_fingerprint(&edited), library.sample_fingerprint(&with("a.vdb")));
        edited.medium_mut().scale = 2.0;
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
        assert!(!same(|d| d.medium_mut().majorant.shared = true) && !same(|d| d.camera.fov_deg = 30.0));
    }

    #[test]
    fn a_file_is_hashed_piece_by_piece_to_the_same_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bytes");
        let bytes: Vec<u8> = (0..3_000_000u32).map(|i| (i % 251) as u8).collect();
        std::fs::write(&path, &bytes).unwrap();
        assert_eq!(of_file(&path).unwrap(), of_bytes(&bytes));
    }

    /// Fingerprints of the embedded scenes, in the current format and in that of version 0.1. A change of the
    /// current ones requires a new version of the fingerprint.
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

    /// A change of a key that version 0.1 did not hash leaves the fingerprint unchanged; any other change
    /// alters it.
    #[test]
    fn the_legacy_name_depends_on_what_it_did() {
        let name = |edit: fn(&mut SceneDoc)| {
            let mut doc = SceneDoc::default();
            edit(&mut doc);
            legacy::of_scene(&doc, str::to_owned)
        };
        let plain = name(|_| ());
        assert!(plain.is_some());
        assert_eq!(name(|d| d.medium_mut().majorant.factor = 0.5), plain);
        assert_eq!(
            name(|d| d.estimator = crate::scene::EstimatorDoc { id: "nee".into(), ..d.estimator.clone() }),
            plain
        );
        assert_eq!(name(|d| (d.title, d.render.seed, d.view.exposure_ev) = ("x".into(), 3, 2.0)), plain);
        assert_ne!(name(|d| d.medium_mut().scale = 2.0), plain);
        assert_ne!(name(|d| d.estimator.max_depth = Some(2)), plain);
        assert_ne!(name(|d| d.lights.clear()), plain);
    }

    /// Objects have the fingerprint that they had when their albedo was a key of the object.
    #[test]
    fn objects_of_format_1_keep_their_fingerprint() {
        let text = "majorant = 1
            title = \"fp\"
            film = { width = 16, height = 16 }
            [[lights]]
            kind = \"environment\"
            [[objects]]
            kind = \"ground\"
            point = [0.0, -0.5, 0.0]
            albedo = 0.25
            [[objects]]
            kind = \"box\"
            center = [0.8, -0.2, 0.0]
            size = [0.3, 0.6, 0.3]
            rotate_deg = [0.0, 20.0, 0.0]
            albedo = { rgb = [0.1, 0.2, 0.3] }
            [[objects]]
            kind = \"box\"
            center = [0.0, 0.0, 9.0]
            size = [0.3, 0.6, 0.3]";
        let mut library = Library::default();
        let mut doc = scene_file::parse(text, "objects").unwrap();
        assert_eq!(library.fingerprint(&doc), "c2ceb8b22aef5374");
        // An emission counts although its scale is the default.
        doc.objects[1].emission = Some(crate::scene::SurfaceEmissionDoc::default());
        assert_ne!(library.fingerprint(&doc), "c2ceb8b22aef5374");
    }
}
