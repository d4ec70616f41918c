//! Extreme scenes that need separate tests in addition to the cases of `conformance.rs`.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may panic")]

use glam::{Vec2, Vec3};
use majorant_core::estimator::{self, PathIndex, REGISTRY, Settings};
use majorant_core::io::{Library, embedded, scene_file};
use majorant_core::medium::Interpolation;
use majorant_core::phase::{Phase, PhaseDoc};
use majorant_core::scene::{Mode, SceneDoc, build};
use majorant_core::transport::{CancelToken, DirectionSampler, Vertex};
use majorant_tests::render::{CAMERA, allowed, mean, mean_with, scene};

/// A light inside a medium is attenuated along the full distance: by e^(−σd) at distance d in a black medium.
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
        doc.medium_mut().extinction = majorant_core::spectrum::SpectrumDoc::Constant(extinction);
        mean(&doc, "nee", 64).0
    };
    let (clear, dimmed) = (lit(0.0), lit(100.0));
    // A distance of 0.02 with extinction 100 lies between the light and the face of the box.
    assert!((dimmed / clear / (-2.0f64).exp() - 1.0).abs() < 0.05, "{clear} {dimmed}");
}

/// Without media light travels in straight lines, under every estimator and in both modes; a disabled medium
/// is no medium.
#[test]
fn a_scene_without_media_shows_its_background() {
    for media in ["", "[[media]]\nenabled = false"] {
        for mode in ["rgb", "spectral"] {
            let light = "[[lights]]\nkind = \"environment\"";
            let text = format!("{CAMERA}\n{media}\n{light}\n[estimator]\nmode = \"{mode}\"");
            let doc = scene(&text.replace("majorant = 1", "majorant = 2"));
            for entry in REGISTRY {
                let (seen, error) = mean(&doc, entry.id, 64);
                // Mean of the channels of constant radiance 1.
                let white = if mode == "rgb" { 1.0 } else { (1.2050 + 0.9483 + 0.9086) / 3.0 };
                let off = (seen - white).abs();
                assert!(off < allowed(28) * error + 1e-4, "{}, {mode}: {seen} ± {error}", entry.id);
            }
        }
    }
}

/// A disabled light, surface or medium is absent: the image is that of the scene without it, bit for bit.
#[test]
fn a_disabled_part_of_a_scene_is_absent() {
    let text = format!(
        "{CAMERA}
        [[media]]
        extinction = 2.0
        [[media]]
        name = \"fog\"
        within = \"everywhere\"
        extent = 2.0
        extinction = 0.3
        enabled = false
        [[lights]]
        kind = \"sphere\"
        center = [0.0, 1.5, 0.0]
        radius = 0.3
        scale = 5.0
        enabled = false
        [[lights]]
        kind = \"environment\"
        [[objects]]
        kind = \"ground\"
        point = [0.0, -0.6, 0.0]
        enabled = false"
    );
    let doc = scene(&text.replace("majorant = 1", "majorant = 2"));
    let mut without = doc.clone();
    without.media.truncate(1);
    without.lights.remove(0);
    without.objects.clear();
    let mut with = doc.clone();
    with.media[1].enabled = true;
    for entry in REGISTRY {
        let [disabled, removed, enabled] = [&doc, &without, &with].map(|doc| mean(doc, entry.id, 16));
        assert_eq!(disabled, removed, "{}", entry.id);
        assert_ne!(disabled, enabled, "{}", entry.id);
    }
}

