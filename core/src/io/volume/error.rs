//! Errors of volume files.
//!
//! Every message has three parts: place (file, grid, byte), fault and remedy.

use std::borrow::Cow;
use std::fmt;

/// Reason why a volume could not be read.
#[derive(Debug, thiserror::Error)]
pub enum VolumeError {
    /// The operating system could not read the file.
    #[error("{file}: cannot be read: {source}. Check the name and the folder, or choose another file")]
    Io {
        /// Path or label of the file.
        file: String,
        /// Error of the operating system.
        #[source]
        source: std::io::Error,
    },
    /// The bytes contradict the format or each other.
    #[error("{file}{place}: damaged: {what}. {cure}")]
    Invalid {
        /// Path or label of the file.
        file: String,
        /// Grid and byte offset, as far as they are known.
        place: Place,
        /// Fault that was found.
        what: String,
        /// Remedy for the user.
        cure: Cow<'static, str>,
    },
    /// The file may be valid, but contains a feature that this reader does not support exactly.
    #[error("{file}{place}: not supported: {what}. {cure}")]
    Unsupported {
        /// Path or label of the file.
        file: String,
        /// Grid and byte offset, as far as they are known.
        place: Place,
        /// Unsupported feature.
        what: String,
        /// Remedy for the user.
        cure: Cow<'static, str>,
    },
    /// Reading would exceed one of the [`ReadLimits`](super::ReadLimits).
    #[error("{file}{place}: too large: {what}. {cure}")]
    TooLarge {
        /// Path or label of the file.
        file: String,
        /// Grid and byte offset, as far as they are known.
        place: Place,
        /// Required and allowed amounts.
        what: String,
        /// Remedy for the user.
        cure: Cow<'static, str>,
    },
    /// The file has no grid of this name (or none that can serve as a density).
    #[error("{file}: {what}. {}", available_text(.available))]
    NoSuchGrid {
        /// Path or label of the file.
        file: String,
        /// Requested grid.
        what: String,
        /// Names of existing grids, in file order.
        available: Vec<String>,
    },
    /// A negative density, which no fog volume can have.
    #[error(
        "{file}{place}: voxel {index:?} has the negative density {value}, one of {count}. {}",
        negative_cure(*.level_set)
    )]
    NegativeDensity {
        /// Path or label of the file.
        file: String,
        /// Grid of the voxel.
        place: Place,
        /// Index coordinates (x, y, z) of the first negative voxel.
        index: [i32; 3],
        /// Value of that voxel.
        value: f32,
        /// Number of negative voxels.
        count: usize,
        /// Whether the file declares the grid a level set.
        level_set: bool,
    },
}

/// Grid and byte offset of an error, as far as they are known.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Place {
    /// Display name of the grid.
    pub grid: Option<String>,
    /// Offset from the start of the file, in bytes.
    pub byte: Option<u64>,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(grid) = &self.grid {
            write!(f, ", grid \"{grid}\"")?;
        }
        if let Some(byte) = self.byte {
            write!(f, ", byte {byte}")?;
        }
        Ok(())
    }
}

fn available_text(available: &[String]) -> String {
    if available.is_empty() {
        return "The file has no named grids".to_owned();
    }
    let quoted: Vec<String> = available.iter().map(|name| format!("\"{name}\"")).collect();
    format!("Grids in the file: {}", quoted.join(", "))
}

fn negative_cure(level_set: bool) -> &'static str {
    if level_set {
        "The grid is a level set (a signed distance, negative inside), not a density: convert it \
         to a fog volume (OpenVDB sdfToFogVolume, Houdini Convert VDB)"
    } else {
        "A fog volume cannot be negative: clamp the values at 0 in the exporter, or, if the grid \
         is a signed distance, convert it to a fog volume"
    }
}

/// A [`VolumeError`] before the names of file and grid are known.
#[derive(Debug, Clone)]
pub(super) struct Fault {
    kind: FaultKind,
    byte: Option<u64>,
    what: String,
    cure: Cow<'static, str>,
}

#[derive(Debug, Clone, Copy)]
enum FaultKind {
    Invalid,
    Unsupported,
    TooLarge,
}

impl Fault {
    /// Damage, with the default remedy.
    pub(super) fn invalid(byte: impl Into<Option<u64>>, what: impl Into<String>) -> Self {
        Self {
            kind: FaultKind::Invalid,
            byte: byte.into(),
            what: what.into(),
            cure: Cow::Borrowed("Copy or export the file again"),
        }
    }

    pub(super) fn unsupported(what: impl Into<String>, cure: impl Into<Cow<'static, str>>) -> Self {
        Self { kind: FaultKind::Unsupported, byte: None, what: what.into(), cure: cure.into() }
    }

    /// Creates an error: `what` needs `needed`, but `limit` is allowed.
    pub(super) fn too_large(
        what: &str,
        needed: impl fmt::Display,
        limit: impl fmt::Display,
        cure: &'static str,
    ) -> Self {
        Self {
            kind: FaultKind::TooLarge,
            byte: None,
            what: format!("{what}: {needed}, but the limit is {limit}"),
            cure: Cow::Borrowed(cure),
        }
    }

    /// Replaces the remedy.
    pub(super) fn with_cure(mut self, cure: impl Into<Cow<'static, str>>) -> Self {
        self.cure = cure.into();
        self
    }

    /// Adds a byte offset.
    pub(super) fn at(mut self, byte: u64) -> Self {
        self.byte = Some(byte);
        self
    }

    /// Adds the name of the file and, if there is one, of the grid.
    pub(super) fn in_file(self, file: &str, grid: Option<&str>) -> VolumeError {
        let file = file.to_owned();
        let place = Place { grid: grid.map(str::to_owned), byte: self.byte };
        let (what, cure) = (self.what, self.cure);
        match self.kind {
            FaultKind::Invalid => VolumeError::Invalid { file, place, what, cure },
            FaultKind::Unsupported => VolumeError::Unsupported { file, place, what, cure },
            FaultKind::TooLarge => VolumeError::TooLarge { file, place, what, cure },
        }
    }
}
