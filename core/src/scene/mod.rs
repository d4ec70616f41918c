//! Scenes: the editable document, its validation, and the frozen form that paths are traced in.

mod build;
mod camera;
pub mod doc;
mod frozen;
pub mod keys;
mod placement;
mod validate;

pub use build::{PlacedGrid, ResourceError, Resources, build};
pub use camera::Camera;
pub use doc::*;
pub use frozen::{NearestSurface, Scene, SceneInfo};
pub(crate) use placement::{bounds, rotation};
pub use validate::{Problem, validate};

/// Why a document could not be frozen into a scene.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// A value that makes no sense; the first of those found.
    #[error("{0}")]
    Invalid(Problem),
    /// A file that the scene names could not be used.
    #[error("{path}: {source}")]
    Resource {
        /// The key in the document.
        path: String,
        /// What happened.
        source: ResourceError,
    },
}
