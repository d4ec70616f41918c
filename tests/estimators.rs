//! Every estimator against closed forms and against the others.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "tests may panic, and print their tables"
)]

use majorant_core::estimator::REGISTRY;
use majorant_core::scene::{Absorption, Mode, PhaseDoc, SceneDoc, WhenExceeded};
use majorant_tests::render::{BATCHES, Blocks, CAMERA, frozen, scene};
use majorant_tests::stats::judge;
use std::path::Path;

const DOF: f64 = (BATCHES - 1) as f64;
const HERE: &str = env!("CARGO_MANIFEST_DIR");

fn phases() -> [PhaseDoc; 5] {
    [
        PhaseDoc::Isotropic {},
        PhaseDoc::HenyeyGreenstein { g: 0.9 },
        PhaseDoc::HenyeyGreenstein { g: -0.5 },
        PhaseDoc::TwoLobe { g_forward: 0.8, g_backward: -0.3, forward: 0.6 },
        PhaseDoc::Rayleigh {},
    ]
}

/// Albedo 1 and radiance 1 from everywhere: whatever happens inside, every ray brings radiance 1.
#[test]
fn furnace_is_one_for_every_estimator_mode_and_phase_function() {
    let mut doc = scene(&format!(
        "{CAMERA}
        [medium]
        extinction = \"430:2, 540:6, 600:3\"
        albedo = 1.0
        density = {{ kind = \"grid\", file = \"embedded:cloud.vdb\" }}
        [medium.placement]
        fit = 1.4
        [[lights]]
        kind = \"environment\""
    ));
    for mode in [Mode::Spectral, Mode::Rgb] {
        doc.estimator.mode = mode;
        for phase in phases() {
            doc.medium.phase = phase;
            let scene = frozen(&doc, Path::new(HERE));
            for entry in REGISTRY {
                let blocks = Blocks::render(&scene, &doc, entry.id, 24, 2, 2);
                // The colour of constant radiance 1.
                let white = match mode {
                    Mode::Rgb => [1.0; 3],
                    Mode::Spectral => [1.204_794, 0.948_291, 0.908_916],
                };
                let known: Vec<f64> = (0..12).map(|i| white[i % 3]).collect();
                let verdict = judge(&blocks.against_known(&known, &[1e-4; 12]), DOF, 1e-6);
                println!("furnace {} {mode:?} {phase:?}: {verdict:?}", entry.id);
                assert!(verdict.agrees(), "{} {mode:?} {phase:?}: {verdict:?}", entry.id);
            }
        }
    }
}

/// Optical depth 1000 with albedo 1: thousands of events per path, and not one number overflows.
#[test]
fn nothing_overflows_at_optical_depth_1000() {
    let doc = scene(&format!(
        "{CAMERA}
        [medium]
        extinction = \"430:200, 540:1000, 600:300\"
        albedo = 1.0
        [medium.majorant]
        factor = 1.5
        [[lights]]
        kind = \"environment\"
        [estimator]
        mode = \"rgb\""
    ));
    for mode in [Mode::Spectral, Mode::Rgb] {
        let mut doc = doc.clone();
        doc.estimator.mode = mode;
        doc.film.width = 2;
        doc.film.height = 2;
        let scene = frozen(&doc, Path::new(HERE));
        for entry in REGISTRY {
            // Rendering asserts that every sample is finite.
            let blocks = Blocks::render(&scene, &doc, entry.id, 2, 1, 1);
            assert!(blocks.mean() > 0.1, "{}: {}", entry.id, blocks.mean());
        }
    }
}

fn agreement_scenes() -> Vec<(&'static str, SceneDoc)> {
    let grid = |name: &str| format!("density = {{ kind = \"grid\", file = \"embedded:{name}.vdb\" }}");
    vec![
        (
            "chromatic plume, rectangle and environment, spectral",
            scene(&format!(
                "{CAMERA}
                [medium]
                extinction = \"430:8, 540:40, 572:8\"
                albedo = 0.95
                {}
                [medium.placement]
                translate = [0.0, -0.8, 0.0]
                [[lights]]
                kind = \"rectangle\"
                center = [-1.4, 1.6, 1.2]
                target = [0.0, 0.0, 0.0]
                size = [1.2, 1.2]
                scale = 8.0
                [[lights]]
                kind = \"environment\"
                scale = 0.3",
                grid("plume")
            )),
        ),
        (
            "forward cloud over ground, sun and sphere, rgb",
            scene(&format!(
                "{CAMERA}
                [medium]
                extinction = {{ rgb = [12.0, 9.0, 6.0] }}
                albedo = {{ rgb = [0.99, 0.9, 0.8] }}
                phase = {{ kind = \"henyey-greenstein\", g = 0.7 }}
                {}
                [[lights]]
                kind = \"sun\"
                toward = [0.3, 0.8, 0.5]
                angular_diameter_deg = 30.0
                [[lights]]
                kind = \"sphere\"
                center = [0.8, 0.8, 0.3]
                radius = 0.35
                scale = 3.0
                [[objects]]
                kind = \"ground\"
                point = [0.0, -0.5, 0.0]
                albedo = {{ rgb = [0.6, 0.5, 0.3] }}
                [estimator]
                mode = \"rgb\"",
                grid("cloud")
            )),
        ),
        (
            "homogeneous absorber, camera inside, box occluder, loose shared majorant, spectral",
            scene(
                "majorant = 1
                [camera]
                origin = [0.1, 0.05, 0.3]
                fov_deg = 70.0
                [film]
                width = 8
                height = 8
                [medium]
                extinction = \"400:3, 560:6, 700:1\"
                albedo = \"400:0.5, 700:0.9\"
                phase = { kind = \"two-lobe\", g_forward = 0.6, g_backward = -0.4, forward = 0.7 }
                [medium.majorant]
                factor = 1.7
                shared = true
                [[lights]]
                kind = \"environment\"
                radiance = \"400:1, 700:2\"
                [[objects]]
                kind = \"box\"
                center = [0.1, 0.0, -0.2]
                size = [0.3, 0.3, 0.1]
                rotate_deg = [0.0, 30.0, 10.0]",
            ),
        ),
    ]
}

/// All estimators, both treatments of absorption, with and without roulette: one answer.
#[test]
fn estimators_agree_on_three_scenes() {
    for (name, base) in agreement_scenes() {
        let scene = frozen(&base, Path::new(HERE));
        let reference = Blocks::render(&scene, &base, "uni-nee-mis", 384, 2, 2);
        for entry in REGISTRY {
            for (absorption, roulette) in
                [(Absorption::Analogue, None), (Absorption::Weighted, None), (Absorption::Weighted, Some(2))]
            {
                let mut doc = base.clone();
                doc.estimator.absorption = absorption;
                doc.estimator.roulette_depth = roulette;
                doc.render.seed = 1;
                let blocks = Blocks::render(&scene, &doc, entry.id, 192, 2, 2);
                let verdict = judge(&blocks.against(&reference), DOF, 0.0);
                println!("{name}: {} {absorption:?} {roulette:?}: {verdict:?}", entry.id);
                assert!(verdict.agrees(), "{name}: {} {absorption:?}: {verdict:?}", entry.id);
            }
        }
    }
}

fn loose_majorant_scene(factor: f32, when_exceeded: WhenExceeded) -> SceneDoc {
    let mut doc = scene(&format!(
        "{CAMERA}
        [medium]
        extinction = {{ rgb = [3.0, 5.0, 4.0] }}
        albedo = 0.8
        density = {{ kind = \"grid\", file = \"embedded:cloud.vdb\" }}
        [medium.placement]
        fit = 1.4
        [[lights]]
        kind = \"environment\"
        [estimator]
        mode = \"rgb\""
    ));
    doc.medium.majorant.factor = factor;
    doc.medium.majorant.when_exceeded = when_exceeded;
    doc
}

/// A majorant that does not bound stays unbiased when weighted, for every estimator.
#[test]
fn any_majorant_factor_gives_the_same_image() {
    let tight = loose_majorant_scene(1.0, WhenExceeded::Weighted);
    let reference = Blocks::render(&frozen(&tight, Path::new(HERE)), &tight, "uni-nee-mis", 256, 2, 2);
    for factor in [0.5, 0.8, 1.7, 10.0] {
        let mut doc = loose_majorant_scene(factor, WhenExceeded::Weighted);
        doc.render.seed = 5;
        let scene = frozen(&doc, Path::new(HERE));
        for entry in REGISTRY {
            for absorption in [Absorption::Analogue, Absorption::Weighted] {
                doc.estimator.absorption = absorption;
                let blocks = Blocks::render(&scene, &doc, entry.id, 96, 2, 2);
                let verdict = judge(&blocks.against(&reference), DOF, 0.0);
                println!("factor {factor}: {} {absorption:?}: {verdict:?}", entry.id);
                assert!(verdict.agrees(), "factor {factor}: {} {absorption:?}: {verdict:?}", entry.id);
            }
        }
    }
}

/// Clamping the null coefficient is biased, and the test sees it: it has the power that it claims.
#[test]
fn a_clamped_majorant_is_caught_as_biased() {
    let tight = loose_majorant_scene(1.0, WhenExceeded::Weighted);
    let reference = Blocks::render(&frozen(&tight, Path::new(HERE)), &tight, "uni-nee-mis", 128, 2, 2);
    let doc = loose_majorant_scene(0.5, WhenExceeded::Clamp);
    let scene = frozen(&doc, Path::new(HERE));
    for entry in REGISTRY {
        let blocks = Blocks::render(&scene, &doc, entry.id, 96, 2, 2);
        let verdict = judge(&blocks.against(&reference), DOF, 0.0);
        assert!(!verdict.agrees(), "{}: {verdict:?}", entry.id);
    }
}

/// A depth limit of 1 leaves emission alone, seen through the medium.
#[test]
fn depth_one_is_emission_seen_through_the_medium() {
    let mut doc = scene(&format!(
        "{CAMERA}
        [medium]
        extinction = {{ rgb = [0.0, 1.5, 4.0] }}
        albedo = 0.9
        [medium.majorant]
        factor = 2.0
        [[lights]]
        kind = \"environment\"
        [estimator]
        mode = \"rgb\"
        max_depth = 1"
    ));
    // Straight through the cube's middle: a path of length 1.
    doc.camera.origin = [0.0, 0.0, 50.0];
    doc.camera.fov_deg = 0.2;
    let scene = frozen(&doc, Path::new(HERE));
    for entry in REGISTRY {
        let blocks = Blocks::render(&scene, &doc, entry.id, 64, 1, 1);
        let known = [1.0, (-1.5f64).exp(), (-4.0f64).exp()];
        let verdict = judge(&blocks.against_known(&known, &[2e-5; 3]), DOF, 1e-6);
        assert!(verdict.agrees(), "{}: {verdict:?}", entry.id);
    }
}
