//! The medium as edited.

use super::CoefficientsDoc;
use crate::medium::{Interpolation, MajorantDoc, Precision};
use crate::phase::PhaseDoc;
use crate::spectrum::SpectrumDoc;
use serde::{Deserialize, Serialize};

/// A participating medium in an index-matched box.
///
/// Extinction is `σt(x, λ) = scale · density(x) · extinction(λ)`, per scene unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MediumDoc {
    /// Multiplies the density.
    pub scale: f32,
    /// Extinction of density 1, by wavelength.
    pub extinction: SpectrumDoc,
    /// Scattered fraction of what is extinguished, 0 to 1.
    pub albedo: SpectrumDoc,
    /// Replaces `extinction` and `albedo` by another way to give them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coefficients: Option<CoefficientsDoc>,
    /// Replaces the albedo by an RGB grid over the same box.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub albedo_grid: Option<GridRef>,
    /// Where the density comes from.
    pub density: DensityDoc,
    /// How many bits a value of a grid takes in memory.
    pub precision: Precision,
    /// How grids are looked up between samples.
    pub interpolation: Interpolation,
    /// Where the box stands.
    pub placement: PlacementDoc,
    /// The majorant that free flights are sampled from.
    pub majorant: MajorantDoc,
    /// Which way light scatters.
    pub phase: PhaseDoc,
    /// How it glows. Absent: not at all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub emission: Option<EmissionDoc>,
}

impl Default for MediumDoc {
    fn default() -> Self {
        Self {
            scale: 1.0,
            extinction: SpectrumDoc::Constant(4.0),
            albedo: SpectrumDoc::Constant(0.9),
            coefficients: None,
            albedo_grid: None,
            density: DensityDoc::default(),
            precision: Precision::F32,
            interpolation: Interpolation::Trilinear,
            placement: PlacementDoc::default(),
            majorant: MajorantDoc::default(),
            phase: PhaseDoc::default(),
            emission: None,
        }
    }
}

/// Thermal emission: what absorbs also emits, as a black body does at its temperature.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct EmissionDoc {
    /// Temperature by place; in OpenVDB files usually the grid `temperature`. Absent: the same everywhere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub temperature: Option<GridRef>,
    /// Kelvins of a temperature of 1.
    pub kelvin: f32,
    /// Multiplies the radiance, which is 1 for 3000 K at 560 nm.
    pub scale: f32,
}

impl Default for EmissionDoc {
    fn default() -> Self {
        Self { temperature: None, kelvin: 3000.0, scale: 1.0 }
    }
}

/// A grid in a file: OpenVDB, `.npy`, Mitsuba `.vol` or `.raw`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GridRef {
    /// The file, relative to the scene file, or `embedded:plume.vdb`.
    pub file: String,
    /// The grid's name inside the file; by default `density` (or `temperature`, for an emission), else the grid that is
    /// named most like it. A grid of another quantity, by its name or class, is never the default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grid: Option<String>,
}

/// Where the density comes from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum DensityDoc {
    /// 1 everywhere in the unit cube centred on the origin: a homogeneous medium.
    Uniform {},
    /// A scalar grid, trilinear between samples.
    Grid(GridRef),
    /// An RGB grid that stands for density times extinction; `extinction` is then unused.
    RgbGrid(GridRef),
}

impl Default for DensityDoc {
    fn default() -> Self {
        Self::Uniform {}
    }
}

impl DensityDoc {
    /// The file behind it, if any.
    #[must_use]
    pub fn grid(&self) -> Option<&GridRef> {
        match self {
            Self::Uniform {} => None,
            Self::Grid(grid) | Self::RgbGrid(grid) => Some(grid),
        }
    }
}

/// An affine placement: fit, then scale, rotate, translate; or a matrix instead of all of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PlacementDoc {
    /// First centre the box on the origin and scale its longest side to this length.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fit: Option<f32>,
    /// Scale along the box's axes.
    pub scale: [f32; 3],
    /// Turns about x, then y, then z, degrees.
    pub rotate_deg: [f32; 3],
    /// Moves by this much.
    pub translate: [f32; 3],
    /// Three rows of a world-from-object matrix, instead of scale, rotation and translation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub matrix: Option<[[f32; 4]; 3]>,
}

impl Default for PlacementDoc {
    fn default() -> Self {
        Self { fit: None, scale: [1.0; 3], rotate_deg: [0.0; 3], translate: [0.0; 3], matrix: None }
    }
}
