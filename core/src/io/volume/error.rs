//! What can go wrong when a volume file is read.
//!
//! Every message has the same three parts: where (file, grid, byte), what, and the cure.

use std::borrow::Cow;
use std::fmt;

/// Why a volume could not be read.
#[derive(Debug, thiserror::Error)]
pub enum VolumeError {
    /// The operating system could not give us the bytes.
    #[error("{file}: cannot be read: {source}. Check the name and the folder, or choose another file")]
    Io {
        /// Path or label of the file.
        file: String,
        /// What the operating system said.
        #[source]
        source: std::io::Error,
    },
    /// The bytes contradict the format or themselves.
    #[error("{file}{place}: damaged: {what}. {cure}")]
    Invalid {
        /// Path or label of the file.
        file: String,
        /// Grid and byte offset, as far as they are known.
        place: Place,
        /// What was found.
        what: String,
        /// What the user can do.
        cure: Cow<'static, str>,
    },
    /// The file may be sound, but holds something that this reader does not read exactly.
    #[error("{file}{place}: not supported: {what}. {cure}")]
    Unsupported {
        /// Path or label of the file.
        file: String,
        /// Grid and byte offset, as far as they are known.
        place: Place,
        /// The feature.
        what: String,
        /// What the user can do.
        cure: Cow<'static, str>,
    },
    /// Reading would exceed one of the [`Limits`](super::Limits).
    #[error("{file}{place}: too large: {what}. {cure}")]
    TooLarge {
        /// Path or label of the file.
        file: String,
        /// Grid and byte offset, as far as they are known.
        place: Place,
        /// What is needed and what is allowed.
        what: String,
        /// What the user can do.
        cure: Cow<'static, str>,
    },
    /// The file has no grid of that name (or none that can serve as a density).
    #[error("{file}: {what}. {}", available_text(.available))]
    NoSuchGrid {
        /// Path or label of the file.
        file: String,
        /// What was asked for.
        what: String,
        /// The names that exist, in file order.
        available: Vec<String>,
    },
    /// A density below zero, which no fog volume can have.
    #[error(
        "{file}{place}: voxel {index:?} has the negative density {value}, one of {count}. {}",
        negative_cure(*.level_set)
    )]
    NegativeDensity {
        /// Path or label of the file.
        file: String,
        /// The grid.
        place: Place,
        /// Index coordinates (x, y, z) of the first negative voxel.
        index: [i32; 3],
        /// Its value.
        value: f32,
        /// How many voxels are negative.
        count: usize,
        /// Whether the file says that the grid is a level set.
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

/// A [`VolumeError`] before the names of the file and the grid are known.
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
    /// Damage, with the usual cure.
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

    /// `what` needs `needed` of something of which `limit` are allowed.
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

    /// The same fault with another cure.
    pub(super) fn with_cure(mut self, cure: impl Into<Cow<'static, str>>) -> Self {
        self.cure = cure.into();
        self
    }

    /// The same fault with a place in the file.
    pub(super) fn at(mut self, byte: u64) -> Self {
        self.byte = Some(byte);
        self
    }

    /// Names the file, and the grid where there is one.
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
