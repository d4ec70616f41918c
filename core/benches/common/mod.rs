//! Scenes and settings shared by the benchmarks.
#![allow(clippy::unwrap_used, dead_code, reason = "benchmarks may panic, and each uses a part")]

use criterion::Criterion;
use majorant_core::io::{Library, embedded, scene_file};
use majorant_core::scene::{Scene, SceneDoc, build};
use std::time::Duration;

/// Names of the four scenes on which paths are timed.
pub const SCENES: [&str; 4] = ["first-light", "plume-spectral", "cloud-backlit", "cloud-sidelit"];

/// Document of an embedded scene.
pub fn doc(name: &str) -> SceneDoc {
    scene_file::parse(embedded::find(name).unwrap().toml, name).unwrap()
}

/// Builds the scene of a document.
pub fn frozen(doc: &SceneDoc) -> Scene {
    build(doc, &mut Library::default()).unwrap()
}

/// Criterion configuration with short runs, of which only ratios within one run are significant.
pub fn config() -> Criterion {
    Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(2))
        .without_plots()
}
