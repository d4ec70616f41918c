//! What can be chosen.

use std::path::PathBuf;

/// How figures and study are made.
#[derive(Clone, Debug)]
pub struct Options {
    /// Samples per pixel of panels; the report's are 64.
    pub spp: u64,
    /// Samples per pixel of references; the report's are 1024.
    pub reference_spp: u64,
    /// Columns and rows of every picture, instead of each figure's own.
    pub size: Option<[u32; 2]>,
    /// Worker threads; one per core if absent.
    pub threads: Option<usize>,
    /// Volumes that take the place of the embedded ones.
    pub volumes: Vec<OwnVolume>,
    /// The study; none if absent.
    pub study: Option<StudyOptions>,
    /// The command that made it, if it was one.
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

/// How long and how often each contestant of the study is run.
#[derive(Clone, Copy, Debug)]
pub struct StudyOptions {
    /// Wall-clock seconds of a run.
    pub seconds: f64,
    /// Runs, at least 2.
    pub repeats: u32,
}

impl Default for StudyOptions {
    fn default() -> Self {
        Self { seconds: 1.0, repeats: 6 }
    }
}

/// Whose volume stands in a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Our plume, where the report has OpenVDB's smoke: figures 1 and 2.
    Plume,
    /// Our cloud, where the report has OpenVDB's bunny cloud: figure 3.
    Cloud,
}

/// A volume that takes the place of an embedded one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OwnVolume {
    /// Which one; both if absent.
    pub stage: Option<Stage>,
    /// The file.
    pub file: PathBuf,
}

impl Options {
    /// The file that takes the place of a figure's volume; the last that fits.
    #[must_use]
    pub fn volume(&self, stage: Option<Stage>) -> Option<&OwnVolume> {
        let stage = stage?;
        self.volumes.iter().rev().find(|own| own.stage.is_none_or(|for_| for_ == stage))
    }
}
