//! The estimator as edited: independent axes of one method.

use super::Fault;
use crate::light::LightSelection;
use crate::math::SamplerKind;
use crate::spectrum::WavelengthSampling;
use serde::{Deserialize, Serialize};

/// How light transport is estimated.
///
/// What its options cost is given as ratios to the default, measured with Uni+NEE MIS (connections by NEE) on the embedded
/// plume (chromatic), side-lit and back-lit cloud, at 96 × 96 pixels, 6 runs of 32 samples against 3000: look-ups of the medium per
/// path, and relMSE at equal samples. `majorant bench SCENE --set estimator.KEY=VALUE` repeats it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct EstimatorDoc {
    /// An id of [`crate::estimator::REGISTRY`].
    pub id: String,
    /// What a path's components stand for.
    pub mode: Mode,
    /// How the samples of a pixel relate to each other.
    pub sampler: SamplerKind,
    /// How spectral mode draws the hero's wavelength.
    pub wavelengths: WavelengthSampling,
    /// How distances to the next event are drawn.
    pub distances: DistanceSampling,
    /// What directions in the medium are drawn from.
    pub directions: DirectionSampling,
    /// What happens at a collision that may absorb.
    pub absorption: Absorption,
    /// How the ways in which a path could have been made share it.
    pub heuristics: Heuristics,
    /// How Uni+NEE MIS keeps what a path is worth and how likely it is.
    pub bookkeeping: Bookkeeping,
    /// How spectral tracking draws events.
    pub tracking: Tracking,
    /// A mistake of another renderer, planted in Uni+NEE MIS to be found.
    #[serde(skip_serializing_if = "is_right")]
    pub fault: Fault,
    /// Which walk meets the light that unidirectional sampling adds, where it shares paths with connections.
    pub light_walk: LightWalk,
    /// Which light a connection goes to.
    pub lights: LightSelection,
    /// How a connection draws a direction towards its light.
    pub light_sampling: LightSampling,
    /// How the transmittance of a connection is estimated, where no MIS needs its density: an id of
    /// [`crate::transmittance::TransmittanceKind`].
    pub transmittance: String,
    /// Most segments of a path between camera, scattering vertices and light: 1 is emission only, 2 is
    /// single scattering. Absent: unlimited.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_depth: Option<u32>,
    /// Russian roulette, unbiased, after this many scattering vertices: a path goes on with a probability
    /// that is its throughput, between 0.05 and 1. `None`, written `"never"`: not at all. From 16 on it costs
    /// nothing where little is absorbed, and spares most of the work deep in a medium that absorbs a tenth.
    #[serde(with = "roulette")]
    pub roulette_depth: Option<u32>,
}

impl Default for EstimatorDoc {
    fn default() -> Self {
        Self {
            id: "uni-nee-mis".into(),
            mode: Mode::Spectral,
            sampler: SamplerKind::Independent,
            wavelengths: WavelengthSampling::Sensor,
            distances: DistanceSampling::Delta,
            directions: DirectionSampling::Phase,
            absorption: Absorption::Weighted,
            heuristics: Heuristics::default(),
            bookkeeping: Bookkeeping::Rescaled,
            tracking: Tracking::History,
            fault: Fault::None,
            light_walk: LightWalk::Fused,
            lights: LightSelection::Uniform,
            light_sampling: LightSampling::Emitter,
            transmittance: "ratio-hero".into(),
            max_depth: None,
            roulette_depth: Some(16),
        }
    }
}

fn is_right(fault: &Fault) -> bool {
    *fault == Fault::None
}

/// A number of vertices, or `"never"`: absent means the default, which is not never.
mod roulette {
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

    #[derive(Deserialize)]
    #[serde(untagged, expecting = "a number of scattering vertices, or \"never\"")]
    enum Written {
        After(u32),
        Word(String),
    }

    pub fn serialize<S: Serializer>(depth: &Option<u32>, to: S) -> Result<S::Ok, S::Error> {
        match depth {
            Some(vertices) => vertices.serialize(to),
            None => "never".serialize(to),
        }
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<u32>, D::Error> {
        match Written::deserialize(from)? {
            Written::After(vertices) => Ok(Some(vertices)),
            Written::Word(word) if word == "never" => Ok(None),
            Written::Word(word) => {
                Err(D::Error::custom(format!("{word:?} is neither a number of vertices nor \"never\"")))
            }
        }
    }
}

/// What a path's components stand for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mode {
    /// Wavelengths from 360 to 830 nm, seen by the CIE 1931 observer.
    #[default]
    Spectral,
    /// Three fixed components: red, green, blue.
    Rgb,
}

/// How a path finds its next event: in all three it collides with the majorant μ̄ and is weighted by the densities of
/// what was drawn, so that all are unbiased and any of them can be combined with other techniques.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DistanceSampling {
    /// A collision is real with probability μt / μ̄ (delta tracking; Woodcock et al. 1965).
    #[default]
    Delta,
    /// A collision is real with probability √(μt / μ̄), and weighs √(μt / μ̄) less (weighted delta tracking, in the
    /// sense of Galtier et al. 2013): fewer null collisions per event, weights that vary. relMSE ×3.8 on the plume, ×1.4 and
    /// ×2.4 on the clouds, with look-ups ×1.1 to 1.2: a foil.
    WeightedDelta,
    /// The medium as two: a control with the extinction μc, the local lower bound, whose collisions are real and cost no
    /// look-up, and the rest, tracked as by delta (Kutz et al. 2017, section 4.2). Spares all look-ups of free flights in
    /// a homogeneous medium, and 16 % on the embedded cloud, whose cells at the surface have a lower bound of zero.
    Decomposition,
}

