//! Editable lights.

use crate::spectrum::SpectrumDoc;
use serde::{Deserialize, Serialize};

fn one() -> SpectrumDoc {
    SpectrumDoc::Constant(1.0)
}
fn unit() -> f32 {
    1.0
}
fn shown() -> bool {
    true
}
fn solar_diameter() -> f32 {
    0.53
}
fn world_up() -> [f32; 3] {
    [0.0, 1.0, 0.0]
}

/// Light source. Radiances are per scene-unit² and steradian, each multiplied by `scale`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum LightDoc {
    /// A rectangle that emits on the side facing `target`; its back is black. It blocks light.
    Rectangle {
        /// Centre.
        center: [f32; 3],
        /// Point that the emitting side faces.
        target: [f32; 3],
        /// Direction of the height, projected onto the rectangle.
        #[serde(default = "world_up")]
        up: [f32; 3],
        /// Width and height.
        size: [f32; 2],
        /// Emitted radiance.
        #[serde(default = "one")]
        radiance: SpectrumDoc,
        /// Multiplies the radiance.
        #[serde(default = "unit")]
        scale: f32,
        /// Visibility to camera rays.
        #[serde(default = "shown")]
        visible: bool,
        /// Whether the light is part of the scene.
        #[serde(default = "shown")]
        enabled: bool,
    },
    /// A sphere that emits outwards and blocks light.
    Sphere {
        /// Centre.
        center: [f32; 3],
        /// Radius.
        radius: f32,
        /// Emitted radiance.
        #[serde(default = "one")]
        radiance: SpectrumDoc,
        /// Multiplies the radiance.
        #[serde(default = "unit")]
        scale: f32,
        /// Visibility to camera rays.
        #[serde(default = "shown")]
        visible: bool,
        /// Whether the light is part of the scene.
        #[serde(default = "shown")]
        enabled: bool,
    },
    /// A distant disc: all light arrives within half its angular diameter of one direction.
    Sun {
        /// Direction from the scene to the sun.
        toward: [f32; 3],
        /// Angular diameter, degrees.
        #[serde(default = "solar_diameter")]
        angular_diameter_deg: f32,
        /// Irradiance on a surface that faces the sun.
        #[serde(default = "one")]
        irradiance: SpectrumDoc,
        /// Multiplies the irradiance.
        #[serde(default = "unit")]
        scale: f32,
        /// Visibility to camera rays.
        #[serde(default = "shown")]
        visible: bool,
        /// Whether the light is part of the scene.
        #[serde(default = "shown")]
        enabled: bool,
    },
    /// Constant radiance from every direction.
    Environment {
        /// Incident radiance.
        #[serde(default = "one")]
        radiance: SpectrumDoc,
        /// Multiplies the radiance.
        #[serde(default = "unit")]
        scale: f32,
        /// Visibility to camera rays.
        #[serde(default = "shown")]
        visible: bool,
        /// Whether the light is part of the scene.
        #[serde(default = "shown")]
        enabled: bool,
    },
    /// Radiance by direction from an equirectangular EXR or HDR image (linear sRGB; top row is +y).
    EnvironmentMap {
        /// Image file, relative to the scene file.
        file: String,
        /// Rotation about the y axis, degrees.
        #[serde(default)]
        rotate_deg: f32,
        /// Multiplies the radiance.
        #[serde(default = "unit")]
        scale: f32,
        /// Visibility to camera rays.
        #[serde(default = "shown")]
        visible: bool,
        /// Whether the light is part of the scene.
        #[serde(default = "shown")]
        enabled: bool,
    },
}

impl Default for LightDoc {
    fn default() -> Self {
        Self::Environment { radiance: one(), scale: 1.0, visible: true, enabled: true }
    }
}

impl LightDoc {
    /// One light of each kind with its display name: the entries of "Add light".
    #[must_use]
    pub fn templates() -> Vec<(&'static str, Self)> {
        vec![
            (
                "Rectangle",
                Self::Rectangle {
                    center: [1.5, 1.5, 0.0],
                    target: [0.0; 3],
                    up: world_up(),
                    size: [0.6, 0.6],
                    radiance: one(),
                    scale: 10.0,
                    visible: true,
                    enabled: true,
                },
            ),
            (
                "Sphere",
                Self::Sphere {
                    center: [1.2, 1.0, 0.6],
                    radius: 0.15,
                    radiance: one(),
                    scale: 30.0,
                    visible: true,
                    enabled: true,
                },
            ),
            (
                "Sun",
                Self::Sun {
                    toward: [0.6, 0.7, 0.4],
                    angular_diameter_deg: solar_diameter(),
                    irradiance: one(),
                    scale: 3.0,
                    visible: true,
                    enabled: true,
                },
            ),
            ("Environment", Self::Environment { radiance: one(), scale: 0.3, visible: true, enabled: true }),
            (
                "Environment map",
                Self::EnvironmentMap {
                    file: String::new(),
                    rotate_deg: 0.0,
                    scale: 1.0,
                    visible: true,
                    enabled: true,
                },
            ),
        ]
    }

    /// Display name of the kind.
    #[must_use]
    pub fn kind_name(&self) -> &'static str {
        match self {
            Self::Rectangle { .. } => "Rectangle",
            Self::Sphere { .. } => "Sphere",
            Self::Sun { .. } => "Sun",
            Self::Environment { .. } => "Environment",
            Self::EnvironmentMap { .. } => "Environment map",
        }
    }

    /// Returns whether camera rays see the light directly.
    #[must_use]
    pub fn visible(&self) -> bool {
        match self {
            Self::Rectangle { visible, .. }
            | Self::Sphere { visible, .. }
            | Self::Sun { visible, .. }
            | Self::Environment { visible, .. }
            | Self::EnvironmentMap { visible, .. } => *visible,
        }
    }

    /// Returns whether the light is part of the scene.
    #[must_use]
    pub fn enabled(&self) -> bool {
        match self {
            Self::Rectangle { enabled, .. }
            | Self::Sphere { enabled, .. }
            | Self::Sun { enabled, .. }
            | Self::Environment { enabled, .. }
            | Self::EnvironmentMap { enabled, .. } => *enabled,
        }
    }

    /// Whether the light is part of the scene, to be edited.
    pub fn enabled_mut(&mut self) -> &mut bool {
        match self {
            Self::Rectangle { enabled, .. }
            | Self::Sphere { enabled, .. }
            | Self::Sun { enabled, .. }
            | Self::Environment { enabled, .. }
            | Self::EnvironmentMap { enabled, .. } => enabled,
        }
    }
}
