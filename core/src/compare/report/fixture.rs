//! A small rendered comparison: two views that agree and one with a clamped majorant.
#![allow(clippy::unwrap_used, reason = "only tests use it")]

use crate::compare::{Experiment, run};
use crate::io::{Library, scene_file};
use crate::scene::{ReferenceDoc, SceneDoc};

const SCENE: &str = "
    majorant = 1
    [film]
    width = 24
    height = 16
    [medium]
    extinction = 4.0
    albedo = 0.8
    [[lights]]
    kind = \"environment\"
    [estimator]
    id = \"spectral-mis\"
    mode = \"rgb\"
    [render]
    spp = 8
    threads = 1
    [[compare.views]]
    estimator = { id = \"nee\", mode = \"rgb\" }
    seed = 1
    [[compare.views]]
    estimator = { id = \"uni-nee-mis\", mode = \"rgb\" }
    majorant = { factor = 0.5, when_exceeded = \"clamp\" }
    seed = 2";

/// The document with a title and a rendered reference.
pub fn doc(title: &str) -> SceneDoc {
    let mut doc = scene_file::parse(SCENE, "the fixture").unwrap();
    doc.title = title.into();
    doc.compare.reference =
        ReferenceDoc::Render { estimator: "uni-nee-mis".into(), spp: Some(64), relative_error: None };
    doc
}

/// The finished comparison.
pub fn experiment(title: &str) -> Experiment {
    run(&doc(title), Library::default(), |_| {}).unwrap().experiment
}
