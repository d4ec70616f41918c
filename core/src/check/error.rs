//! Why a check could not be made.

use crate::io::scene_file::SceneFileError;
use crate::scene::SceneError;

/// Why a check could not be made.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// A scene could not be read.
    #[error(transparent)]
    Scene(#[from] SceneFileError),
    /// A scene could not be frozen.
    #[error("{name}: {source}")]
    Build {
        /// The case.
        name: String,
        /// What happened.
        source: SceneError,
    },
    /// A reference that is part of the program is damaged.
    #[error("{name}: the reference is damaged: {reason}; build the program again")]
    Reference {
        /// The case.
        name: String,
        /// What happened.
        reason: String,
    },
}
