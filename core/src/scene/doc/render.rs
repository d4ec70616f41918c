//! Estimator and sampling limits as edited.

use crate::math::SamplerKind;
use crate::spectrum::WavelengthSampling;
use serde::{Deserialize, Serialize};

/// How light transport is estimated.
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
    /// What directions in the medium are drawn from.
    pub directions: DirectionSampling,
    /// What happens at a collision that may absorb.
    pub absorption: Absorption,
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
            directions: DirectionSampling::Phase,
            absorption: Absorption::Weighted,
            max_depth: None,
            roulette_depth: Some(16),
        }
    }
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

/// What directions in the medium are drawn from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DirectionSampling {
    /// The phase function, as in the papers.
    #[default]
    Phase,
    /// A mixture of the phase function and of broad lobes towards the lights: wins where light comes from the
    /// side and scattering is sharply forward.
    TowardsLights,
}

/// What happens at a collision in a medium that absorbs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Absorption {
    /// Absorption is an event that ends the path, as in the report and in Miller et al. 2019.
    Analogue,
    /// Absorption is never drawn; scattering carries the albedo as a weight.
    #[default]
    Weighted,
}

/// When to stop, which random numbers, how many threads.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RenderDoc {
    /// Stop after this many samples per pixel. Absent: no limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spp: Option<u32>,
    /// Stop after this many seconds of rendering. Absent: no limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f32>,
    /// Stop after this many CPU seconds of path tracing, all workers together. Absent: no limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cpu_seconds: Option<f32>,
    /// Stop when the root mean square of the standard error is this share of the image's mean. Absent: no limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relative_error: Option<f32>,
    /// Selects the random numbers; the image depends on nothing else that is random.
    pub seed: u64,
    /// Worker threads. Absent: one per core.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub threads: Option<usize>,
}

/// When a render stops: at whichever limit comes first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// Samples per pixel.
    pub spp: Option<u32>,
    /// Seconds of rendering.
    pub seconds: Option<f32>,
    /// CPU seconds of path tracing.
    pub cpu_seconds: Option<f32>,
    /// Standard error as a share of the mean.
    pub relative_error: Option<f32>,
}

impl Limits {
    /// Stops after this many samples per pixel.
    #[must_use]
    pub fn samples(spp: u32) -> Self {
        Self { spp: Some(spp), ..Self::default() }
    }

    /// Whether a render would never end.
    #[must_use]
    pub fn are_none(&self) -> bool {
        *self == Self::default()
    }
}

impl RenderDoc {
    /// When to stop.
    #[must_use]
    pub fn limits(&self) -> Limits {
        let Self { spp, seconds, cpu_seconds, relative_error, .. } = *self;
        Limits { spp, seconds, cpu_seconds, relative_error }
    }

    /// Stops at these limits and no others.
    pub fn set_limits(&mut self, limits: Limits) {
        let Limits { spp, seconds, cpu_seconds, relative_error } = limits;
        (self.spp, self.seconds, self.cpu_seconds, self.relative_error) =
            (spp, seconds, cpu_seconds, relative_error);
    }
}
