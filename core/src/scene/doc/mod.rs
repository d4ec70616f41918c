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
mod medium;
mod object;
mod render;

pub use crate::film::display::{ToneCurve, ViewDoc};
pub use crate::light::LightSelection;
pub use crate::medium::{MajorantDoc, WhenExceeded};
pub use crate::phase::{Angle, PhaseDoc};
pub use camera::{CameraDoc, FilmDoc};
pub use coefficients::{CoefficientsDoc, CoefficientsKind, MEAN_FREE_PATHS};
pub use compare::{CompareDoc, Fairness, MAX_VIEWS, MeasureId, ReferenceDoc, ViewOverrides};
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

/// Version of the scene format that this program writes.
pub const FORMAT_VERSION: u32 = 1;

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
    /// Medium.
    #[serde(default)]
    pub medium: MediumDoc,
    /// Light sources.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lights: Vec<LightDoc>,
    /// Diffuse surfaces.
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
    /// Names of all files that the document refers to, including embedded ones. Empty names, still to be
    /// filled in, are omitted.
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
