//! Editable diffuse surfaces.

use crate::spectrum::SpectrumDoc;
use serde::{Deserialize, Serialize};

fn grey() -> SpectrumDoc {
    SpectrumDoc::Constant(0.5)
}
fn present() -> bool {
    true
}
fn world_up() -> [f32; 3] {
    [0.0, 1.0, 0.0]
}

/// Diffuse surface; it receives light and blocks it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum ObjectDoc {
    /// An infinite plane.
    Ground {
        /// A point on the plane.
        #[serde(default)]
        point: [f32; 3],
        /// Normal of the upper side; the other side reflects as well.
        #[serde(default = "world_up")]
        normal: [f32; 3],
        /// Reflected fraction, 0 to 1.
        #[serde(default = "grey")]
        albedo: SpectrumDoc,
        /// Whether the surface is part of the scene.
        #[serde(default = "present")]
        enabled: bool,
    },
    /// A solid box.
    Box {
        /// Centre.
        center: [f32; 3],
        /// Edge lengths.
        size: [f32; 3],
        /// Rotation about x, then y, then z, degrees.
        #[serde(default)]
        rotate_deg: [f32; 3],
        /// Reflected fraction, 0 to 1.
        #[serde(default = "grey")]
        albedo: SpectrumDoc,
        /// Whether the surface is part of the scene.
        #[serde(default = "present")]
        enabled: bool,
    },
}

impl ObjectDoc {
    /// One object of each kind with its display name.
    #[must_use]
    pub fn templates() -> Vec<(&'static str, Self)> {
        vec![
            (
                "Ground plane",
                Self::Ground { point: [0.0, -0.5, 0.0], normal: world_up(), albedo: grey(), enabled: true },
            ),
            (
                "Box",
                Self::Box {
                    center: [0.8, -0.2, 0.0],
                    size: [0.3, 0.6, 0.3],
                    rotate_deg: [0.0, 20.0, 0.0],
                    albedo: grey(),
                    enabled: true,
                },
            ),
        ]
    }

    /// Display name of the kind.
    #[must_use]
    pub fn kind_name(&self) -> &'static str {
        match self {
            Self::Ground { .. } => "Ground plane",
            Self::Box { .. } => "Box",
        }
    }

    /// Returns whether the surface is part of the scene.
    #[must_use]
    pub fn enabled(&self) -> bool {
        match self {
            Self::Ground { enabled, .. } | Self::Box { enabled, .. } => *enabled,
        }
    }

    /// Whether the surface is part of the scene, to be edited.
    pub fn enabled_mut(&mut self) -> &mut bool {
        match self {
            Self::Ground { enabled, .. } | Self::Box { enabled, .. } => enabled,
        }
    }
}
