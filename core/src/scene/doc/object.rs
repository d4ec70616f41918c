//! Diffuse surfaces as edited.

use crate::spectrum::SpectrumDoc;
use serde::{Deserialize, Serialize};

fn grey() -> SpectrumDoc {
    SpectrumDoc::Constant(0.5)
}
fn world_up() -> [f32; 3] {
    [0.0, 1.0, 0.0]
}

/// A surface that reflects diffusely; it receives light and blocks it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum ObjectDoc {
    /// An infinite plane.
    Ground {
        /// A point on it.
        #[serde(default)]
        point: [f32; 3],
        /// The side that is lit; the other side reflects as well.
        #[serde(default = "world_up")]
        normal: [f32; 3],
        /// Reflected fraction, 0 to 1.
        #[serde(default = "grey")]
        albedo: SpectrumDoc,
    },
    /// A solid box.
    Box {
        /// Its centre.
        center: [f32; 3],
        /// Edge lengths.
        size: [f32; 3],
        /// Turns about x, then y, then z, degrees.
        #[serde(default)]
        rotate_deg: [f32; 3],
        /// Reflected fraction, 0 to 1.
        #[serde(default = "grey")]
        albedo: SpectrumDoc,
    },
}

impl ObjectDoc {
    /// One of each kind, with the name that pickers show.
    #[must_use]
    pub fn templates() -> Vec<(&'static str, Self)> {
        vec![
            ("Ground plane", Self::Ground { point: [0.0, -0.5, 0.0], normal: world_up(), albedo: grey() }),
            (
                "Box",
                Self::Box {
                    center: [0.8, -0.2, 0.0],
                    size: [0.3, 0.6, 0.3],
                    rotate_deg: [0.0, 20.0, 0.0],
                    albedo: grey(),
                },
            ),
        ]
    }

    /// The kind's name for people.
    #[must_use]
    pub fn kind_name(&self) -> &'static str {
        match self {
            Self::Ground { .. } => "Ground plane",
            Self::Box { .. } => "Box",
        }
    }
}
