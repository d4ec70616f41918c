//! Location and caching of the files that scenes reference.

use super::placing::place;
use super::volume::{self, GridChoice, GridRole, ReadLimits, Volume};
use super::{Progress, embedded, fingerprint, mesh, phase_table, picture};
use crate::light::Panorama;
use crate::medium::Precision;
use crate::scene::{GridRef, PlacedGrid, ResourceError, Resources, SceneDoc};
use crate::surface::Mesh;
use std::collections::{BTreeMap, HashMap};
use std::hash::Hash;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

/// Key of a cached file; a modified file is read again.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Key {
    path: PathBuf,
    grid: Option<String>,
    role: GridRole,
    modified: Option<SystemTime>,
}

/// Resolves file names against a base directory and the embedded assets, and caches their contents, so that
/// edits do not read files again. The most recent files are kept.
#[derive(Clone, Debug, Default)]
pub struct Library {
    base: PathBuf,
    limits: ReadLimits,
    scalar: HashMap<(Key, Precision), PlacedGrid<1>>,
    rgb: HashMap<(Key, Precision), PlacedGrid<3>>,
    panoramas: HashMap<Key, (Arc<Panorama>, Vec<String>)>,
    meshes: HashMap<Key, (Arc<Mesh>, Vec<String>)>,
    /// Files in memory, by the name used in scenes.
    in_memory: BTreeMap<String, Arc<[u8]>>,
    pictures_in_memory: BTreeMap<String, Arc<Panorama>>,
    digests: HashMap<Key, String>,
    progress: Progress,
}

/// Maximum number of cached files of each kind, enough to switch between a few volumes.
const KEPT: usize = 4;

impl Library {
    /// Sets the directory against which relative names are resolved, usually that of the scene file.
    #[must_use]
    pub fn with_base(mut self, base: impl Into<PathBuf>) -> Self {
        self.base = base.into();
        self
    }

    /// Adds a volume, mesh or table in memory, which takes precedence over a file named `name`.
    #[must_use]
    pub fn with_volume(mut self, name: &str, bytes: impl Into<Arc<[u8]>>) -> Self {
        self.in_memory.insert(name.to_owned(), bytes.into());
        self
    }

    /// Adds an environment map in memory, which takes precedence over a file named `name`.
    #[must_use]
    pub fn with_panorama(mut self, name: &str, panorama: Panorama) -> Self {
        self.pictures_in_memory.insert(name.to_owned(), Arc::new(panorama));
        self
    }

    /// Progress of the volume that is being read.
    #[must_use]
    pub fn progress(&self) -> &Progress {
        &self.progress
    }

    /// Path of a file that a scene references.
    #[must_use]
    pub fn locate(&self, file: &str) -> PathBuf {
        if file.starts_with(embedded::PREFIX) { PathBuf::from(file) } else { self.base.join(file) }
    }

    /// Modification times of the files that a document references, to detect outdated scenes.
    #[must_use]
    pub fn stamps(&self, doc: &SceneDoc) -> Vec<Option<SystemTime>> {
        doc.scene_part().files_mut().into_iter().map(|file| self.key(file, None).modified).collect()
    }

    fn key(&self, file: &str, grid: Option<&String>) -> Key {
        let path = self.locate(file);
        let modified = std::fs::metadata(&path).and_then(|m| m.modified()).ok();
        Key { path, grid: grid.cloned(), role: GridRole::Density, modified }
    }

    /// Identifies the content of a file; an unreadable file is identified by its name.
    pub(super) fn digest(&mut self, file: &str) -> String {
        if let Some(bytes) = self.in_memory.get(file).map(|b| &**b).or_else(|| embedded::volume(file)) {
            return fingerprint::of_bytes(bytes);
        }
        let key = self.key(file, None);
        if let Some(known) = self.digests.get(&key) {
            return known.clone();
        }
        // A file beyond the size limit is identified by name, length and modification time.
        let long = std::fs::metadata(&key.path).ok().filter(|m| m.len() > self.limits.max_file_bytes);
        let digest = match long {
            Some(metadata) => format!("{file} {} {:?}", metadata.len(), key.modified),
            None => fingerprint::of_file(&key.path).unwrap_or_else(|_| file.to_owned()),
        };
        self.digests.insert(key, digest.clone());
        digest
    }

    /// Takes over the file digests of a copy.
    pub(crate) fn learn(&mut self, copy: Self) {
        self.digests.extend(copy.digests);
    }

