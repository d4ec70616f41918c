//! Why figures could not be made.

use crate::bench::BenchError;
use crate::compare::RunError;
use crate::compare::report::ReportError;
use crate::io::export::ExportError;
use crate::io::scene_file::SceneFileError;
use crate::io::volume::VolumeError;

/// Why figures could not be made.
#[derive(Debug, thiserror::Error)]
pub enum FiguresError {
    /// A figure asks for a scene that is not part of the program.
    #[error("figure {figure} needs the embedded scene `{scene}`, which this program lacks")]
    NoScene {
        /// The figure's strip.
        figure: &'static str,
        /// The scene.
        scene: &'static str,
    },
    /// A setting does not fit its scene.
    #[error(transparent)]
    Scene(#[from] SceneFileError),
    /// A document that cannot be rendered.
    #[error("{figure}: {problem}")]
    Invalid {
        /// The figure's strip.
        figure: &'static str,
        /// What makes no sense.
        problem: crate::scene::Problem,
    },
    /// A person's own volume cannot be read.
    #[error(transparent)]
    Volume(#[from] VolumeError),
    /// A volume of the program cannot be read.
    #[error(transparent)]
    Resource(#[from] crate::scene::ResourceError),
    /// A person's own volume holds colours.
    #[error("{file}: {channels} values per voxel; the figures need a density, one value per voxel")]
    Colour {
        /// The file.
        file: String,
        /// Values per voxel.
        channels: usize,
    },
    /// A person's own volume holds nothing.
    #[error("{file}: the density is 0 everywhere; choose a volume that holds something")]
    Empty {
        /// The file.
        file: String,
    },
    /// A person's own volume is not needed.
    #[error("--volume {file}: no figure that was asked for has such a volume")]
    Unused {
        /// The file.
        file: String,
    },
    /// Panels could not be rendered.
    #[error("{figure}: {source}")]
    Render {
        /// The figure's strip.
        figure: &'static str,
        /// What happened.
        source: RunError,
    },
    /// The study could not be run.
    #[error(transparent)]
    Study(#[from] BenchError),
    /// A file could not be written.
    #[error(transparent)]
    Write(#[from] ReportError),
    /// A picture could not be written.
    #[error(transparent)]
    Export(#[from] ExportError),
}
