//! Phase functions as edited in a scene document.

use super::table::Angle;
use serde::{Deserialize, Serialize};

// Variants without parameters are written with braces: serde then refuses unknown keys in them too.

/// Phase function of the cosine between the directions of propagation before and after scattering.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum PhaseDoc {
    /// Uniform over the sphere.
    Isotropic {},
    /// One Henyey–Greenstein lobe.
    HenyeyGreenstein {
        /// Mean cosine, −1 to 1 exclusive; positive is forward.
        g: f32,
    },
    /// Two Henyey–Greenstein lobes.
    TwoLobe {
        /// Mean cosine of the first lobe.
        g_forward: f32,
        /// Mean cosine of the second lobe.
        g_backward: f32,
        /// Share of the first lobe, 0 to 1.
        forward: f32,
    },
    /// Rayleigh scattering by molecules.
    Rayleigh {},
    /// Draine's phase function for dust: a Henyey–Greenstein lobe times 1 + α cos² θ.
    Draine {
        /// Sharpness and direction of the lobe, −1 to 1 exclusive.
        g: f32,
        /// Weight of cos² θ; 0 is Henyey–Greenstein, 1 Cornette and Shanks.
        alpha: f32,
    },
    /// Approximate Mie scattering by water droplets in visible light.
    Mie {
        /// Diameter of the droplets in micrometres, up to 50.
        diameter_um: f32,
    },
    /// Table of points, linear in cos θ between them and scaled to integrate to 1.
    Tabulated {
        /// Meaning of the points' first numbers.
        #[serde(default)]
        angle: Angle,
        /// Points in order of increasing angle value: angle and phase function value.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        points: Vec<[f32; 2]>,
        /// Text file with the points, in place of `points`; relative to the scene file.
        #[serde(default, skip_serializing_if = "String::is_empty")]
        file: String,
    },
}

impl Default for PhaseDoc {
    fn default() -> Self {
        Self::Isotropic {}
    }
}

/// Names and description of a kind of phase function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kind {
    /// Display name.
    pub name: &'static str,
    /// Short display name.
    pub short: &'static str,
    /// Equation and source.
    pub about: &'static str,
}

/// Numeric parameter of a kind of phase function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Key in a scene file.
    pub key: &'static str,
    /// Display name.
    pub label: &'static str,
    /// Unit; empty if there is none.
    pub unit: &'static str,
    /// Range of valid values.
    pub range: [f32; 2],
    /// Whether it is edited by factors rather than by steps.
    pub logarithmic: bool,
    /// Description.
    pub about: &'static str,
}

/// Largest |g|; closer to 1 a lobe is too narrow for single precision.
const G_MAX: f32 = 0.999;

const fn g(key: &'static str, label: &'static str, about: &'static str) -> Parameter {
    Parameter { key, label, unit: "", range: [-G_MAX, G_MAX], logarithmic: false, about }
}

const MEAN: &str = "Mean cosine of the scattering angle, −1 to 1; positive is forward";
static G: Parameter = g("g", "g", MEAN);
static G_FORWARD: Parameter = g("g_forward", "First g", MEAN);
static G_BACKWARD: Parameter = g("g_backward", "Second g", MEAN);
static FORWARD: Parameter = Parameter {
    key: "forward",
    label: "Share of first",
    unit: "",
    range: [0.0, 1.0],
    logarithmic: false,
    about: "p = share · HG(first g) + (1 − share) · HG(second g)",
};
static G_DRAINE: Parameter = g(
    "g",
    "g",
    "Sharpness of the lobe, −1 to 1; positive is forward. The mean cosine is \
     g (1 + α (3 + 2 g²)/5) / (1 + α (1 + 2 g²)/3)",
);
static ALPHA: Parameter = Parameter {
    key: "alpha",
    label: "α",
    unit: "",
    range: [0.0, 1000.0],
    logarithmic: true,
    about: "Weight of cos² θ: 0 is Henyey–Greenstein, 1 is Cornette and Shanks, and with g = 0 Rayleigh",
};
static DIAMETER_UM: Parameter = Parameter {
    key: "diameter_um",
    label: "Diameter",
    unit: "µm",
    range: [0.001, 50.0],
    logarithmic: true,
    about: "Diameter of the droplets: haze below 1 µm, fog and clouds 5 to 50 µm",
};