    /// Reads a volume and converts it to a grid, with progress.
    fn read_and_place<const C: usize>(
        &self,
        key: &Key,
        file: &str,
        precision: Precision,
    ) -> Result<PlacedGrid<C>, ResourceError> {
        self.progress.begin(file);
        let placed = self.read(key, file).and_then(|voxels| place(voxels, &key.path, precision));
        self.progress.end();
        placed
    }

    /// A scalar grid read in a role, from the cache or from its file.
    fn scalar_in_role(
        &mut self,
        grid: &GridRef,
        role: GridRole,
        precision: Precision,
    ) -> Result<PlacedGrid<1>, ResourceError> {
        let key = (Key { role, ..self.key(&grid.file, grid.grid.as_ref()) }, precision);
        if let Some(kept) = self.scalar.get(&key) {
            return Ok(kept.clone());
        }
        let placed = self.read_and_place(&key.0, &grid.file, precision)?;
        keep(&mut self.scalar, key, placed.clone());
        Ok(placed)
    }

    fn read(&self, key: &Key, file: &str) -> Result<Volume, ResourceError> {
        if file.is_empty() {
            return Err(ResourceError("no file is named: choose a .vdb, .npy, .vol or .raw file".into()));
        }
        let grid = GridChoice { name: key.grid.as_deref(), role: key.role };
        // Conversion to bricks takes about a fifth of the total time.
        let watch = |share: f64| self.progress.at(READING * share);
        let read = match self.in_memory.get(file).map(|b| &**b).or_else(|| embedded::volume(file)) {
            Some(bytes) => volume::read_sparse_volume_bytes(bytes, file, grid, &self.limits, &watch),
            None if file.starts_with(embedded::PREFIX) => {
                let names: Vec<_> = embedded::VOLUMES.iter().map(|v| v.name).collect();
                return Err(ResourceError(format!(
                    "`{file}` is not embedded; there are {}",
                    names.join(", ")
                )));
            }
            None => volume::read_sparse_volume(&key.path, grid, &self.limits, &watch),
        };
        let volume = read.map_err(|e| ResourceError(e.to_string()))?;
        volume.validate_density(&key.path).map_err(|e| ResourceError(e.to_string()))?;
        Ok(volume)
    }
}

/// Maximum number of cached meshes, of which a scene may have many.
const KEPT_MESHES: usize = 64;

/// Fraction of the loading time of a volume that is spent on reading; the rest is conversion to bricks.
const READING: f64 = 0.8;

/// Adds an entry to a cache, clearing it first if it is full.
fn keep<K: Eq + Hash, V>(map: &mut HashMap<K, V>, key: K, value: V) {
    if map.len() >= KEPT {
        map.clear();
    }
    map.insert(key, value);
}

impl Resources for Library {
    fn scalar_grid(&mut self, grid: &GridRef, precision: Precision) -> Result<PlacedGrid<1>, ResourceError> {
        self.scalar_in_role(grid, GridRole::Density, precision)
    }

    fn temperature_grid(&mut self, grid: &GridRef) -> Result<PlacedGrid<1>, ResourceError> {
        self.scalar_in_role(grid, GridRole::Temperature, Precision::F32)
    }

    fn rgb_grid(&mut self, grid: &GridRef, precision: Precision) -> Result<PlacedGrid<3>, ResourceError> {
        let key = (self.key(&grid.file, grid.grid.as_ref()), precision);
        if let Some(kept) = self.rgb.get(&key) {
            return Ok(kept.clone());
        }
        let placed = self.read_and_place(&key.0, &grid.file, precision)?;
        keep(&mut self.rgb, key, placed.clone());
        Ok(placed)
    }

    fn panorama(&mut self, file: &str) -> Result<(Arc<Panorama>, Vec<String>), ResourceError> {
        if let Some(picture) = self.pictures_in_memory.get(file) {
            return Ok((Arc::clone(picture), Vec::new()));
        }
        let key = self.key(file, None);
        if let Some(kept) = self.panoramas.get(&key) {
            return Ok(kept.clone());
        }
        let (panorama, notices) =
            picture::read_panorama(&key.path).map_err(|e| ResourceError(e.to_string()))?;
        let read = (Arc::new(panorama), notices);
        keep(&mut self.panoramas, key, read.clone());
        Ok(read)
    }

