//! Editable medium.

use super::CoefficientsDoc;
use crate::medium::{Interpolation, MajorantDoc, Precision};
use crate::phase::PhaseDoc;
use crate::spectrum::SpectrumDoc;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use std::fmt;

/// A participating medium with an index-matched boundary.
///
/// Extinction is `σt(x, λ) = scale · density(x) · extinction(λ)`, per scene unit. Where media overlap, their
/// coefficients add.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MediumDoc {
    /// Name, unique among the media of a scene.
    pub name: String,
    /// Whether the medium is part of the scene.
    pub enabled: bool,
    /// Region that the medium fills.
    pub within: Within,
    /// Radius about the origin to which a medium within `everywhere` reaches. Absent: to infinity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub extent: Option<f32>,
    /// Multiplier of the density.
    pub scale: f32,
    /// Spectrum of the extinction at density 1, per scene unit.
    pub extinction: SpectrumDoc,
    /// Single-scattering albedo, 0 to 1.
    pub albedo: SpectrumDoc,
    /// Other parametrisation of the coefficients, in place of `extinction` and `albedo`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coefficients: Option<CoefficientsDoc>,
    /// RGB grid over the same box, in place of the albedo.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub albedo_grid: Option<GridRef>,
    /// Source of the density.
    pub density: DensityDoc,
    /// Precision of grid values in memory.
    pub precision: Precision,
    /// Interpolation between grid samples.
    pub interpolation: Interpolation,
    /// Placement of the box in the world.
    pub placement: PlacementDoc,
    /// The majorant that free flights are sampled from.
    pub majorant: MajorantDoc,
    /// Phase function.
    pub phase: PhaseDoc,
    /// Thermal emission. Absent: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub emission: Option<EmissionDoc>,
}

/// Name of a medium that has none in its file.
const DEFAULT_NAME: &str = "medium";

/// Region that a medium fills, written as `grid`, `everywhere` or the name of an object.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "String", into = "String")]
pub enum Within {
    /// The box of its grid, or a unit cube for a uniform density, with its placement.
    #[default]
    Grid,
    /// All of space, or a ball about the origin if an extent is given; for a uniform density.
    Everywhere,
    /// The inside of a closed object. A grid also ends at its own box.
    Object(String),
}

impl Within {
    /// Names of regions that are not objects.
    pub const RESERVED: [&str; 2] = ["grid", "everywhere"];
}

impl From<String> for Within {
    fn from(name: String) -> Self {
        match name.as_str() {
            "grid" => Self::Grid,
            "everywhere" => Self::Everywhere,
            _ => Self::Object(name),
        }
    }
}

impl From<Within> for String {
    fn from(within: Within) -> Self {
        match within {
            Within::Grid => "grid".into(),
            Within::Everywhere => "everywhere".into(),
            Within::Object(name) => name,
        }
    }
}

impl MediumDoc {
    /// Returns whether the coefficients are constant in space.
    #[must_use]
    pub fn is_uniform(&self) -> bool {
        matches!(self.density, DensityDoc::Uniform {}) && self.albedo_grid.is_none()
    }

    /// Returns whether the medium reaches to infinity.
    #[must_use]
    pub fn is_unbounded(&self) -> bool {
        self.within == Within::Everywhere && self.extent.is_none()
    }
}

/// Reads the media of a scene: a list, or a single table as in files of version 1.
pub(super) fn one_or_several<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<MediumDoc>, D::Error> {
    struct Media;

    impl<'de> Visitor<'de> for Media {
        type Value = Vec<MediumDoc>;

        fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
            f.write_str("[[media]], a list of media")
        }

        fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
            MediumDoc::deserialize(MapAccessDeserializer::new(map)).map(|medium| vec![medium])
        }

        fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Self::Value, A::Error> {
            Vec::deserialize(SeqAccessDeserializer::new(seq))
        }
    }

    from.deserialize_any(Media)
}

impl Default for MediumDoc {
    fn default() -> Self {
        Self {
            name: DEFAULT_NAME.into(),
            enabled: true,
            within: Within::Grid,
            extent: None,
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

/// Thermal emission: the absorption coefficient times the radiance of a black body at the local temperature.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct EmissionDoc {
    /// Temperature grid; in OpenVDB files usually named `temperature`. Absent: constant temperature.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub temperature: Option<GridRef>,
    /// Kelvins per unit of the grid's temperature.
    pub kelvin: f32,
    /// Multiplier of the radiance, which is 1 for 3000 K at 560 nm.
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
    /// File name, relative to the scene file, or `embedded:plume.vdb`.
    pub file: String,
    /// Name of the grid inside the file. Default: `density` (or `temperature`, for emission), else the grid
    /// with the most similar name. A grid whose name or class identifies another quantity is never the
    /// default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grid: Option<String>,
}

/// Source of the density.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum DensityDoc {
    /// 1 everywhere in the unit cube centred on the origin: a homogeneous medium.
    Uniform {},
    /// A scalar grid, trilinear between samples.
    Grid(GridRef),
    /// An RGB grid of density times extinction; `extinction` is then unused.
    RgbGrid(GridRef),
}

impl Default for DensityDoc {
    fn default() -> Self {
        Self::Uniform {}
    }
}

impl DensityDoc {
    /// Grid file, if the density comes from one.
    #[must_use]
    pub fn grid(&self) -> Option<&GridRef> {
        match self {
            Self::Uniform {} => None,
            Self::Grid(grid) | Self::RgbGrid(grid) => Some(grid),
        }
    }
}

/// Affine placement: fit, then scale, rotation and translation, or a matrix in place of these three.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PlacementDoc {
    /// Centres the box on the origin and scales its longest side to this length, before the other steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fit: Option<f32>,
    /// Scale along the axes of the box.
    pub scale: [f32; 3],
    /// Rotation about x, then y, then z, degrees.
    pub rotate_deg: [f32; 3],
    /// Translation.
    pub translate: [f32; 3],
    /// Three rows of a world-from-object matrix, in place of scale, rotation and translation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub matrix: Option<[[f32; 4]; 3]>,
}

impl Default for PlacementDoc {
    fn default() -> Self {
        Self { fit: None, scale: [1.0; 3], rotate_deg: [0.0; 3], translate: [0.0; 3], matrix: None }
    }
}
