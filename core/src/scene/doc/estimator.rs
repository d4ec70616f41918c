//! Editable estimator: independent options of one method.

use super::Fault;
use crate::light::LightSelection;
use crate::math::SamplerKind;
use crate::spectrum::WavelengthSampling;
use serde::{Deserialize, Serialize};

/// Estimator of light transport and its options.
///
/// Costs of options are given as ratios to the default: look-ups of the medium per path, and relMSE at equal
/// samples. They were measured with Uni+NEE MIS (connections with NEE) on the embedded plume (chromatic), the
/// side-lit cloud and the back-lit cloud, at 96 × 96 pixels, 6 runs of 32 samples against 3000. `majorant
/// bench SCENE --set estimator.KEY=VALUE` repeats the measurement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct EstimatorDoc {
    /// Id of an entry of [`crate::estimator::REGISTRY`].
    pub id: String,
    /// Components of a path: wavelengths or RGB channels.
    pub mode: Mode,
    /// Correlation between the samples of a pixel.
    pub sampler: SamplerKind,
    /// Distribution of the hero wavelength in spectral mode.
    pub wavelengths: WavelengthSampling,
    /// Sampling of the distance to the next event.
    pub distances: DistanceSampling,
    /// Distribution of directions sampled in the medium.
    pub directions: DirectionSampling,
    /// Treatment of absorption at a collision.
    pub absorption: Absorption,
    /// MIS heuristics.
    pub heuristics: Heuristics,
    /// Representation of a path's contribution and densities in Uni+NEE MIS.
    pub bookkeeping: Bookkeeping,
    /// Event probabilities of spectral tracking.
    pub tracking: Tracking,
    /// Known bug of another renderer, injected into Uni+NEE MIS to demonstrate its effect.
    #[serde(skip_serializing_if = "is_right")]
    pub fault: Fault,
    /// Walk that samples the unidirectional contribution, where it is combined with connections.
    pub light_walk: LightWalk,
    /// Selection of the light for a connection.
    pub lights: LightSelection,
    /// Sampling of the direction towards the selected light.
    pub light_sampling: LightSampling,
    /// Estimator of a connection's transmittance, where no MIS weight needs its density: an id of
    /// [`crate::transmittance::TransmittanceKind`].
    pub transmittance: String,
    /// Maximum number of path segments between camera, scattering vertices and light: 1 is emission only, 2
    /// is single scattering. Absent: unlimited.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_depth: Option<u32>,
    /// Number of scattering vertices after which Russian roulette (unbiased) begins: a path survives with a
    /// probability equal to its throughput, clamped to 0.05 … 1. `None`, written `"never"`, disables it. From
    /// 16 on it costs nothing where absorption is low, and saves most of the work deep in a medium that
    /// absorbs a tenth.
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

/// Serialises a number of vertices or `"never"`. An absent key means the default, not never.
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

/// Components of a path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mode {
    /// Wavelengths from 360 to 830 nm, weighted by the CIE 1931 observer.
    #[default]
    Spectral,
    /// Three fixed components: red, green, blue.
    Rgb,
}

/// Sampling of the next event. All variants sample collisions with the majorant μ̄ and weight a path by the
/// densities of the events drawn, so all are unbiased and can be combined with other techniques by MIS.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DistanceSampling {
    /// Delta tracking: a collision is real with probability μt / μ̄ (Woodcock et al. 1965).
    #[default]
    Delta,
    /// Weighted delta tracking, in the sense of Galtier et al. 2013: a collision is real with probability
    /// √(μt / μ̄) and multiplies the weight by √(μt / μ̄). Fewer null collisions per event, but varying
    /// weights: relMSE ×3.8 on the plume, ×1.4 and ×2.4 on the clouds, with look-ups ×1.1 to 1.2. Included
    /// for comparison only.
    WeightedDelta,
    /// Decomposition tracking (Kutz et al. 2017, section 4.2): the medium is split into a control component
    /// with the extinction μc, the local lower bound, whose collisions are real and need no look-up, and a
    /// residual sampled by delta tracking. Saves all look-ups of free flights in a homogeneous medium, and 16
    /// % on the embedded cloud, where the lower bound is zero in cells at the surface.
    Decomposition,
}

