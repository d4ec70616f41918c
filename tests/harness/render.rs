//! Scenes from text, and means of their images.

use majorant_core::check::{Batches, Layout, Plan, stats};
use majorant_core::estimator::{self, Settings};
use majorant_core::io::{Library, scene_file};
use majorant_core::scene::{Scene, SceneDoc, build};
use majorant_core::transport::CancelToken;
use std::path::Path;

/// Beginning of a test scene: a camera outside of the medium that looks at the origin, with 8 × 8 pixels.
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

/// Builds the scene of a document whose files are in `base`.
pub fn frozen(doc: &SceneDoc, base: &Path) -> Scene {
    build(doc, &mut Library::default().with_base(base)).unwrap_or_else(|e| panic!("{e}"))
}

/// Mean of the image with an estimator, and its standard error, from batches of `spp` samples.
pub fn mean(doc: &SceneDoc, estimator: &str, spp: u64) -> (f64, f64) {
    mean_with(doc, estimator, spp, Library::default())
}

/// As [`mean`], with files from a library.
pub fn mean_with(doc: &SceneDoc, estimator: &str, spp: u64, mut library: Library) -> (f64, f64) {
    let scene = build(doc, &mut library).unwrap_or_else(|e| panic!("{e}"));
    let kernel = estimator::find(estimator).unwrap().kernel;
    let settings = Settings::new(&doc.estimator, doc.render.seed);
    let plan =
        Plan { scene: &scene, kernel, settings: &settings, layout: Layout::WHOLE, first_sample: 0, spp };
    let image = Batches::render(&plan, CancelToken::NEVER).unwrap();
    assert_eq!(image.non_finite, None, "{estimator}");
    image.whole()
}

/// Allowed difference of two means in standard errors, for a family of `tests` comparisons.
pub fn allowed(tests: usize) -> f64 {
    stats::critical_t(tests, 127.0)
}
