//! Resolution of a SCENE argument: a file, or the name of an embedded scene.

use super::{Failure, options};
use majorant_core::estimator::{self, Entry, Settings};
use majorant_core::io::{Library, embedded, scene_file};
use majorant_core::scene::{SceneDoc, build};
use majorant_core::session::{Probe, probe_of_film};
use std::path::Path;
use std::sync::Arc;

/// A scene with the library that resolves its files.
pub(super) struct Source {
    pub doc: SceneDoc,
    pub resources: Library,
}

/// Arguments of commands that trace single paths.
#[derive(clap::Args, Debug)]
pub(super) struct Traced {
    /// A scene file, or the name of an embedded scene.
    scene: String,
    /// Id of the estimator, as listed by `majorant estimators`.
    #[arg(long, value_name = "ID")]
    estimator: Option<String>,
    /// Set any key of the scene, as listed by `majorant keys`. Repeatable.
    #[arg(long, value_name = "KEY=VALUE", num_args = 1..)]
    set: Vec<String>,
}

/// A built scene with its estimator and probe.
pub(super) struct Frozen {
    pub doc: SceneDoc,
    pub entry: &'static Entry,
    probe: Probe,
}

impl Frozen {
    /// Creates the probe for the first `samples` samples per pixel of the film. Progressive majorants are
    /// raised as by the film.
    pub fn probe(&self, samples: u64) -> Result<Probe, Failure> {
        Ok(probe_of_film(&self.probe, self.doc.render.threads, samples)?)
    }
}

impl Traced {
    /// Loads the scene, applies the assignments and builds it.
    pub fn frozen(&self) -> Result<Frozen, Failure> {
        let mut source = load(&self.scene)?;
        let id = ("estimator.id", self.estimator.as_ref().map(|id| format!("{id:?}")));
        let doc = scene_file::override_keys(&source.doc, &options::assignments(&self.set, &[id]))?;
        if let Some(problem) = estimator::validate(&doc).first() {
            return Err(Failure::Message(problem.to_string()));
        }
        let entry = estimator::find(&doc.estimator.id)
            .ok_or_else(|| Failure::Message(format!("`{}` is not an estimator", doc.estimator.id)))?;
        let settings = Settings::new(&doc.estimator, doc.render.seed);
        let scene = build(&doc, &mut source.resources)?;
        let probe = Probe::new(Arc::new(scene), entry.kernel, settings);
        Ok(Frozen { doc, entry, probe })
    }
}

/// Loads a scene by path or embedded name; an existing file takes precedence.
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
        "there is no file `{scene}`, and no embedded scene of that name; the embedded scenes are {}",
        names.join(", ")
    )))
}
