//! Scenes: the editable document, its validation, and the frozen form that paths are traced in.

mod bodies;
mod build;
mod camera;
pub mod doc;
mod frozen;
pub mod keys;
mod placement;
mod validate;

pub use bodies::{Bodies, Body, Crossing};
pub use build::{PlacedGrid, ResourceError, Resources, build};
pub use camera::Camera;
pub use doc::*;
pub use frozen::{MediumInfo, NearestSurface, ObjectInfo, Scene, SceneInfo, SceneMedium};
pub(crate) use placement::{bounds, rotation};
pub use validate::{Problem, validate};

/// Error on freezing a document into a scene.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// An invalid value; the first one found.
    #[error("{0}")]
    Invalid(Problem),
    /// A file named by the scene could not be used.
    #[error("{path}: {source}")]
    Resource {
        /// Key in the document.
        path: String,
        /// Underlying error.
        source: ResourceError,
    },
}
