//! Scenes of extreme density and spectral variation: all numbers stay finite.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "tests may panic, and print their tables"
)]

use majorant_core::estimator::{PathIndex, REGISTRY, Settings};
use majorant_core::io::{Library, scene_file};
use majorant_core::scene::{Mode, Scene, SceneDoc, build};
use majorant_core::transport::CancelToken;
use rayon::prelude::*;

fn scene(toml: &str) -> (SceneDoc, Scene) {
    let doc = scene_file::parse(toml, "extremes").unwrap_or_else(|e| panic!("{e}"));
    let scene = build(&doc, &mut Library::default()).unwrap_or_else(|e| panic!("{e}"));
    (doc, scene)
}

/// Optical depth 10 000 with albedo 1, a hundred times less at other wavelengths: paths with tens of
/// thousands of events.
#[test]
fn nothing_overflows_at_optical_depth_10_000() {
    let (mut doc, scene) = scene(
        "majorant = 1
        [camera]
        origin = [0.4, 0.3, 2.2]
        fov_deg = 10.0
        [film]
        width = 16
        height = 16
        [medium]
        extinction = \"430:100, 540:10000, 600:300\"
        albedo = 1.0
        [medium.majorant]
        factor = 1.5
        [[lights]]
        kind = \"environment\"",
    );
    for mode in [Mode::Spectral, Mode::Rgb] {
        doc.estimator.mode = mode;
        for entry in REGISTRY {
            let settings = Settings::new(&doc.estimator, 0);
            let paths = (0..256u32).into_par_iter().map(|i| {
                let at = PathIndex { x: i % 16, y: i / 16, sample: 0 };
                let estimate = (entry.kernel)(&scene, &settings, at, CancelToken::NEVER.into());
                assert!(estimate.rgb.is_finite(), "{} {mode:?} {at:?}: {}", entry.id, estimate.rgb);
                estimate
            });
            let paths: Vec<_> = paths.collect();
            let mean = paths.iter().map(|p| f64::from(p.rgb.element_sum()) / 3.0).sum::<f64>() / 256.0;
            let longest = paths.iter().map(|p| p.lookups).max().unwrap();
            println!("{} {mode:?}: mean {mean:.3}, {longest} look-ups in the longest path", entry.id);
            // The mean is not meaningful if the variance is infinite.
            let judged = (entry.infinite_variance)(&doc).is_none();
            assert!(!judged || (mean > 0.1 && longest > 3000), "{} {mode:?}: {mean} {longest}", entry.id);
        }
    }
}
