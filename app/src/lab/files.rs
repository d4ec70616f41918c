//! File commands: opening, saving, exporting and dropped files.

use super::dialogs::{Dialog, PathPrompt};
use super::{Command, LabApp, Purpose, Severity};
use crate::model::Source;
use crate::model::WallEdit;
use crate::model::own_volume::{Look, with_volume};
use crate::widgets::format_number;
use majorant_core::compare;
use majorant_core::io::volume::EXTENSIONS;
use majorant_core::io::{mesh, picture};
use majorant_core::scene::{
    DensityDoc, GridRef, LightDoc, ObjectDoc, PhaseDoc, PlacementDoc, ReferenceDoc, ShapeDoc,
};
use std::path::{Path, PathBuf};

/// Kind of a file, by its extension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FileKind {
    Scene,
    Volume,
    Panorama,
    Mesh,
    Unknown,
}

impl FileKind {
    /// Determines the kind by the extension alone, as for a file that hovers over the window.
    pub fn of(path: &Path) -> Self {
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("toml") => Self::Scene,
            Some(volume) if EXTENSIONS.contains(&volume) => Self::Volume,
            Some("exr" | "hdr") => Self::Panorama,
            Some(mesh) if mesh::ENDINGS.contains(&mesh) => Self::Mesh,
            _ => Self::Unknown,
        }
    }
}

impl LabApp {
    /// Opens a file according to its extension.
    pub(super) fn open_any(&mut self, path: PathBuf) {
        match FileKind::of(&path) {
            FileKind::Scene => self.apply(Command::Open(Source::File(path))),
            FileKind::Volume => self.attempt(|app| app.tasks.look_into(path)),
            FileKind::Panorama if self.is_render(&path) => self.use_as_reference(&path),
            FileKind::Panorama => self.light_with(&path),
            FileKind::Mesh => self.add_mesh(&path),
            FileKind::Unknown => self.messages.fail(format!(
                "{}: unsupported file type. Scenes are .toml, volumes .vdb, .npy, .vol or .raw, environment maps .exr or .hdr, meshes .obj, .ply, .gltf or .glb.",
                path.display()
            )),
        }
    }

    /// Opens the path entry for a file, and the desktop's file dialog where it exists.
    pub(super) fn ask(&mut self, purpose: Purpose) {
        let suggestion = self.suggestion(purpose);
        self.dialog = Some(Dialog::Path(PathPrompt::new(purpose, suggestion)));
        if self.native_dialogs {
            let directory = self.document.base().to_owned();
            self.attempt(|app| app.tasks.pick(purpose, &directory));
        }
    }

    /// Initial path of a path entry.
    fn suggestion(&self, purpose: Purpose) -> String {
        let stem = match self.document.path() {
            Some(path) => path.with_extension(""),
            None => {
                // Characters that are valid on every file system.
                let plain = |c: char| if c.is_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
                let name: String = self.doc().title.chars().map(plain).collect();
                let words: Vec<&str> = name.split('-').filter(|word| !word.is_empty()).collect();
                self.document.base().join(words.join("-"))
            }
        };
        let stem = stem.to_string_lossy();
        match purpose {
            Purpose::SaveScene => format!("{stem}.toml"),
            Purpose::ExportExr => format!("{stem}.exr"),
            Purpose::ExportPng => format!("{stem}.png"),
            Purpose::ExportReport => format!("{stem}-comparison"),
            _ => String::new(),
        }
    }

    /// Uses a chosen file for its purpose.
    pub(super) fn chosen(&mut self, purpose: Purpose, path: PathBuf) {
        match purpose {
            Purpose::OpenScene => self.apply(Command::Open(Source::File(path))),
            Purpose::OpenVolume => self.attempt(|app| app.tasks.look_into(path)),
            Purpose::SaveScene => self.save_to(&path),
            Purpose::Reference => self.use_as_reference(&path),
            Purpose::ExportReport => self.export_report(path),
            Purpose::ExportExr | Purpose::ExportPng => self.export(purpose == Purpose::ExportPng, path),
            Purpose::DensityFile => {
                let file = self.short_name(&path);
                let mut doc = self.doc().clone();
                if let DensityDoc::Grid(grid) | DensityDoc::RgbGrid(grid) =
                    &mut doc.medium_at_mut(self.medium).density
                {
                    *grid = GridRef { file, grid: None };
                }
                self.document.edit(doc);
            }
            Purpose::TemperatureFile => {
                let file = self.short_name(&path);
                let mut doc = self.doc().clone();
                if let Some(emission) = &mut doc.medium_at_mut(self.medium).emission {
                    emission.temperature = Some(GridRef { file, grid: None });
                }
                self.document.edit(doc);
            }
            Purpose::PhaseTable => {
                let name = self.short_name(&path);
                let mut doc = self.doc().clone();
                if let PhaseDoc::Tabulated { points, file, .. } = &mut doc.medium_at_mut(self.medium).phase {
                    points.clear();
                    *file = name;
                }
                self.document.edit(doc);
            }
            Purpose::EnvironmentMap(index) => {
                let name = self.short_name(&path);
                let mut doc = self.doc().clone();
                if let Some(LightDoc::EnvironmentMap { file, .. }) = doc.lights.get_mut(index) {
                    *file = name;
                }
                self.document.edit(doc);
            }
            Purpose::Mesh(index) => {
                let name = self.short_name(&path);
                let mut doc = self.doc().clone();
                let shape = doc.objects.get_mut(index).map(|object| &mut object.shape);
                if let Some(ShapeDoc::Mesh { file, .. }) = shape {
                    *file = name;
                }
                self.document.edit(doc);
            }
        }
    }

