//! Editable scene: the document that panels edit, scene files store and undo keeps.
//!
//! Plain data without handles or caches. [`super::build`] freezes it into a [`super::Scene`]. Lengths are in
//! scene units, angles in degrees, wavelengths in nanometres, extinction per scene unit.

mod camera;
mod coefficients;
mod compare;
mod estimator;
mod fault;
mod light;
mod material;
mod medium;
mod object;
mod render;

pub use crate::film::display::{ToneCurve, ViewDoc};
pub use crate::light::LightSelection;
pub use crate::medium::{MajorantDoc, WhenExceeded};
pub use crate::phase::{Angle, PhaseDoc};
pub use camera::{CameraDoc, FilmDoc};
pub use coefficients::{CoefficientsDoc, CoefficientsKind, MEAN_FREE_PATHS};
pub use compare::{CompareDoc, Fairness, MAX_VIEWS, MeasureId, MediumOverrides, ReferenceDoc, ViewOverrides};
pub use estimator::{
    Absorption, Bookkeeping, DirectionSampling, DistanceSampling, EstimatorDoc, Heuristic, Heuristics,
    LightSampling, LightWalk, Mode, Tracking,
};
pub use fault::{Fault, FaultEntry};
pub use light::LightDoc;
pub use material::{IorDoc, MaterialDoc};
pub use medium::{DensityDoc, EmissionDoc, GridRef, MediumDoc, PlacementDoc, Within};
pub use object::{ObjectDoc, ShapeDoc, SurfaceEmissionDoc};
pub use render::{Limits, RenderDoc};

use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// Version of the scene format that this program writes. Version 1 has a single medium, in a table `[medium]`.
pub const FORMAT_VERSION: u32 = 2;

/// Maximum number of media of a scene.
pub const MAX_MEDIA: usize = 256;

/// A complete scene, as edited and as stored.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneDoc {
    /// Format version; files without it or with another version are rejected.
    pub majorant: u32,
    /// Short name.
    #[serde(default)]
    pub title: String,
    /// Description of the scene: what to look for in the image.
    #[serde(default)]
    pub note: String,
    /// Camera.
    #[serde(default)]
    pub camera: CameraDoc,
    /// Image size.
    #[serde(default)]
    pub film: FilmDoc,
    /// Media. Where they overlap, their coefficients add.
    #[serde(
        alias = "medium",
        default,
        deserialize_with = "medium::one_or_several",
        skip_serializing_if = "Vec::is_empty"
    )]
    pub media: Vec<MediumDoc>,
    /// Light sources.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lights: Vec<LightDoc>,
    /// Objects: surfaces that block, reflect or emit light, and boundaries of media.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub objects: Vec<ObjectDoc>,
    /// Estimator of light transport.
    #[serde(default)]
    pub estimator: EstimatorDoc,
    /// Stopping limits, seed and number of threads.
    #[serde(default)]
    pub render: RenderDoc,
    /// Display settings; they never change the estimate.
    #[serde(default)]
    pub view: ViewDoc,
    /// Additional views of the scene and their comparison.
    #[serde(default, skip_serializing_if = "is_default")]
    pub compare: CompareDoc,
    /// Window state, kept for the application and not read in this crate.
    #[serde(default, skip_serializing_if = "toml::Table::is_empty")]
    pub window: toml::Table,
}

fn is_default(compare: &CompareDoc) -> bool {
    *compare == CompareDoc::default()
}

impl Default for SceneDoc {
    fn default() -> Self {
        Self {
            majorant: FORMAT_VERSION,
            title: "Untitled".into(),
            note: String::new(),
            camera: CameraDoc::default(),
            film: FilmDoc::default(),
            media: vec![MediumDoc::default()],
            lights: vec![LightDoc::default()],
            objects: Vec::new(),
            estimator: EstimatorDoc::default(),
            render: RenderDoc { spp: Some(1024), ..RenderDoc::default() },
            view: ViewDoc::default(),
            compare: CompareDoc::default(),
            window: toml::Table::new(),
        }
    }
}

impl SceneDoc {
    /// The first medium, which is the only one in most scenes; a default medium if there is none.
    #[must_use]
    pub fn medium(&self) -> &MediumDoc {
        static NONE: LazyLock<MediumDoc> = LazyLock::new(MediumDoc::default);
        self.media.first().unwrap_or(&NONE)
    }

    /// The first medium, to be edited; a default medium is added if there is none.
    pub fn medium_mut(&mut self) -> &mut MediumDoc {
        if self.media.is_empty() {
            self.media.push(MediumDoc::default());
        }
        &mut self.media[0]
    }