/// Light that total reflection holds in a body for ever ends without a depth limit.
#[test]
fn a_camera_inside_clear_glass_finishes() {
    let doc = scene(
        "majorant = 2
        [camera]
        origin = [0.05, 0.1, 0.02]
        target = [0.3, 0.4, 0.5]
        fov_deg = 90.0
        [film]
        width = 4
        height = 4
        [[lights]]
        kind = \"environment\"
        [[objects]]
        kind = \"box\"
        center = [0.0, 0.0, 0.0]
        size = [1.0, 1.0, 1.0]
        material = { kind = \"dielectric\", ior = 1.9 }
        [estimator]
        mode = \"rgb\"",
    );
    for entry in REGISTRY {
        let (seen, _) = mean(&doc, entry.id, 1);
        // Directions that leave have n² times the radiance outside; most are held.
        assert!(seen > 0.0 && seen < 1.9 * 1.9, "{}: {seen}", entry.id);
    }
}

/// A body of lower priority has no boundary, no index and no medium inside another.
#[test]
fn a_displaced_body_is_absent() {
    let glass = |liquid: &str| {
        let doc = scene(&format!(
            "majorant = 2
            [camera]
            origin = [0.4, 0.3, 2.6]
            fov_deg = 30.0
            [film]
            width = 8
            height = 8
            [[media]]
            within = \"glass\"
            extinction = 1.0
            albedo = 0.0
            [[lights]]
            kind = \"environment\"
            [[lights]]
            kind = \"sphere\"
            center = [1.0, 1.5, 0.5]
            radius = 0.5
            [[objects]]
            name = \"glass\"
            kind = \"sphere\"
            center = [0.0, 0.0, 0.0]
            radius = 0.8
            material = {{ kind = \"dielectric\", ior = 1.5 }}
            {liquid}
            [estimator]
            mode = \"rgb\""
        ));
        ["spectral-mis", "uni-nee-mis"].map(|id| mean(&doc, id, 32))
    };
    let liquid = |priority: i32| {
        format!(
            "[[media]]
            name = \"liquid\"
            within = \"liquid\"
            extinction = 8.0
            albedo = 0.0
            [[objects]]
            name = \"liquid\"
            kind = \"box\"
            center = [0.1, 0.0, 0.0]
            size = [0.6, 0.5, 0.7]
            priority = {priority}
            material = {{ kind = \"dielectric\", ior = 1.1 }}"
        )
    };
    let (alone, outranked, there) = (glass(""), glass(&liquid(-1)), glass(&liquid(1)));
    for ((alone, outranked), there) in alone.iter().zip(outranked).zip(there) {
        let error = alone.1.hypot(outranked.1);
        assert!((alone.0 - outranked.0).abs() < allowed(2) * error, "{alone:?} {outranked:?}");
        assert!((alone.0 - there.0).abs() > 20.0 * error, "{alone:?} {there:?}");
    }
}

/// On a smooth mesh no light comes from below the geometry, although it is above the interpolated normal.
#[test]
fn light_from_below_a_smooth_surface_is_left_out() {
    let phase = Phase::new(&PhaseDoc::Isotropic {});
    let sampler = DirectionSampler { phase: &phase, guide: None };
    let normal = Vec3::new(0.6, 0.0, 0.8);
    let (point, omega_in) = (Vec3::ZERO, Vec3::NEG_Z);
    let vertex = Vertex::Surface { point, omega_in, normal, outward: Vec3::Z, boundary: None };
    let below = Vec3::new(1.0, 0.0, -0.1).normalize();
    let towards = sampler.towards(&vertex, below);
    assert!(towards.value == 0.0 && towards.density > 0.0, "{towards:?}");
    assert!(sampler.towards(&vertex, Vec3::Z).value > 0.0);
    for i in 0..1000u16 {
        let u = Vec2::new((f32::from(i) + 0.5) / 1000.0, (f32::from(i) * 0.618_034).fract());
        let drawn = sampler.draw(&vertex, u);
        assert_eq!(drawn.value > 0.0, drawn.direction.z > 0.0, "{drawn:?}");
    }
}

/// Objects and media within them look the same a thousand units from the origin, in the coordinates of which
/// single precision resolves 6·10⁻⁵.
#[test]
fn objects_keep_their_shape_far_from_the_origin() {
    let cube = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n\
                f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8 7\n";
    let at = |x: f32, entry: &str| {
        let doc = scene(&format!(
            "majorant = 2
            [camera]
            origin = [{}, 1.0, 3.0]
            target = [{x}, 0.0, 0.0]
            fov_deg = 30.0
            [film]
            width = 4
            height = 4
            [[media]]
            within = \"cube\"
            extinction = 3.0
            albedo = 0.8
            [[lights]]
            kind = \"environment\"
            [[objects]]
            name = \"cube\"
            kind = \"mesh\"
            file = \"cube.obj\"
            placement = {{ rotate_deg = [20.0, 30.0, 0.0], translate = [{}, -0.3, -0.5] }}
            material = {{ kind = \"interface\" }}
            [[objects]]
            kind = \"sphere\"
            center = [{}, 0.2, 0.4]
            radius = 0.3
            material = {{ kind = \"dielectric\" }}
            [[objects]]
            kind = \"mesh\"
            file = \"cube.obj\"
            placement = {{ scale = [0.4, 0.4, 0.4], translate = [{}, -0.2, 0.3] }}
            material = {{ kind = \"diffuse\", albedo = 0.9 }}
            [estimator]
            mode = \"rgb\"",
            x + 0.5,
            x - 0.5,
            x + 0.5,
            x - 0.6,
        ));
        let library = Library::default().with_volume("cube.obj", cube.as_bytes());
        mean_with(&doc, entry, 400, library)
    };
    for id in ["spectral-mis", "uni-nee-mis"] {
        let (near, far) = (at(0.0, id), at(1000.0, id));
        let error = near.1.hypot(far.1);
        assert!((near.0 - far.0).abs() < allowed(2) * error + 1e-3, "{id}: {near:?} {far:?}");
    }
}

/// A sphere light emits outwards only: from inside it is black, with unidirectional sampling and with NEE.
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
    for entry in REGISTRY {
        assert_eq!(mean(&doc, entry.id, 2).0, 0.0, "{}", entry.id);
    }
}

/// The image is the same from 500 times the distance with a narrower field of view: positions must keep the
/// precision that surfaces and media need.
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
        mean(&doc, "uni-nee-mis", 256)
    };
    let ((near, near_error), (far, far_error)) = (from(2.0, 1.0), from(1000.0, 0.002));
    let error = near_error.hypot(far_error);
    assert!(error < 2e-3 * near, "{near} ± {error}");
    assert!((near - far).abs() < allowed(1) * error, "{near} {far} ± {error}");
}

/// A majorant of factor 1 bounds all look-ups exactly, at any resolution and with either interpolation;
/// look-ups that exceed a lower one are counted.
#[test]
fn the_majorant_is_exceeded_only_where_it_does_not_bound() {
    for name in ["plume-spectral", "cloud-sidelit"] {
        let toml = embedded::find(name).unwrap().toml;
        let mut doc = scene_file::parse(toml, name).unwrap();
        (doc.film.width, doc.film.height) = (24, 16);
        let mut library = Library::default();
        let mut exceeded = |doc: &SceneDoc| -> (u64, u64) {
            let scene = build(doc, &mut library).unwrap();
            let settings = Settings::new(&doc.estimator, 5);
            let kernel = estimator::find("uni-nee-mis").unwrap().kernel;
            let pixels = (0..24).flat_map(|x| (0..16).map(move |y| (x, y)));
            let paths = pixels.flat_map(|at| (0..8).map(move |sample| (at, sample)));
            paths.fold((0, 0), |(exceeded, lookups), ((x, y), sample)| {
                let path = kernel(&scene, &settings, PathIndex { x, y, sample }, CancelToken::NEVER.into());
                (exceeded + path.exceeded, lookups + path.lookups)
            })
        };
        for (resolution, interpolation) in [None, Some(1), Some(7), Some(64)]
            .into_iter()
            .flat_map(|r| [Interpolation::Trilinear, Interpolation::Stochastic].map(|i| (r, i)))
        {
            doc.medium_mut().majorant.resolution = resolution;
            doc.medium_mut().interpolation = interpolation;
            doc.medium_mut().majorant.factor = 1.0;
            let (none, lookups) = exceeded(&doc);
            assert!(
                none == 0 && lookups > 1000,
                "{name} {resolution:?} {interpolation:?}: {none} of {lookups}"
            );
            doc.medium_mut().majorant.factor = 0.5;
            let (some, lookups) = exceeded(&doc);
            assert!(
                some > 0 && some < lookups,
                "{name} {resolution:?} {interpolation:?}: {some} of {lookups}"
            );
        }
    }
}
