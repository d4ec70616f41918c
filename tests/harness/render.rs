//! Scenes from text, and their image's mean.

use majorant_core::check::{Batches, Layout, Plan, stats};
use majorant_core::estimator::{self, Settings};
use majorant_core::io::{Library, scene_file};
use majorant_core::scene::{Scene, SceneDoc, build};
use majorant_core::transport::CancelToken;
use std::path::Path;

/// How a test scene begins that looks at the origin from outside, in 8 × 8 pixels.
pub const CAMERA: &str = "
majorant = 1
[camera]
origin = [0.4, 0.3, 2.2]
fov_deg = 30.0
[film]
width = 8
height = 8
";

/// Parses a scene from text.
pub fn scene(toml: &str) -> SceneDoc {
    scene_file::parse(toml, "test scene").unwrap_or_else(|e| panic!("{e}"))
}

/// Freezes a document whose files lie in `base`.
pub fn frozen(doc: &SceneDoc, base: &Path) -> Scene {
    build(doc, &mut Library::default().with_base(base)).unwrap_or_else(|e| panic!("{e}"))
}

/// The image's mean under an estimator, with its standard error, from batches of `spp` samples.
pub fn mean(doc: &SceneDoc, estimator: &str, spp: u64) -> (f64, f64) {
    let scene = frozen(doc, Path::new("."));
    let kernel = estimator::find(estimator).unwrap().kernel;
    let settings = Settings::new(&doc.estimator, doc.render.seed);
    let plan =
        Plan { scene: &scene, kernel, settings: &settings, layout: Layout::WHOLE, first_sample: 0, spp };
    let image = Batches::render(&plan, CancelToken::NEVER).unwrap();
    assert_eq!(image.non_finite, None, "{estimator}");
    image.whole()
}

/// The most standard errors that two means of `tests` comparisons may differ by.
pub fn allowed(tests: usize) -> f64 {
    stats::critical_t(tests, 127.0)
}
