//! Where a SCENE argument comes from: a file, or an embedded name.

use super::Failure;
use majorant_core::io::{Library, embedded, scene_file};
use majorant_core::scene::{Scene, SceneDoc, build};
use std::path::Path;

/// A scene with the library that resolves its files.
pub(super) struct Source {
    pub doc: SceneDoc,
    pub resources: Library,
}

/// A scene ready for paths, with the document that it is made from.
pub(super) struct Frozen {
    pub doc: SceneDoc,
    pub scene: Scene,
}

/// Loads a scene, sets keys of it and freezes it.
pub(super) fn frozen(scene: &str, assignments: &[String]) -> Result<Frozen, Failure> {
    let mut source = load(scene)?;
    let doc = scene_file::override_keys(&source.doc, assignments)?;
    if let Some(problem) = majorant_core::estimator::validate(&doc).first() {
        return Err(Failure::Message(problem.to_string()));
    }
    let scene = build(&doc, &mut source.resources)?;
    Ok(Frozen { doc, scene })
}

/// Loads a scene by embedded name or path; an existing file comes first.
pub(super) fn load(scene: &str) -> Result<Source, Failure> {
    let path = Path::new(scene);
    if path.exists() {
        let doc = scene_file::load(path)?;
        let resources = Library::default().with_base(path.parent().unwrap_or(Path::new("")));
        return Ok(Source { doc, resources });
    }
    if let Some(embedded) = embedded::find(scene) {
        let doc = scene_file::parse(embedded.toml, embedded.name)?;
        return Ok(Source { doc, resources: Library::default() });
    }
    let names: Vec<_> = embedded::SCENES.iter().map(|s| s.name).collect();
    Err(Failure::Message(format!(
        "there is no file `{scene}`, and no embedded scene of that name; embedded are {}",
        names.join(", ")
    )))
}