    /// Adds a mesh to the objects, fitted to length 1 and centred on the origin.
    fn add_mesh(&mut self, path: &Path) {
        let placement = PlacementDoc { fit: Some(1.0), ..PlacementDoc::default() };
        let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let mut doc = self.doc().clone();
        let mut object = ObjectDoc::new(ShapeDoc::Mesh { file: self.short_name(path), placement });
        object.name = doc.free_object_name(&stem);
        doc.objects.push(object);
        self.document.edit(doc);
        self.messages
            .say(Severity::Done, format!("{} is added to the objects, fitted to length 1.", path.display()));
    }

    /// File name as stored in the document: relative to the scene if the file is below the scene's directory.
    fn short_name(&self, path: &Path) -> String {
        path.strip_prefix(self.document.base()).unwrap_or(path).to_string_lossy().into_owned()
    }

    /// Makes a readable volume the density of the medium.
    pub(super) fn fill_with(&mut self, path: &Path, look: &Look) {
        let doc = with_volume(self.doc(), self.short_name(path), look);
        let scale = doc.medium().scale;
        self.document.edit(doc);
        let name = path.display();
        self.messages.say(
            Severity::Done,
            format!(
                "{name} is the density of the medium, fitted to length 1 and scaled by {}.",
                format_number(scale.into())
            ),
        );
    }

    /// Whether an image is a render that can serve as the reference: it has the metadata of one, or the size
    /// of the film. Other images are used as environment maps.
    fn is_render(&self, path: &Path) -> bool {
        let film = &self.doc().film;
        picture::exr_info(path).is_ok_and(|info| {
            info.metadata.is_some()
                || (info.width, info.height) == (film.width as usize, film.height as usize)
        })
    }

    /// Makes an image the reference.
    fn use_as_reference(&mut self, path: &Path) {
        let file = self.short_name(path);
        let reference = ReferenceDoc::File { file };
        self.apply(Command::Wall(WallEdit::Reference(reference)));
        self.messages.say(Severity::Done, format!("Reading {} as the reference.", path.display()));
        self.wall.reread_reference();
        let seed = compare::seed_of(path);
        let sharing = (0..self.doc().view_count())
            .find(|view| seed.is_some() && self.doc().view_overrides(*view).map(|c| c.seed) == seed);
        if let Some(view) = sharing {
            self.messages.fail(format!(
                "{} was rendered with the seed of view {}: their correlated noise looks like agreement. Choose \
                 another seed for the view (Render, Limits, threads, seed).",
                path.display(),
                compare::label(view)
            ));
        }
    }

    /// Makes a panorama the environment map, replacing an existing one.
    fn light_with(&mut self, path: &Path) {
        let name = self.short_name(path);
        let mut doc = self.doc().clone();
        let known = doc.lights.iter_mut().find_map(|light| match light {
            LightDoc::EnvironmentMap { file, .. } => Some(file),
            _ => None,
        });
        match known {
            Some(file) => *file = name,
            None => doc.lights.push(LightDoc::EnvironmentMap {
                file: name,
                rotate_deg: 0.0,
                scale: 1.0,
                visible: true,
                enabled: true,
            }),
        }
        self.document.edit(doc);
    }

    /// Saves to the scene's file, or opens the path entry if it has none.
    pub(super) fn save_scene(&mut self) {
        match self.document.path().map(Path::to_owned) {
            Some(path) => self.save_to(&path),
            None => self.ask(Purpose::SaveScene),
        }
    }

    fn save_to(&mut self, path: &Path) {
        let path = if path.extension().is_none() { path.with_extension("toml") } else { path.to_owned() };
        match self.document.save(&path) {
            Ok(()) => {
                self.settings.remember(&path);
                self.messages.say(Severity::Done, format!("Saved {}.", path.display()));
                if let Some(command) = self.after_save.take() {
                    self.proceed(command);
                }
            }
            Err(problem) => {
                self.after_save = None;
                self.messages.fail(problem);
            }
        }
    }

    fn export(&mut self, png: bool, path: PathBuf) {
        // Image and document of the selected view have to match, independent of later edits.
        let found = self.wall.selected_slot().and_then(|slot| {
            let snapshot = slot.picture().filter(|s| s.spp > 0 && s.coarse.is_none())?;
            Some((snapshot.clone(), (*slot.rendered).clone()))
        });
        let Some((snapshot, doc)) = found else {
            self.messages.fail("There is no image to export yet. Wait for the first sample per pixel.");
            return;
        };
        self.attempt(|app| app.tasks.export(png, path, snapshot, doc));
    }

    fn export_report(&mut self, folder: PathBuf) {
        let mut experiment = self.wall.experiment();
        // The scene is written into the report's folder, so that its file names have to be absolute.
        experiment.doc = std::sync::Arc::new(self.document.resolved());
        self.messages.say(Severity::Done, format!("Writing the comparison to {}.", folder.display()));
        self.attempt(|app| app.tasks.report(folder, experiment));
    }

    pub(super) fn list_grids(&mut self, file: String) {
        if file.starts_with("embedded:") || self.grids.is_listed(&file) {
            return;
        }
        self.grids.begin(&file);
        let path = self.document.base().join(&file);
        self.attempt(|app| app.tasks.list(file, path));
    }

    fn attempt(&mut self, work: impl FnOnce(&mut Self) -> Result<(), String>) {
        if let Err(problem) = work(self) {
            self.messages.fail(problem);
        }
    }
}
