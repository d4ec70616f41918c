//! Input and output: scenes, volumes, images and results.

pub mod embedded;
pub mod export;
mod exr_picture;
pub mod fingerprint;
mod library;
pub mod mesh;
pub mod phase_table;
pub mod picture;
mod placing;
mod primaries;
mod progress;
pub mod scene_file;
pub mod volume;

pub use library::Library;
pub use progress::{Loading, Progress};
