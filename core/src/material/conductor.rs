//! Metals: reflection by Fresnel's equations with a complex refractive index, smooth or by GGX microfacets.
//!
//! Light that is reflected more than once between microfacets is not accounted for, so that rough metals are
//! somewhat darker than real ones.

use super::Ggx;
use crate::spectrum::Spectrum;
use serde::{Deserialize, Serialize};

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

/// A metal by name. Its refractive index is that of the measurements in Palik 1985, "Handbook of Optical Constants of
/// Solids", as tabulated with pbrt-v4, every 40 nm, or 20 nm where it varies fast.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs, reason = "the names say all")]
pub enum Metal {
    Aluminium,
    Copper,
    Gold,
    Silver,
}

impl Metal {
    /// All metals, in display order.
    pub const ALL: [Self; 4] = [Self::Aluminium, Self::Copper, Self::Gold, Self::Silver];

    /// Real part of the refractive index, `nm:value`.
    #[must_use]
    pub fn eta(self) -> &'static str {
        match self {
            Self::Aluminium => {
                "380:0.442, 420:0.539, 460:0.646, 500:0.769, 540:0.916, 580:1.097, 620:1.3, 660:1.536, 700:1.837, 740:2.27, 760:2.49"
            }
            Self::Copper => {
                "380:1.206, 420:1.178, 460:1.16, 500:1.134, 540:1.033, 560:0.861, 580:0.603, 600:0.39, 620:0.272, 640:0.227, 660:0.212, 700:0.215, 760:0.241"
            }
            Self::Gold => {
                "380:1.688, 420:1.628, 440:1.574, 460:1.419, 480:1.19, 500:0.851, 520:0.572, 540:0.398, 560:0.317, 580:0.26, 620:0.194, 660:0.164, 700:0.16, 760:0.172"
            }
            Self::Silver => {
                "380:0.199, 420:0.167, 460:0.143, 500:0.13, 540:0.129, 580:0.12, 620:0.131, 660:0.14, 700:0.142, 760:0.145"
            }
        }
    }

    /// Imaginary part of the refractive index, `nm:value`.
    #[must_use]
    pub fn k(self) -> &'static str {
        match self {
            Self::Aluminium => {
                "380:4.615, 420:5.105, 460:5.59, 500:6.078, 540:6.562, 580:7.036, 620:7.481, 660:7.9, 700:8.312, 740:8.594, 760:8.613"
            }
            Self::Copper => {
                "380:2.094, 420:2.248, 460:2.436, 500:2.574, 540:2.582, 560:2.593, 580:2.71, 600:2.943, 620:3.241, 640:3.511, 660:3.752, 700:4.158, 760:4.692"
            }
            Self::Gold => {
                "380:1.918, 420:1.952, 440:1.911, 460:1.843, 480:1.796, 500:1.887, 520:2.184, 540:2.555, 560:2.837, 580:2.948, 620:3.06, 660:3.275, 700:3.964, 760:4.701"
            }
            Self::Silver => {
                "380:1.718, 420:2.183, 460:2.567, 500:2.918, 540:3.258, 580:3.58, 620:3.881, 660:4.21, 700:4.523, 760:4.975"
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::SpectrumDoc;

    #[test]
    fn constants_are_points_over_the_visible_range() {
        for metal in Metal::ALL {
            for points in [metal.eta(), metal.k()] {
                let points = SpectrumDoc::parse_points(points).unwrap();
                assert!(points[0].lambda_nm <= 380.0 && points[points.len() - 1].lambda_nm >= 760.0);
            }
        }
    }
}
