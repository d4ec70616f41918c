//! Opening of a reference for a scene, with checks that it shows the same image.

use super::experiment::label;
use super::reference::Reference;
use crate::io::picture::{self, PictureError};
use crate::io::{Library, scene_file};
use crate::scene::{Mode, SceneDoc, keys};
use std::path::Path;

/// Reason why an image cannot be the reference of a scene.
#[derive(Debug, thiserror::Error)]
pub enum ReferenceError {
    /// It could not be read.
    #[error("the reference {0}")]
    Picture(#[from] PictureError),
    /// It has a different size.
    #[error(
        "the reference {file} has {} × {} pixels, but the scene {} × {}: render a new one of this size with \
         `majorant render SCENE --spp 4096 -o {file}`, or set the size of the scene to that of the reference",
        reference[0], reference[1], scene[0], scene[1]
    )]
    Size {
        /// File of the reference.
        file: String,
        /// Columns and rows of the reference.
        reference: [usize; 2],
        /// Columns and rows of the scene.
        scene: [usize; 2],
    },
    /// It shows the scene with a bias, or with unknown noise.
    #[error(
        "the reference {file} cannot be used: {reason}. Render a new one with `majorant render SCENE --spp 4096 -o \
         {file}`, or name another file"
    )]
    Unfit {
        /// File of the reference.
        file: String,
        /// Reason why it is unsuitable.
        reason: &'static str,
    },
    /// It shows a different image.
    #[error(
        "the reference {file} shows a different image ({reference}) from the scene ({scene}): {check}. Render a new \
         one of this scene with `majorant render SCENE --spp 4096 -o {file}`, or name another file"
    )]
    Target {
        /// File of the reference.
        file: String,
        /// Fingerprint of the image that the reference shows.
        reference: String,
        /// Fingerprint of the image of the scene.
        scene: String,
        /// Differences, as far as the metadata of the file shows.
        check: String,
    },
}

/// Reads a reference for the image of the first view of a document. A file without a fingerprint, such as one
/// by another renderer, is accepted with a note.
///
/// # Errors
/// When it cannot be read, has a different size, shows a different image from the scene, or has biased
/// settings.
pub fn open(
    file: &str,
    doc: &SceneDoc,
    library: &mut Library,
    notes: &mut Vec<String>,
) -> Result<Reference, ReferenceError> {
    let path = library.locate(file);
    let file = path.display().to_string();
    let mut reference = Reference::read(&path)?;
    notes.extend(reference.notices.iter().cloned());
    let (size, scene) =
        ([reference.width, reference.height], [doc.film.width as usize, doc.film.height as usize]);
    if let Some(reason) = reference.unfit {
        return Err(ReferenceError::Unfit { file, reason });
    }
    let target = library.fingerprint(doc);
    if size != scene {
        return Err(ReferenceError::Size { file, reference: size, scene });
    }
    match reference.target.take() {
        Some(shown) if !library.is_named(&shown, doc) => {
            let check = difference(&path, doc);
            return Err(ReferenceError::Target { file, reference: shown, scene: target, check });
        }
        None => notes.push(format!(
            "{file} does not say which image it shows: it is assumed to show this scene, in linear sRGB"
        )),
        Some(_) => {}
    }
    reference.target = Some(target);
    let seed = seed_of(&path);
    let shared: Vec<String> = (0..doc.view_count())
        .filter(|view| seed.is_some() && doc.view_overrides(*view).map(|c| c.seed) == seed)
        .map(label)
        .collect();
    if let (Some(seed), false) = (seed, shared.is_empty()) {
        notes.push(format!(
            "{file} was rendered with seed {seed}, like view {}: their correlated noise looks like agreement; \
             choose other seeds for the views",
            shared.join(", ")
        ));
    }
    Ok(reference)
}

/// Seed with which an image was rendered, if its metadata state one. A view with the same seed would appear
/// more accurate than it is.
#[must_use]
pub fn seed_of(picture: &Path) -> Option<u64> {
    metadata(picture)?["seed"].as_u64()
}

/// Metadata of an image in JSON, if it has any.
fn metadata(path: &Path) -> Option<serde_json::Value> {
    serde_json::from_str(&picture::exr_info(path).ok()?.metadata?).ok()
}

