//! Editable camera and film.

use serde::{Deserialize, Serialize};

/// A pinhole camera. The image plane's x runs right, y runs down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CameraDoc {
    /// Position of the pinhole.
    pub origin: [f32; 3],
    /// Point at the centre of the image.
    pub target: [f32; 3],
    /// Up direction.
    pub up: [f32; 3],
    /// Horizontal field of view, degrees.
    pub fov_deg: f32,
    /// Whether left and right are exchanged, for scenes of renderers with a camera of other handedness.
    pub mirror: bool,
}

impl Default for CameraDoc {
    fn default() -> Self {
        Self { origin: [0.0, 0.0, 3.0], target: [0.0; 3], up: [0.0, 1.0, 0.0], fov_deg: 35.0, mirror: false }
    }
}

/// Image size in pixels.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FilmDoc {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
}

impl Default for FilmDoc {
    fn default() -> Self {
        Self { width: 960, height: 540 }
    }
}