impl PhaseDoc {
    /// One phase function of each kind: initial values of a picker, and test cases.
    #[must_use]
    pub fn templates() -> Vec<Self> {
        vec![
            Self::Isotropic {},
            Self::HenyeyGreenstein { g: 0.5 },
            Self::TwoLobe { g_forward: 0.8, g_backward: -0.3, forward: 0.7 },
            Self::Rayleigh {},
            Self::Draine { g: 0.5, alpha: 1.0 },
            Self::Mie { diameter_um: 10.0 },
            Self::Tabulated {
                angle: Angle::Degrees,
                points: vec![
                    [0.0, 20.0],
                    [20.0, 3.0],
                    [60.0, 0.4],
                    [120.0, 0.15],
                    [140.0, 0.5],
                    [180.0, 0.3],
                ],
                file: String::new(),
            },
        ]
    }

    /// Names and description of the kind.
    #[must_use]
    pub fn kind(&self) -> Kind {
        let [name, short, about] = match self {
            Self::Isotropic {} => ["Isotropic", "Isotropic", "p = 1 / 4π"],
            Self::HenyeyGreenstein { .. } => [
                "Henyey–Greenstein",
                "HG",
                "p = (1 − g²) / 4π (1 + g² − 2 g cos θ)^1.5. Henyey and Greenstein 1941",
            ],
            Self::TwoLobe { .. } => {
                ["Two lobes", "Two lobes", "Two Henyey–Greenstein lobes: p = w HG(g₁) + (1 − w) HG(g₂)"]
            }
            Self::Rayleigh {} => ["Rayleigh", "Rayleigh", "Molecules: p = 3 (1 + cos² θ) / 16π"],
            Self::Draine { .. } => [
                "Draine",
                "Draine",
                "Dust: Henyey–Greenstein times (1 + α cos² θ) / (1 + α (1 + 2 g²)/3). Draine 2003, \
                 Scattering by Interstellar Dust Grains",
            ],
            Self::Mie { .. } => [
                "Mie, approximate",
                "Mie",
                "Droplets of water in visible light: a Henyey–Greenstein and a Draine lobe fitted to Lorenz–Mie \
                 theory. Jendersie and d'Eon 2023, An Approximate Mie Scattering Function for Fog and Cloud Rendering",
            ],
            Self::Tabulated { .. } => [
                "Tabulated",
                "Table",
                "User-defined points, linear in cos θ between them, scaled to integrate to 1",
            ],
        };
        Kind { name, short, about }
    }

    /// Parameters and their values, in order.
    #[must_use]
    pub fn parameters(&self) -> Vec<(&'static Parameter, f32)> {
        self.clone().parameters_mut().into_iter().map(|(parameter, value)| (parameter, *value)).collect()
    }

    /// Parameters and their values, in order, for editing.
    #[must_use]
    pub fn parameters_mut(&mut self) -> Vec<(&'static Parameter, &mut f32)> {
        match self {
            Self::Isotropic {} | Self::Rayleigh {} | Self::Tabulated { .. } => Vec::new(),
            Self::HenyeyGreenstein { g } => vec![(&G, g)],
            Self::TwoLobe { g_forward, g_backward, forward } => {
                vec![(&G_FORWARD, g_forward), (&G_BACKWARD, g_backward), (&FORWARD, forward)]
            }
            Self::Draine { g, alpha } => vec![(&G_DRAINE, g), (&ALPHA, alpha)],
            Self::Mie { diameter_um } => vec![(&DIAMETER_UM, diameter_um)],
        }
    }
}