    fn mesh(&mut self, file: &str) -> Result<(Arc<Mesh>, Vec<String>), ResourceError> {
        let key = self.key(file, None);
        if let Some(kept) = self.meshes.get(&key) {
            return Ok(kept.clone());
        }
        self.progress.begin(file);
        let read = match self.in_memory.get(file).map(|b| &**b).or_else(|| embedded::volume(file)) {
            Some(bytes) => mesh::parse_mesh(bytes, Path::new(file)),
            None => mesh::read_mesh(&key.path, self.limits.max_file_bytes),
        };
        self.progress.end();
        let (mesh, repairs) = read.map_err(|e| ResourceError(e.to_string()))?;
        let read = (Arc::new(mesh), repairs);
        if self.meshes.len() >= KEPT_MESHES {
            self.meshes.clear();
        }
        self.meshes.insert(key, read.clone());
        Ok(read)
    }

    /// Reads a phase table, which is too small to be cached.
    fn phase_table(&mut self, file: &str) -> Result<Vec<[f32; 2]>, ResourceError> {
        let read = match self.in_memory.get(file) {
            Some(bytes) => phase_table::parse(&String::from_utf8_lossy(bytes), file),
            None => phase_table::read(&self.locate(file)),
        };
        read.map_err(|e| ResourceError(e.to_string()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::scene_file;
    use crate::medium::AnyMedium;
    use crate::scene::build;
    use crate::spectrum::SpectrumDoc;

    fn field(doc: &SceneDoc, library: &mut Library) -> (usize, usize) {
        match &build(doc, library).expect("a good scene").medium(0).placed.medium {
            AnyMedium::DensityGrid(medium) => {
                (Arc::as_ptr(&medium.density).addr(), Arc::as_ptr(&medium.bounds).addr())
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn edits_of_anything_but_the_field_touch_no_voxel() {
        let toml = embedded::find("first-light").expect("the first scene").toml;
        let mut doc = scene_file::parse(toml, "first-light").expect("a good scene");
        doc.medium_mut().majorant.resolution = Some(12);
        let mut library = Library::default();
        let (density, bounds) = field(&doc, &mut library);
        let edits: [fn(&mut SceneDoc); 7] = [
            |d| d.medium_mut().scale = 3.0,
            |d| d.medium_mut().albedo = SpectrumDoc::Constant(0.5),
            |d| d.medium_mut().extinction = SpectrumDoc::Constant(7.0),
            |d| d.medium_mut().majorant.factor = 2.0,
            |d| d.medium_mut().majorant.shared = false,
            |d| d.camera.fov_deg = 20.0,
            |d| d.lights.truncate(1),
        ];
        for (i, edit) in edits.into_iter().enumerate() {
            edit(&mut doc);
            assert_eq!(field(&doc, &mut library), (density, bounds), "edit {i}");
        }
        // Another resolution has other majorants of the same voxels; both are cached.
        doc.medium_mut().majorant.resolution = Some(13);
        let other = field(&doc, &mut library);
        assert!(other.0 == density && other.1 != bounds);
        doc.medium_mut().majorant.resolution = Some(12);
        assert_eq!(field(&doc, &mut library), (density, bounds));
        doc.medium_mut().precision = Precision::F16;
        assert_ne!(field(&doc, &mut library).0, density);
    }

    #[test]
    fn reading_reports_its_progress() {
        let told = std::cell::RefCell::new(Vec::new());
        let watch = |share| told.borrow_mut().push(share);
        let bytes = embedded::volume("embedded:plume.vdb").expect("our plume");
        volume::read_sparse_volume_bytes(bytes, "plume.vdb", None, &ReadLimits::default(), &watch)
            .expect("it");
        let told = told.into_inner();
        assert!(told.len() > 8 && told.windows(2).all(|pair| pair[0] <= pair[1]), "{told:?}");
        assert_eq!(told.last(), Some(&1.0));

        // While the file is read, its name is visible; afterwards, no file is.
        let mut library = Library::default();
        let progress = library.progress().clone();
        let seen = std::thread::scope(|scope| {
            let reading = scope.spawn(|| {
                let grid = GridRef { file: "embedded:cloud.vdb".into(), grid: None };
                library.scalar_grid(&grid, Precision::F32).map(|_| ())
            });
            let mut seen = Vec::new();
            while !reading.is_finished() {
                seen.extend(progress.loading());
            }
            reading.join().expect("no panic").expect("our cloud");
            seen
        });
        assert!(seen.iter().all(|l| l.file == "embedded:cloud.vdb"), "{seen:?}");
        assert!(seen.windows(2).all(|pair| pair[0].fraction <= pair[1].fraction));
        assert_eq!(progress.loading(), None);
    }
}
