//! Sampling limits as edited.

use serde::{Deserialize, Serialize};

/// When to stop, which random numbers, how many threads.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RenderDoc {
    /// Stop after this many samples per pixel. Absent: no limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spp: Option<u64>,
    /// Stop after this many seconds of rendering. Absent: no limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f32>,
    /// Stop after this many CPU seconds of path tracing, all workers together. Absent: no limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cpu_seconds: Option<f32>,
    /// Stop when the root mean square of the standard error is this share of the image's mean. Absent: no limit.
    ///
    /// Asked after 16, 23, 32, 45, … samples per pixel, a factor of √2 apart. It has to hold twice in succession, and the
    /// first and second half of the samples have to agree in the image's mean. Even so a picture is stopped early where it
    /// happens to be too dark: paths that are rare and strong are missing from the mean and from the error alike. A fixed
    /// number of samples has no such bias. As the only limit it ends a picture that is black, or has no finite value, after
    /// 256 samples, and says so.
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
    pub spp: Option<u64>,
    /// Seconds of rendering.
    pub seconds: Option<f32>,
    /// CPU seconds of path tracing.
    pub cpu_seconds: Option<f32>,
    /// Standard error as a share of the mean.
    pub relative_error: Option<f32>,
}

impl Limits {
    /// The largest number of samples that a scene file can hold: its integers have 64 bits and a sign.
    pub const MOST_SAMPLES: u64 = i64::MAX as u64;

    /// Stops after this many samples per pixel.
    #[must_use]
    pub fn samples(spp: u64) -> Self {
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

#[cfg(test)]
mod tests {
    use crate::io::scene_file;
    use crate::scene::{Limits, ReferenceDoc, SceneDoc, validate};

    /// What a scene file can hold is read, written and kept to; what it cannot hold is refused by name.
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
