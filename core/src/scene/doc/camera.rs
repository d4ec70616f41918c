//! Camera and film as edited.

use serde::{Deserialize, Serialize};

/// A pinhole camera. The image plane's x runs right, y runs down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CameraDoc {
    /// Where it stands.
    pub origin: [f32; 3],
    /// What it looks at.
    pub target: [f32; 3],
    /// Which way is up.
    pub up: [f32; 3],
    /// Horizontal field of view, degrees.
    pub fov_deg: f32,
}

impl Default for CameraDoc {
    fn default() -> Self {
        Self { origin: [0.0, 0.0, 3.0], target: [0.0; 3], up: [0.0, 1.0, 0.0], fov_deg: 35.0 }
    }
}

/// The image's size in pixels.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FilmDoc {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl Default for FilmDoc {
    fn default() -> Self {
        Self { width: 960, height: 540 }
    }
}
