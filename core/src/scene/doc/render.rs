//! Sampling limits as edited.

use serde::{Deserialize, Serialize};

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
