//! Scenes at the edges of what a scene can be: lights in the medium and around it, grids under a sky,
//! components without extinction, cameras far away; and single scattering by quadrature.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "tests may panic, and print their tables"
)]

use majorant_core::estimator::REGISTRY;
use majorant_core::scene::{Mode, PhaseDoc, SceneDoc};
use majorant_tests::render::{BATCHES, Blocks, CAMERA, frozen, scene};
use majorant_tests::stats::judge;
use std::path::Path;

const DOF: f64 = (BATCHES - 1) as f64;
const HERE: &str = env!("CARGO_MANIFEST_DIR");

/// An environment map with a bright texel, RGB grids of two resolutions, a hidden light inside the
/// medium, wavelengths or channels without any extinction, a depth limit.
fn corner_cases(folder: &Path) -> Vec<(&'static str, SceneDoc)> {
    let sky = |x: usize, y: usize| {
        let sun = if (x, y) == (11, 2) { 400.0 } else { 0.0 };
        (0.4f32 + sun, 0.5f32 + sun, 0.8f32 + 0.5 * sun)
    };
    exr::prelude::write_rgb_file(folder.join("sky.exr"), 16, 8, sky).unwrap();
    let grid = |name: &str, [nx, ny, nz]: [usize; 3], value: fn(usize) -> [f32; 3]| {
        let header =
            format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({nz}, {ny}, {nx}, 3), }}\n");
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header.as_bytes());
        bytes.extend((0..nx * ny * nz).flat_map(value).flat_map(f32::to_le_bytes));
        std::fs::write(folder.join(name), bytes).unwrap();
    };
    grid("extinction.npy", [4, 4, 4], |i| [0.0, (i % 5) as f32, (i % 3) as f32 * 2.0]);
    grid("albedo.npy", [2, 3, 2], |i| [0.9, 0.2 + 0.06 * i as f32, 1.0]);
    let rgb_grids = "
        density = { kind = \"rgb-grid\", file = \"extinction.npy\" }
        albedo_grid = { file = \"albedo.npy\" }
        placement = { fit = 1.0 }
        [[lights]]
        kind = \"environment-map\"
        file = \"sky.exr\"
        rotate_deg = 40.0
        [[lights]]
        kind = \"rectangle\"
        center = [0.1, 0.1, 0.1]
        target = [-0.4, 0.5, 0.2]
        size = [0.3, 0.3]
        scale = 4.0
        visible = false
        [estimator]
        max_depth = 4";
    let zero_ends = "
        extinction = { points = \"450:5, 500:9, 600:2\", outside = \"zero\" }
        albedo = 0.9
        phase = { kind = \"rayleigh\" }
        [[lights]]
        kind = \"sphere\"
        center = [0.0, 0.0, 0.0]
        radius = 0.15
        radiance = \"tungsten\"
        scale = 5.0
        [[lights]]
        kind = \"environment\"
        scale = 0.2
        visible = false
        [estimator]
        max_depth = 3";
    vec![
        ("rgb grids under a sky, spectral", scene(&format!("{CAMERA}[medium]{rgb_grids}"))),
        ("rgb grids under a sky, rgb", scene(&format!("{CAMERA}[medium]{rgb_grids}\nmode = \"rgb\""))),
        (
            "no extinction at some wavelengths, light in the medium",
            scene(&format!("{CAMERA}[medium]{zero_ends}")),
        ),
    ]
}

#[test]
fn estimators_agree_on_corner_cases() {
    let folder = tempfile::tempdir().unwrap();
    for (name, base) in corner_cases(folder.path()) {
        let scene = frozen(&base, folder.path());
        let reference = Blocks::render(&scene, &base, "uni-nee-mis", 192, 2, 2);
        for entry in REGISTRY {
            let mut doc = base.clone();
            doc.render.seed = 1;
            let blocks = Blocks::render(&scene, &doc, entry.id, 128, 2, 2);
            let verdict = judge(&blocks.against(&reference), DOF, 0.0);
            println!("{name}: {} {verdict:?}", entry.id);
            assert!(verdict.agrees(), "{name}: {}: {verdict:?}", entry.id);
        }
    }
}

/// A lamp's light reaches all the way through the medium that the lamp stands in: at distance d in a
/// black medium it is e^(−σd) of what it is without.
#[test]
fn the_last_stretch_to_a_light_is_not_skipped() {
    let lit = |extinction: f32| {
        let mut doc = scene(
            "majorant = 1
            [camera]
            origin = [0.0, 250.0, 0.0]
            target = [0.0, 0.0, 0.0]
            up = [0.0, 0.0, 1.0]
            fov_deg = 0.01
            [film]
            width = 2
            height = 2
            [medium]
            albedo = 0.0
            placement = { scale = [4.0, 0.04, 4.0], translate = [0.0, 300.0, 0.0] }
            [[lights]]
            kind = \"rectangle\"
            center = [0.0, 300.0, 0.0]
            target = [0.0, 0.0, 0.0]
            up = [0.0, 0.0, 1.0]
            size = [0.5, 0.5]
            scale = 1000000.0
            [[objects]]
            kind = \"ground\"
            [estimator]
            mode = \"rgb\"",
        );
        doc.medium.extinction = majorant_core::spectrum::SpectrumDoc::Constant(extinction);
        let scene = frozen(&doc, Path::new(HERE));
        Blocks::render(&scene, &doc, "nee", 64, 1, 1).mean()
    };
    let (clear, dimmed) = (lit(0.0), lit(100.0));
    // 0.02 of extinction 100 lie between the lamp and the box's face.
    assert!((dimmed / clear / (-2.0f64).exp() - 1.0).abs() < 0.05, "{clear} {dimmed}");
}

/// A sphere light emits outwards only: from inside it is black, for walk and connection alike.
#[test]
fn a_sphere_light_is_dark_inside() {
    let mut doc = scene(&format!(
        "{CAMERA}
        [medium]
        extinction = 2.0
        [[lights]]
        kind = \"sphere\"
        center = [0.0, 0.0, 0.0]
        radius = 8.0
        [[lights]]
        kind = \"environment\""
    ));
    doc.estimator.mode = Mode::Rgb;
    let scene = frozen(&doc, Path::new(HERE));
    for entry in REGISTRY {
        assert_eq!(Blocks::render(&scene, &doc, entry.id, 8, 1, 1).mean(), 0.0, "{}", entry.id);
    }
}

/// The same picture from near and from a thousand times as far through a narrower lens: positions must
/// not lose the digits that surfaces and media need.
#[test]
fn distance_to_the_camera_does_not_matter() {
    let from = |distance: f32, fov_deg: f32| {
        let mut doc = scene(
            "majorant = 1
            [film]
            width = 4
            height = 4
            [medium]
            extinction = 3.0
            albedo = 0.8
            placement = { scale = [1.0, 0.2, 1.0], translate = [0.0, 0.12, 0.0] }
            [[lights]]
            kind = \"sphere\"
            center = [0.0, 0.5, 0.0]
            radius = 0.2
            scale = 3.0
            visible = false
            [[objects]]
            kind = \"ground\"
            [estimator]
            mode = \"rgb\"",
        );
        doc.camera.origin = [0.6 * distance, 0.8 * distance, 0.0];
        doc.camera.fov_deg = fov_deg;
        let scene = frozen(&doc, Path::new(HERE));
        Blocks::render(&scene, &doc, "uni-nee-mis", 256, 1, 1)
    };
    let verdict = judge(&from(2.0, 1.0).against(&from(1000.0, 0.002)), DOF, 2e-3);
    assert!(verdict.agrees(), "{verdict:?}");
}

/// One scattering, seen against an absorbing cube edge-on, by quadrature: σs p ∫ e^(−σ s) L(s) ds.
#[test]
fn depth_two_is_single_scattering_by_quadrature() {
    for g in [0.0, 0.7, -0.9] {
        let mut doc = scene(
            "majorant = 1
            [camera]
            origin = [0.0, 0.0, 60.0]
            fov_deg = 0.05
            [film]
            width = 2
            height = 2
            [medium]
            extinction = 1.5
            albedo = 0.6
            [[lights]]
            kind = \"sun\"
            toward = [1.0, 0.0, 0.0]
            angular_diameter_deg = 1.0
            irradiance = 2.0
            [estimator]
            mode = \"rgb\"
            max_depth = 2",
        );
        doc.medium.phase = PhaseDoc::HenyeyGreenstein { g };
        // Along the cube's axis every point is 0.5 from the face that the sun shines on.
        let (sigma, g64) = (1.5f64, f64::from(g));
        let phase = (1.0 - g64 * g64) / (4.0 * std::f64::consts::PI * (1.0 + g64 * g64).powf(1.5));
        let single = 0.6 * phase * 2.0 * (-0.5 * sigma).exp() * (1.0 - (-sigma).exp());
        let scene = frozen(&doc, Path::new(HERE));
        for id in ["nee", "uni-nee-mis", "spectral-mis"] {
            let spp = if id == "spectral-mis" { 20_000 } else { 400 };
            let blocks = Blocks::render(&scene, &doc, id, spp, 1, 1);
            // The sun's width changes the phase function and the path to the face by less than 0.2 %.
            let verdict = judge(&blocks.against_known(&[single; 3], &[2e-3 * single; 3]), DOF, 0.0);
            println!("g {g} {id}: {single} {} {verdict:?}", blocks.mean());
            assert!(verdict.agrees(), "g {g} {id}: {single} {} {verdict:?}", blocks.mean());
        }
    }
}
