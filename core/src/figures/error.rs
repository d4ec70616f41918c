//! Errors of figures and study.

use crate::bench::BenchError;
use crate::compare::RunError;
use crate::compare::report::ReportError;
use crate::io::export::ExportError;
use crate::io::scene_file::SceneFileError;
use crate::io::volume::VolumeError;

/// Reason why figures could not be rendered.
#[derive(Debug, thiserror::Error)]
pub enum FiguresError {
    /// A figure needs a scene that is not embedded.
    #[error("figure {figure} needs the embedded scene `{scene}`, which this program lacks")]
    NoScene {
        /// Strip of the figure.
        figure: &'static str,
        /// Name of the scene.
        scene: &'static str,
    },
    /// A setting does not fit its scene.
    #[error(transparent)]
    Scene(#[from] SceneFileError),
    /// The document is invalid.
    #[error("{figure}: {problem}")]
    Invalid {
        /// Strip of the figure.
        figure: &'static str,
        /// Fault of the document.
        problem: crate::scene::Problem,
    },
    /// The user's volume cannot be read.
    #[error(transparent)]
    Volume(#[from] VolumeError),
    /// An embedded volume cannot be read.
    #[error(transparent)]
    Resource(#[from] crate::scene::ResourceError),
    /// The user's volume has several channels.
    #[error("{file}: {channels} values per voxel; the figures need a density, one value per voxel")]
    Colour {
        /// File name.
        file: String,
        /// Values per voxel.
        channels: usize,
    },
    /// The user's volume is empty.
    #[error("{file}: the density is 0 everywhere; choose a volume that is not empty")]
    Empty {
        /// File name.
        file: String,
    },
    /// The user's volume is not needed.
    #[error("--volume {file}: no figure of those requested uses such a volume")]
    Unused {
        /// File name.
        file: String,
    },
    /// Panels could not be rendered.
    #[error("{figure}: {source}")]
    Render {
        /// Strip of the figure.
        figure: &'static str,
        /// Cause.
        source: RunError,
    },
    /// The study could not be run.
    #[error(transparent)]
    Study(#[from] BenchError),
    /// A file could not be written.
    #[error(transparent)]
    Write(#[from] ReportError),
    /// An image could not be written.
    #[error(transparent)]
    Export(#[from] ExportError),
}
