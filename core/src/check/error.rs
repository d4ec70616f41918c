//! Errors of a check.

use crate::io::scene_file::SceneFileError;
use crate::scene::SceneError;

/// Reason why a check could not be run.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// A scene could not be read.
    #[error(transparent)]
    Scene(#[from] SceneFileError),
    /// A scene could not be built.
    #[error("{name}: {source}")]
    Build {
        /// Name of the case.
        name: String,
        /// Cause.
        source: SceneError,
    },
    /// A reference that is part of the program is damaged.
    #[error("{name}: the reference is damaged: {reason}; build the program again")]
    Reference {
        /// Name of the case.
        name: String,
        /// Cause.
        reason: String,
    },
}