/// Distribution of directions sampled in the medium.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DirectionSampling {
    /// The phase function, as in the papers.
    #[default]
    Phase,
    /// A mixture of the phase function and broad lobes towards the lights: wins where light comes from the
    /// side and scattering in a thick medium is strongly forward (the side-lit scene S2 of the tests). relMSE
    /// ×1.3 on plume and side-lit cloud, ×29 on the back-lit cloud; look-ups unchanged.
    TowardsLights,
    /// A mixture of the phase function and the phase function restricted to directions that can hit a light:
    /// wins where lights are large or in view and scattering is strongly forward. relMSE ×1.02 on the plume,
    /// ×1.3 on the side-lit, ×0.8 on the back-lit cloud.
    Product,
}

/// Walk that samples the unidirectional contribution in Uni+NEE MIS.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LightWalk {
    /// The walk that continues to the next vertex: it reaches a light if no event stops it.
    #[default]
    Fused,
    /// A separate walk along the same ray, before the walk to the next vertex (the report's algorithm 4, line
    /// 17). Same mean. Look-ups ×1.13 to 1.2, relMSE ×1.03 (plume) to 1.8 (back-lit): it wins nowhere.
    Separate,
}

/// Sampling of the direction towards the selected light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LightSampling {
    /// Uniform over the light, as in the papers.
    #[default]
    Emitter,
    /// Approximately proportional to the product of the light and the phase function: wins near large lights
    /// seen through strongly forward scattering. relMSE ×1.0 on the plume, ×0.9 on the side-lit cloud;
    /// look-ups ×0.9 on both clouds.
    Product,
}

/// Heuristics of multiple importance sampling (Veach 1997, section 9.2) for the two families of techniques
/// that Miller et al. 2019 combine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Heuristics {
    /// Heuristic among the components that could have been the hero.
    pub components: Heuristic,
    /// Heuristic between unidirectional sampling and next-event estimation.
    pub techniques: Heuristic,
}

/// MIS heuristic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Heuristic {
    /// Weights proportional to the densities; no other heuristic is much better, and some are much worse
    /// (Veach 1997, theorem 9.2).
    #[default]
    Balance,
    /// Weights proportional to the squared densities: sharper where one technique is good. Among components
    /// relMSE ×1.1 on the plume, between techniques ×1.0 to 1.02 on all three scenes.
    Power,
    /// All weight on the largest density. Among components relMSE ×2.2 on the plume, between techniques ×1.03
    /// to 1.35.
    Maximum,
    /// No combination: only the hero component contributes. Valid only among components. relMSE ×7 on the
    /// plume, ×3 and ×4 on the clouds, whose grey components no longer share one weight.
    HeroOnly,
}

/// Representation of the contribution f and the densities p of a path while it is traced (the report's
/// section 5). The image is the same as long as no number overflows; the cost differs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Bookkeeping {
    /// Quotients by the density with which the path was sampled: 3C numbers, any heuristic, no overflow. O(C)
    /// per event.
    #[default]
    Rescaled,
    /// Separate f and p in single precision, as printed in the report: overflows in dense media. Samples that
    /// overflow are counted and dropped, which is **biased**.
    #[serde(rename = "apart-f32")]
    ApartF32,
    /// Separate f and p in double precision: overflows later. O(C) per event; 0.7 to 1 of the paths per
    /// second.
    #[serde(rename = "apart-f64")]
    ApartF64,
    /// Miller's quotients p_i / f_j: 2C² numbers, balance heuristic only, no overflow (Miller et al. 2019,
    /// equations 26–30). O(C²) per event: 0.7 to 0.9 of the paths per second.
    Pairwise,
}

/// Event probabilities of spectral tracking at a collision (Kutz et al. 2017, section 5.1), by the statistic
/// of the coefficients that they are proportional to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tracking {
    /// Maximum over the components. On the embedded plume relMSE ×4.7 of the default's.
    Maximum,
    /// Average over the components: relMSE ×4.4.
    Average,
    /// Average over the components, weighted by the throughput of each; evaluates every component at each
    /// event.
    #[default]
    History,
}

/// Treatment of absorption at a collision.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Absorption {
    /// Absorption is sampled as an event that ends the path, as in the report and in Miller et al. 2019. At
    /// albedos near 1 look-ups ×0.95 to 0.97, relMSE ×1.01 to 1.14; the loss grows with absorption (figure
    /// 4).
    Analogue,
    /// Absorption is never sampled; scattering multiplies the weight by the albedo.
    #[default]
    Weighted,
    /// As [`Self::Weighted`], with Russian roulette from the first vertex on: after scattering and the
    /// connection to a light, a path survives with about the probability that it was not absorbed. Ends paths
    /// as often as the report's absorption events, but only after the vertex has been connected: relMSE ×1.0
    /// to 1.1, look-ups ×0.96 to 1.0.
    Roulette,
}