    /// The medium at an index, or the last one if there are fewer; a default medium if there is none.
    #[must_use]
    pub fn medium_at(&self, index: usize) -> &MediumDoc {
        self.media.get(index).or(self.media.last()).unwrap_or_else(|| self.medium())
    }

    /// As [`Self::medium_at`], to be edited; a default medium is added if there is none.
    pub fn medium_at_mut(&mut self, index: usize) -> &mut MediumDoc {
        let index = index.min(self.media.len().saturating_sub(1));
        if index == 0 { self.medium_mut() } else { &mut self.media[index] }
    }

    /// A name for a new medium that no other medium has: `base`, or `base 2`, `base 3`, …
    #[must_use]
    pub fn free_medium_name(&self, base: &str) -> String {
        let taken = |name: &str| self.media.iter().any(|medium| medium.name == name);
        let numbered = (2..).map(|n| format!("{base} {n}"));
        std::iter::once(base.to_owned()).chain(numbered).find(|name| !taken(name)).unwrap_or_default()
    }

    /// Media that are part of the scene.
    pub fn enabled_media(&self) -> impl Iterator<Item = &MediumDoc> {
        self.media.iter().filter(|medium| medium.enabled)
    }

    /// The object with a name, with its index.
    #[must_use]
    pub fn object_named(&self, name: &str) -> Option<(usize, &ObjectDoc)> {
        self.objects.iter().enumerate().find(|(_, object)| !name.is_empty() && object.name == name)
    }

    /// A name for a new object that no other object has: `base`, or `base 2`, `base 3`, …; empty if `base` is.
    #[must_use]
    pub fn free_object_name(&self, base: &str) -> String {
        let taken = |name: &str| self.object_named(name).is_some() || Within::RESERVED.contains(&name);
        let numbered = (2..).map(|n| format!("{base} {n}"));
        std::iter::once(base.to_owned())
            .chain(numbered)
            .find(|name| base.is_empty() || !taken(name))
            .unwrap_or_default()
    }

    /// Renames an object in the list and in the media within it.
    pub fn rename_object(&mut self, index: usize, name: String) {
        let Some(object) = self.objects.get_mut(index) else { return };
        let before = Within::Object(std::mem::replace(&mut object.name, name.clone()));
        for medium in self.media.iter_mut().filter(|medium| medium.within == before) {
            medium.within = Within::Object(name.clone());
        }
    }

    /// Removes an object; media within it fill their own boxes instead.
    pub fn remove_object(&mut self, index: usize) {
        let removed = Within::Object(self.objects.remove(index).name);
        for medium in self.media.iter_mut().filter(|medium| medium.within == removed) {
            medium.within = Within::Grid;
        }
    }

    /// Key of a medium in messages: `medium`, or `medium[1]` where there are several.
    #[must_use]
    pub fn medium_path(&self, index: usize) -> String {
        if self.media.len() == 1 { "medium".into() } else { format!("medium[{index}]") }
    }

    /// Converts a document that was read from a file to the current version.
    #[must_use]
    pub fn upgraded(mut self) -> Self {
        if self.majorant == 1 {
            self.majorant = FORMAT_VERSION;
            // In version 1 a file without a medium has a default one.
            if self.media.is_empty() {
                self.media.push(MediumDoc::default());
            }
        }
        self.with_window_keys_moved()
    }

    /// Names of all files that the document refers to, including embedded ones. Empty names, still to be
    /// filled in, are omitted.
    pub fn files_mut(&mut self) -> Vec<&mut String> {
        let mut files = Vec::new();
        for medium in &mut self.media {
            if let DensityDoc::Grid(grid) | DensityDoc::RgbGrid(grid) = &mut medium.density {
                files.push(&mut grid.file);
            }
            if let Some(grid) = &mut medium.albedo_grid {
                files.push(&mut grid.file);
            }
            if let Some(grid) = medium.emission.as_mut().and_then(|emission| emission.temperature.as_mut()) {
                files.push(&mut grid.file);
            }
            if let PhaseDoc::Tabulated { file, .. } = &mut medium.phase {
                files.push(file);
            }
        }
        for light in &mut self.lights {
            if let LightDoc::EnvironmentMap { file, .. } = light {
                files.push(file);
            }
        }
        for object in &mut self.objects {
            if let ShapeDoc::Mesh { file, .. } = &mut object.shape {
                files.push(file);
            }
        }
        if let ReferenceDoc::File { file } = &mut self.compare.reference {
            files.push(file);
        }
        files.retain(|file| !file.is_empty());
        files
    }
}
