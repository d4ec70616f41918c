//! Scenes and settings that several benchmarks share.
#![allow(clippy::unwrap_used, dead_code, reason = "benchmarks may panic, and each uses a part")]

use criterion::Criterion;
use majorant_core::io::{Library, embedded, scene_file};
use majorant_core::scene::{Scene, SceneDoc, build};
use std::time::Duration;

/// The four scenes that paths are timed on.
pub const SCENES: [&str; 4] = ["first-light", "plume-spectral", "cloud-backlit", "cloud-sidelit"];

/// An embedded scene's document.
pub fn doc(name: &str) -> SceneDoc {
    scene_file::parse(embedded::find(name).unwrap().toml, name).unwrap()
}

/// A document, frozen.
pub fn frozen(doc: &SceneDoc) -> Scene {
    build(doc, &mut Library::default()).unwrap()
}

/// Short runs: ratios between the lines of one run are what counts.
pub fn config() -> Criterion {
    Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(2))
        .without_plots()
}
