//! The editable scene: what a person edits, what a scene file holds, what undo remembers.
//!
//! Plain data without handles or caches. [`super::build`] freezes it into a [`super::Scene`].
//! Lengths are in scene units, angles in degrees, wavelengths in nanometres, extinction per scene unit.

mod camera;
mod coefficients;
mod compare;
mod estimator;
mod fault;
mod light;
mod medium;
mod object;
mod render;

pub use crate::film::display::{ToneCurve, ViewDoc};
pub use crate::light::LightSelection;
pub use crate::medium::{MajorantDoc, WhenExceeded};
pub use crate::phase::{Angle, PhaseDoc};
pub use camera::{CameraDoc, FilmDoc};
pub use coefficients::{CoefficientsDoc, CoefficientsKind, MEAN_FREE_PATHS};
pub use compare::{CompareDoc, ContenderDoc, Fairness, MAX_VIEWS, MeasureId, ReferenceDoc};
pub use estimator::{
    Absorption, Bookkeeping, DirectionSampling, DistanceSampling, EstimatorDoc, Heuristic, Heuristics,
    LightSampling, LightWalk, Mode, Tracking,
};
pub use fault::{Fault, FaultEntry};
pub use light::LightDoc;
pub use medium::{DensityDoc, EmissionDoc, GridRef, MediumDoc, PlacementDoc};
pub use object::ObjectDoc;
pub use render::{Limits, RenderDoc};

use serde::{Deserialize, Serialize};

/// The version of the scene format that this program writes.
pub const FORMAT_VERSION: u32 = 1;

/// A whole scene, as edited and as stored.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneDoc {
    /// Format version; a file without it or with another is refused.
    pub majorant: u32,
    /// A short name.
    #[serde(default)]
    pub title: String,
    /// What to notice in this scene.
    #[serde(default)]
    pub note: String,
    /// Where the picture is taken from.
    #[serde(default)]
    pub camera: CameraDoc,
    /// Its size.
    #[serde(default)]
    pub film: FilmDoc,
    /// What fills the box.
    #[serde(default)]
    pub medium: MediumDoc,
    /// Everything that emits.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lights: Vec<LightDoc>,
    /// Diffuse surfaces.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub objects: Vec<ObjectDoc>,
    /// How light transport is estimated.
    #[serde(default)]
    pub estimator: EstimatorDoc,
    /// When to stop, which random numbers, how many threads.
    #[serde(default)]
    pub render: RenderDoc,
    /// How the image is shown; never changes the estimate.
    #[serde(default)]
    pub view: ViewDoc,
    /// Further views of the scene, side by side.
    #[serde(default, skip_serializing_if = "is_default")]
    pub compare: CompareDoc,
    /// State of the window, kept for the application; nothing here reads it.
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
            medium: MediumDoc::default(),
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
    /// Every file that the document names, those that are part of the program too; empty names are still to
    /// be filled in and left out.
    pub fn files_mut(&mut self) -> Vec<&mut String> {
        let mut files = Vec::new();
        if let DensityDoc::Grid(grid) | DensityDoc::RgbGrid(grid) = &mut self.medium.density {
            files.push(&mut grid.file);
        }
        if let Some(grid) = &mut self.medium.albedo_grid {
            files.push(&mut grid.file);
        }
        let emission = self.medium.emission.as_mut();
        if let Some(grid) = emission.and_then(|e| e.temperature.as_mut()) {
            files.push(&mut grid.file);
        }
        if let PhaseDoc::Tabulated { file, .. } = &mut self.medium.phase {
            files.push(file);
        }
        for light in &mut self.lights {
            if let LightDoc::EnvironmentMap { file, .. } = light {
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
