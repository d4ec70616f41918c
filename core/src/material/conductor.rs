//! Metals: reflection by Fresnel's equations with a complex refractive index, smooth or by GGX microfacets.
//!
//! Light that is reflected more than once between microfacets is not accounted for, so that rough metals are
//! somewhat darker than real ones.

use super::Ggx;
use crate::spectrum::Spectrum;

/// Conductor.
#[derive(Clone, Debug)]
pub struct Conductor {
    /// Real part of the refractive index.
    pub eta: Spectrum,
    /// Imaginary part of the refractive index.
    pub k: Spectrum,
    /// Distribution of microfacets; `None` for a smooth surface.
    pub ggx: Option<Ggx>,
}

/// Optical constants of a metal.
#[derive(Clone, Copy, Debug)]
pub struct Metal {
    /// Id in scene files.
    pub id: &'static str,
    /// Display name.
    pub name: &'static str,
    /// Real part of the refractive index, `nm:value`.
    pub eta: &'static str,
    /// Imaginary part of the refractive index, `nm:value`.
    pub k: &'static str,
}

/// Metals by name. Values every 40 nm (gold and copper: every 20 nm where they vary) of the measurements in
/// Palik 1985, "Handbook of Optical Constants of Solids", as tabulated with pbrt-v4.
pub const CONDUCTORS: &[Metal] = &[
    Metal {
        id: "aluminium",
        name: "Aluminium",
        eta: "380:0.442, 420:0.539, 460:0.646, 500:0.769, 540:0.916, 580:1.097, 620:1.3, 660:1.536, 700:1.837, 740:2.27, 760:2.49",
        k: "380:4.615, 420:5.105, 460:5.59, 500:6.078, 540:6.562, 580:7.036, 620:7.481, 660:7.9, 700:8.312, 740:8.594, 760:8.613",
    },
    Metal {
        id: "copper",
        name: "Copper",
        eta: "380:1.206, 420:1.178, 460:1.16, 500:1.134, 540:1.033, 560:0.861, 580:0.603, 600:0.39, 620:0.272, 640:0.227, 660:0.212, 700:0.215, 760:0.241",
        k: "380:2.094, 420:2.248, 460:2.436, 500:2.574, 540:2.582, 560:2.593, 580:2.71, 600:2.943, 620:3.241, 640:3.511, 660:3.752, 700:4.158, 760:4.692",
    },
    Metal {
        id: "gold",
        name: "Gold",
        eta: "380:1.688, 420:1.628, 440:1.574, 460:1.419, 480:1.19, 500:0.851, 520:0.572, 540:0.398, 560:0.317, 580:0.26, 620:0.194, 660:0.164, 700:0.16, 760:0.172",
        k: "380:1.918, 420:1.952, 440:1.911, 460:1.843, 480:1.796, 500:1.887, 520:2.184, 540:2.555, 560:2.837, 580:2.948, 620:3.06, 660:3.275, 700:3.964, 760:4.701",
    },
    Metal {
        id: "silver",
        name: "Silver",
        eta: "380:0.199, 420:0.167, 460:0.143, 500:0.13, 540:0.129, 580:0.12, 620:0.131, 660:0.14, 700:0.142, 760:0.145",
        k: "380:1.718, 420:2.183, 460:2.567, 500:2.918, 540:3.258, 580:3.58, 620:3.881, 660:4.21, 700:4.523, 760:4.975",
    },
];
