//! Editable stopping limits, seed and number of threads.

use serde::{Deserialize, Serialize};

/// Stopping limits, seed and number of threads.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RenderDoc {
    /// Maximum number of samples per pixel. Absent: no limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spp: Option<u64>,
    /// Maximum rendering time in seconds. Absent: no limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f32>,
    /// Maximum CPU seconds of path tracing, summed over all worker threads. Absent: no limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cpu_seconds: Option<f32>,
    /// Target for the root mean square of the standard error, as a fraction of the image's mean. Absent: no
    /// limit.
    ///
    /// Checked after 16, 23, 32, 45, … samples per pixel, a factor of √2 apart. The target has to be met
    /// twice in succession, and the means of the first and second half of the samples have to agree. Even so,
    /// an image is stopped early where it happens to be too dark: rare, bright paths are missing from the
    /// mean and from the error alike. A fixed number of samples has no such bias. As the only limit, it stops
    /// an image that is black or has no finite value after 256 samples, and reports it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relative_error: Option<f32>,
    /// Seed of the random numbers; nothing else in the image is random.
    pub seed: u64,
    /// Number of worker threads. Absent: one per core.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub threads: Option<usize>,
}

/// Stopping limits of a render; the first one reached applies.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// Samples per pixel.
    pub spp: Option<u64>,
    /// Seconds of rendering.
    pub seconds: Option<f32>,
    /// CPU seconds of path tracing.
    pub cpu_seconds: Option<f32>,
    /// Standard error as a fraction of the mean.
    pub relative_error: Option<f32>,
}

impl Limits {
    /// Largest number of samples that a scene file can hold: its integers are signed 64-bit.
    pub const MOST_SAMPLES: u64 = i64::MAX as u64;

    /// Limit of this many samples per pixel only.
    #[must_use]
    pub fn samples(spp: u64) -> Self {
        Self { spp: Some(spp), ..Self::default() }
    }

    /// Returns whether no limit is set, so that a render would never end.
    #[must_use]
    pub fn are_none(&self) -> bool {
        *self == Self::default()
    }
}

impl RenderDoc {
    /// Stopping limits.
    #[must_use]
    pub fn limits(&self) -> Limits {
        let Self { spp, seconds, cpu_seconds, relative_error, .. } = *self;
        Limits { spp, seconds, cpu_seconds, relative_error }
    }

    /// Replaces the stopping limits.
    pub fn set_limits(&mut self, limits: Limits) {
        let Limits { spp, seconds, cpu_seconds, relative_error } = limits;
        (self.spp, self.seconds, self.cpu_seconds, self.relative_error) =
            (spp, seconds, cpu_seconds, relative_error);
    }
}

#[cfg(test)]
mod tests {
    use crate::io::scene_file;
    use crate::scene::{Limits, ReferenceDoc, SceneDoc, validate};

    /// Sample counts within the range of a scene file survive a round trip; larger counts are rejected with
    /// their key.
    #[test]
    fn samples_are_counted_beyond_32_bits() {
        for spp in [1, u64::from(u32::MAX), 5_000_000_000, Limits::MOST_SAMPLES] {
            let mut doc = SceneDoc::default();
            doc.render.spp = Some(spp);
            doc.compare.reference =
                ReferenceDoc::Render { estimator: "nee".into(), spp: Some(spp), relative_error: None };
            assert_eq!(validate(&doc), []);
            let read = scene_file::parse(&scene_file::to_toml(&doc), "counted").unwrap();
            assert_eq!(
                (read.render.limits(), read.compare.reference),
                (Limits::samples(spp), doc.compare.reference)
            );
            let set =
                scene_file::override_keys(&SceneDoc::default(), &[format!("render.spp={spp}")]).unwrap();
            assert_eq!(set.render.spp, Some(spp));
        }
        let mut doc = SceneDoc::default();
        doc.render.spp = Some(Limits::MOST_SAMPLES + 1);
        assert_eq!(validate(&doc)[0].path, "render.spp");
    }
}
