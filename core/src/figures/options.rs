//! Options of figures and study.

use std::path::PathBuf;

/// Options of figures and study.
#[derive(Clone, Debug)]
pub struct Options {
    /// Samples per pixel of panels; the report uses 64.
    pub spp: u64,
    /// Samples per pixel of references; the report uses 1024.
    pub reference_spp: u64,
    /// Columns and rows of every image; `None` for those of each figure.
    pub size: Option<[u32; 2]>,
    /// Worker threads; `None` for one per core.
    pub threads: Option<usize>,
    /// Volumes that replace the embedded ones.
    pub volumes: Vec<OwnVolume>,
    /// Options of the study; `None` to skip it.
    pub study: Option<StudyOptions>,
    /// Command line that was used, if there was one.
    pub command: Option<String>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            spp: 64,
            reference_spp: 1024,
            size: None,
            threads: None,
            volumes: Vec::new(),
            study: Some(StudyOptions::default()),
            command: None,
        }
    }
}

/// Duration and number of the runs of each variant in the study.
#[derive(Clone, Copy, Debug)]
pub struct StudyOptions {
    /// Wall-clock seconds of a run.
    pub seconds: f64,
    /// Number of runs, at least 2.
    pub repeats: u32,
}

impl Default for StudyOptions {
    fn default() -> Self {
        Self { seconds: 1.0, repeats: 6 }
    }
}

/// Kind of volume in a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// The embedded plume, in place of the report's OpenVDB smoke: figures 1 and 2.
    Plume,
    /// The embedded cloud, in place of the report's OpenVDB bunny cloud: figure 3.
    Cloud,
}

/// A volume that replaces an embedded one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OwnVolume {
    /// Kind of volume that it replaces; `None` for both.
    pub stage: Option<Stage>,
    /// File name.
    pub file: PathBuf,
}

impl Options {
    /// The last volume that replaces that of a figure, if any.
    #[must_use]
    pub fn volume(&self, stage: Option<Stage>) -> Option<&OwnVolume> {
        let stage = stage?;
        self.volumes.iter().rev().find(|own| own.stage.is_none_or(|for_| for_ == stage))
    }
}
