//! Work that would block a frame: file dialogs, listing grids, reading and writing images.
//!
//! Each kind of task runs on a named thread and answers with one [`Outcome`], which `logic` polls.

use super::Purpose;
use crate::background::{Background, Reply, Wake};
use crate::model::own_volume::{self, Look};
use majorant_core::compare::{Experiment, Reference, report};
use majorant_core::film::Snapshot;
use majorant_core::io::{Library, export, mesh, volume};
use majorant_core::scene::SceneDoc;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Result of a task.
#[derive(Debug)]
pub enum Outcome {
    /// A file dialog was closed, with a file or without (cancelled, or no portal available).
    Picked(Purpose, Option<PathBuf>),
    /// Grids of a file, or its error. The string is the name of the file in the document.
    Listed(String, Result<Vec<String>, String>),
    /// Measurements of a dropped or opened volume.
    Volume(PathBuf, Result<Look, String>),
    /// An image or a report was written.
    Exported(PathBuf, Result<(), String>),
    /// A reference image was read.
    Reference(PathBuf, Result<Reference, String>),
}

/// Closure that executes one task.
type Job = Box<dyn FnOnce() -> Outcome + Send>;

/// Tasks in progress, with one thread per kind.
pub struct Tasks {
    workers: BTreeMap<&'static str, Background<Job, Outcome>>,
    wake: Wake,
}

impl Tasks {
    /// Creates an empty set; `wake` is called after each task.
    pub fn new(wake: impl Fn() + Send + Sync + 'static) -> Self {
        Self { workers: BTreeMap::new(), wake: Arc::new(wake) }
    }

    /// Returns the outcomes since the last call.
    pub fn take(&mut self) -> Vec<Outcome> {
        self.workers.values_mut().flat_map(Background::poll).collect()
    }

    fn spawn(
        &mut self,
        name: &'static str,
        job: impl FnOnce() -> Outcome + Send + 'static,
    ) -> Result<(), String> {
        let worker = self.workers.entry(name).or_insert_with(|| {
            let worker = Background::new(name, |job: Job, reply: &Reply<'_, Job, Outcome>| reply.send(job()));
            let wake = Arc::clone(&self.wake);
            worker.set_wake(move || wake());
            worker
        });
        worker.queue(Box::new(job)).map_err(|error| format!("Cannot start a thread for {name}: {error}"))
    }

    /// Shows the desktop's file dialog.
    ///
    /// # Errors
    /// When there is no thread to be had.
    pub fn pick(&mut self, purpose: Purpose, directory: &Path) -> Result<(), String> {
        let directory = directory.to_owned();
        self.spawn("dialog", move || Outcome::Picked(purpose, dialog(purpose, &directory)))
    }

    /// Lists the grids of a volume file.
    ///
    /// # Errors
    /// When there is no thread to be had.
    pub fn list(&mut self, named: String, path: PathBuf) -> Result<(), String> {
        self.spawn("grids", move || Outcome::Listed(named, names(&path)))
    }

    /// Reads a reference image for the views of a document.
    ///
    /// # Errors
    /// When there is no thread to be had.
    pub fn read_reference(
        &mut self,
        path: PathBuf,
        doc: SceneDoc,
        mut library: Library,
    ) -> Result<(), String> {
        self.spawn("reference", move || {
            let read = Reference::read(&path).map_err(|e| e.to_string());
            let read = read.and_then(|reference| match reference.unfit {
                // A fingerprint of an earlier version is replaced by the current one.
                None => {
                    let mut reference = reference;
                    if reference.target.as_deref().is_some_and(|name| library.is_named(name, &doc)) {
                        reference.target = Some(library.fingerprint(&doc));
                    }
                    Ok(reference)
                }
                Some(reason) => Err(format!(
                    "{}: {reason}, so that it cannot be used as a reference. Load or render another.",
                    path.display()
                )),
            });
            Outcome::Reference(path, read)
        })
    }

    /// Writes a report on a comparison.
    ///
    /// # Errors
    /// When there is no thread to be had.
    pub fn report(&mut self, folder: PathBuf, experiment: Experiment) -> Result<(), String> {
        self.spawn("report", move || {
            let written = report::write(&experiment, &folder, &report::Formats::all());
            Outcome::Exported(folder, written.map(|_| ()).map_err(|e| e.to_string()))
        })
    }

    /// Reads and measures a volume before the document is changed.
    ///
    /// # Errors
    /// When there is no thread to be had.
    pub fn look_into(&mut self, path: PathBuf) -> Result<(), String> {
        self.spawn("volume", move || {
            let look = own_volume::look_into(&path);
            Outcome::Volume(path, look)
        })
    }

    /// Writes an image: PNG as shown, or EXR with radiance and standard errors.
    ///
    /// # Errors
    /// When there is no thread to be had.
    pub fn export(
        &mut self,
        png: bool,
        path: PathBuf,
        snapshot: Arc<Snapshot>,
        doc: SceneDoc,
    ) -> Result<(), String> {
        self.spawn("export", move || {
            let written = match png {
                true => export::write_png(&path, &snapshot, &doc.view).map_err(|e| e.to_string()),
                false => export::write_exr(&path, &snapshot, &doc).map_err(|e| e.to_string()),
            };
            Outcome::Exported(path, written)
        })
    }
}

/// Names of the readable grids of a file; empty for formats without names, which contain one grid.
fn names(path: &Path) -> Result<Vec<String>, String> {
    if path.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case("vdb")) {
        let read = volume::read_volume(path, None, &volume::ReadLimits::default());
        return read.map(|_| Vec::new()).map_err(|error| error.to_string());
    }
    let grids = volume::info(path).map_err(|error| error.to_string())?;
    let problem = grids.iter().find_map(|grid| grid.error.clone());
    let names: Vec<String> = grids.into_iter().filter(|g| g.error.is_none()).map(|g| g.name).collect();
    match (names.is_empty(), problem) {
        (true, Some(problem)) => Err(problem),
        (true, None) => {
            Err(format!("{}: the file contains no grid. Export one density grid.", path.display()))
        }
        (false, _) => Ok(names),
    }
}

fn dialog(purpose: Purpose, directory: &Path) -> Option<PathBuf> {
    let dialog = rfd::FileDialog::new().set_directory(directory);
    let (title, filter, extensions, default): (_, _, &[&str], _) = match purpose {
        Purpose::OpenScene => ("Open scene", "Scenes", &["toml"], ""),
        Purpose::OpenVolume | Purpose::DensityFile | Purpose::TemperatureFile => {
            ("Open volume", "Volumes", volume::EXTENSIONS, "")
        }
        Purpose::PhaseTable => ("Open phase function", "Tables", &["csv", "txt", "dat"], ""),
        Purpose::EnvironmentMap(_) => ("Open environment map", "Images", &["exr", "hdr"], ""),
        Purpose::Mesh(_) => ("Open mesh", "Meshes", &mesh::ENDINGS, ""),
        Purpose::SaveScene => ("Save scene", "Scenes", &["toml"], "scene.toml"),
        Purpose::Reference => ("Open reference", "OpenEXR", &["exr"], ""),
        Purpose::ExportReport => return dialog.set_title("Export comparison").pick_folder(),
        Purpose::ExportExr => ("Export EXR", "OpenEXR", &["exr"], "render.exr"),
        Purpose::ExportPng => ("Export PNG", "PNG", &["png"], "render.png"),
    };
    let dialog = dialog.set_title(title).add_filter(filter, extensions);
    if default.is_empty() { dialog.pick_file() } else { dialog.set_file_name(default).save_file() }
}