/// Describes the differences between the scene in the file and the document.
fn difference(path: &Path, doc: &SceneDoc) -> String {
    let metadata = metadata(path);
    let text = metadata.as_ref().and_then(|m| m["scene"].as_str());
    let Some(theirs) = text.and_then(|t| scene_file::parse(t, "the reference").ok()) else {
        return "mode, depth, camera, medium or lights differ".into();
    };
    let mode = |m: Mode| if m == Mode::Rgb { "rgb" } else { "spectral" };
    let depth = |d: Option<u32>| d.map_or("unlimited".into(), |d| d.to_string());
    let (a, b) = (theirs.target_part(), doc.target_part());
    let mut found = Vec::new();
    if a.estimator.mode != b.estimator.mode {
        found.push(format!(
            "`estimator.mode` is {} there and {} here",
            mode(a.estimator.mode),
            mode(b.estimator.mode)
        ));
    }
    if a.estimator.max_depth != b.estimator.max_depth {
        found.push(format!(
            "`estimator.max_depth` is {} there and {} here",
            depth(a.estimator.max_depth),
            depth(b.estimator.max_depth)
        ));
    }
    let others: Vec<&str> =
        keys::changed(&a, &b).unwrap_or_default().into_iter().map(|key| key.path).collect();
    let others: Vec<&str> = others.into_iter().filter(|path| !path.starts_with("estimator.")).collect();
    if !others.is_empty() {
        found.push(format!("these differ: {}", others.join(", ")));
    }
    if found.is_empty() { "a file that the scene references has changed".into() } else { found.join("; ") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::report::fixture;
    use crate::compare::{Finished, run};
    use crate::io::export;
    use crate::scene::{Limits, ReferenceDoc};

    /// The fixture without a reference, with the image of its first view as a file.
    fn rendered(folder: &Path) -> (SceneDoc, String) {
        let mut doc = fixture::doc("opened");
        doc.compare.reference = ReferenceDoc::None;
        let Finished { experiment, .. } = run(&doc, Library::default(), |_| {}).unwrap();
        let path = folder.join("reference.exr");
        let view = &experiment.views[0].1;
        export::write_exr(&path, &view.snapshot, &view.doc).unwrap();
        (doc, path.display().to_string())
    }

    fn opened(file: &str, doc: &SceneDoc) -> (Result<Reference, ReferenceError>, Vec<String>) {
        let mut notes = Vec::new();
        (open(file, doc, &mut Library::default(), &mut notes), notes)
    }

    #[test]
    fn a_reference_of_the_scene_fits_and_shared_random_numbers_are_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let (mut doc, file) = rendered(folder.path());
        let (reference, notes) = opened(&file, &doc);
        assert!(reference.unwrap().fits(&Library::default().fingerprint(&doc)));
        assert!(notes.len() == 1 && notes[0].contains("seed 0, like view A"), "{notes:?}");
        doc.render.seed = 77;
        doc.render.set_limits(Limits::samples(9));
        assert!(opened(&file, &doc).1.is_empty());
    }

    #[test]
    fn another_image_or_size_is_refused_by_what_differs() {
        let folder = tempfile::tempdir().unwrap();
        let (doc, file) = rendered(folder.path());
        let refused = |edit: fn(&mut SceneDoc)| {
            let mut doc = doc.clone();
            edit(&mut doc);
            opened(&file, &doc).0.unwrap_err().to_string()
        };
        let mode = refused(|d| d.estimator.mode = Mode::Spectral);
        assert!(mode.contains("`estimator.mode` is rgb there and spectral here"), "{mode}");
        assert!(mode.contains("majorant render"), "{mode}");
        assert!(refused(|d| d.estimator.max_depth = Some(2)).contains("unlimited there and 2 here"));
        assert!(refused(|d| d.medium_mut().scale = 2.0).contains("these differ: medium"));
        let size = refused(|d| d.film.width = 25);
        assert!(size.contains("24 × 16") && size.contains("25 × 16"), "{size}");
        assert!(opened("nowhere.exr", &doc).0.unwrap_err().to_string().contains("nowhere.exr"));
    }

    #[test]
    fn a_picture_with_a_planted_mistake_is_no_reference() {
        let folder = tempfile::tempdir().unwrap();
        let (mut doc, _) = rendered(folder.path());
        (doc.estimator.id, doc.estimator.fault) = ("uni-nee-mis".into(), crate::scene::Fault::PhaseInBoth);
        doc.compare.views.clear();
        let Finished { experiment, .. } = run(&doc, Library::default(), |_| {}).unwrap();
        let path = folder.path().join("wrong.exr");
        let view = &experiment.views[0].1;
        export::write_exr(&path, &view.snapshot, &view.doc).unwrap();
        let message = opened(&path.display().to_string(), &doc.unbiased()).0.unwrap_err().to_string();
        assert!(message.contains("a fault is planted"), "{message}");
        // An image that overflowed states it as well.
        let mut lossy = (*view.snapshot).clone();
        lossy.tally.non_finite = 3;
        export::write_exr(&path, &lossy, &doc.unbiased()).unwrap();
        let message = opened(&path.display().to_string(), &doc.unbiased()).0.unwrap_err().to_string();
        assert!(message.contains("not finite"), "{message}");
    }

    #[test]
    fn a_picture_by_another_renderer_is_accepted_with_a_note() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("theirs.exr");
        exr::prelude::write_rgb_file(&path, 24, 16, |_, _| (0.5f32, 0.5f32, 0.5f32)).unwrap();
        let (reference, notes) = opened(&path.display().to_string(), &fixture::doc("theirs"));
        let reference = reference.unwrap();
        assert!(reference.target.is_some() && reference.standard_error().is_none());
        assert!(notes.len() == 1 && notes[0].contains("assumed to show"), "{notes:?}");
    }
}