/// What directions in the medium are drawn from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DirectionSampling {
    /// The phase function, as in the papers.
    #[default]
    Phase,
    /// A mixture of the phase function and of broad lobes towards the lights: wins where light comes from the
    /// side and scattering is sharply forward through thick media (the side-lit scene S2 of the tests). relMSE ×1.3 on
    /// plume and side-lit cloud, ×29 where light shines through (back-lit); look-ups as before.
    TowardsLights,
    /// A mixture of the phase function and of its part that can meet the lights: wins where lights are large or in view,
    /// and scattering is sharply forward. relMSE ×1.02 on the plume, ×1.3 on the side-lit, ×0.8 on the back-lit cloud.
    Product,
}

/// Which walk meets the light that unidirectional sampling adds, in Uni+NEE MIS.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LightWalk {
    /// The one that goes on to the next vertex, if it meets no other.
    #[default]
    Fused,
    /// One of its own along the same ray, before that is walked again for the next vertex (the report's algorithm 4,
    /// line 17): the same mean. Look-ups ×1.13 to 1.2, relMSE ×1.03 (plume) to 1.8 (back-lit): it wins nowhere.
    Separate,
}

/// How a connection draws a direction towards its light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LightSampling {
    /// Evenly over the light, as in the papers.
    #[default]
    Emitter,
    /// In proportion to the product with the phase function, nearly: wins beside large lights seen through sharply
    /// forward scattering. relMSE ×1.0 on the plume, ×0.9 on the side-lit cloud; look-ups ×0.9 on both clouds.
    Product,
}

/// How multiple importance sampling divides a path among all that could have made it (Veach 1997, section 9.2), for
/// the two families that Miller et al. 2019 combine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Heuristics {
    /// Among the components that could have been the hero.
    pub components: Heuristic,
    /// Between unidirectional sampling and next-event estimation.
    pub techniques: Heuristic,
}

/// A heuristic of multiple importance sampling.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Heuristic {
    /// In proportion to the densities; no other is much better, and some are much worse (Veach 1997, theorem 9.2).
    #[default]
    Balance,
    /// In proportion to their squares: sharper where one of them is good. Among components relMSE ×1.1 on the plume,
    /// between techniques ×1.0 to 1.02 on all three.
    Power,
    /// All to the largest density. Among components relMSE ×2.2 on the plume, between techniques ×1.03 to 1.35.
    Maximum,
    /// No combination: components other than the hero are left out. Only among components. relMSE ×7 on the plume, ×3 and ×4
    /// on the clouds, whose grey loses its shared weight.
    HeroOnly,
}

/// How the contribution f and the densities p of a path are kept while it grows (the report's section 5). The image is
/// the same as long as no number leaves its range; the cost is not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Bookkeeping {
    /// As quotients by the density with which the path was made: 3C numbers, any heuristic, no overflow. O(C) per event.
    #[default]
    Rescaled,
    /// f and p apart in single precision, as printed in the report: overflows in dense media. What overflows is
    /// counted and left out, which is **biased**.
    #[serde(rename = "apart-f32")]
    ApartF32,
    /// f and p apart in double precision: overflows later. O(C) per event; 0.7 to 1 of the paths per second.
    #[serde(rename = "apart-f64")]
    ApartF64,
    /// Miller's quotients p_i / f_j: 2C² numbers, the balance heuristic only, no overflow (Miller et al. 2019, equations
    /// 26–30). O(C²) per event: 0.7 to 0.9 of the paths per second.
    Pairwise,
}

/// How spectral tracking draws the event at a collision (Kutz et al. 2017, section 5.1): in proportion to what
/// of its coefficients.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tracking {
    /// The largest over components. On the embedded plume relMSE ×4.7 of the default's.
    Maximum,
    /// Their average: relMSE ×4.4.
    Average,
    /// Their average, weighted by what the path is worth at each component; costs its look at every component per event.
    #[default]
    History,
}

/// What happens at a collision in a medium that absorbs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Absorption {
    /// Absorption is an event that ends the path, as in the report and in Miller et al. 2019. At albedos near 1 look-ups
    /// ×0.95 to 0.97, relMSE ×1.01 to 1.14; the more is absorbed, the more it loses (figure 4).
    Analogue,
    /// Absorption is never drawn; scattering carries the albedo as a weight.
    #[default]
    Weighted,
    /// As [`Self::Weighted`], with Russian roulette from the first vertex on: where a path has scattered and light
    /// has been connected, it goes on with about the probability that it was not absorbed. Ends paths as often as
    /// the report's events do, but after each vertex has had its light: relMSE ×1.0 to 1.1, look-ups ×0.96 to 1.0.
    Roulette,
}
