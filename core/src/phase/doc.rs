//! Phase functions as edited.

use serde::{Deserialize, Serialize};

// Variants without parameters are written with braces: serde then refuses unknown keys in them too.

/// Phase function, by the cosine between the directions of propagation before and after.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum PhaseDoc {
    /// The same in every direction.
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
    /// Molecules.
    Rayleigh {},
}

impl Default for PhaseDoc {
    fn default() -> Self {
        Self::Isotropic {}
    }
}

impl PhaseDoc {
    /// One of each kind, with its name: where a picker starts, and what is tested.
    #[must_use]
    pub fn templates() -> Vec<(&'static str, Self)> {
        vec![
            ("Isotropic", Self::Isotropic {}),
            ("Henyey–Greenstein", Self::HenyeyGreenstein { g: 0.5 }),
            ("Two lobes", Self::TwoLobe { g_forward: 0.8, g_backward: -0.3, forward: 0.7 }),
            ("Rayleigh", Self::Rayleigh {}),
        ]
    }
}
