//! Invalid input: an error that names file, place and remedy, or a reported repair; never a panic.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may panic")]

use majorant_core::estimator::PathIndex;
use majorant_core::io::{Library, picture, scene_file};
use majorant_core::scene::{Angle, DensityDoc, GridRef, LightDoc, PhaseDoc, SceneDoc, build};
use majorant_core::transport::CancelToken;
use majorant_tests::render::frozen;
use std::path::Path;

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

fn npy(shape: &str, values: &[f32]) -> Vec<u8> {
    let header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}\n");
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(values.iter().flat_map(|v| v.to_le_bytes()));
    bytes
}

fn with_density(file: &str) -> SceneDoc {
    let mut doc = SceneDoc::default();
    doc.medium_mut().density = DensityDoc::Grid(GridRef { file: file.into(), grid: None });
    doc
}

/// Returns the error message for a scene whose density is a file with the given bytes.
fn refused(name: &str, bytes: &[u8]) -> String {
    let folder = folder();
    std::fs::write(folder.path().join(name), bytes).unwrap();
    let mut library = Library::default().with_base(folder.path());
    let message = build(&with_density(name), &mut library).unwrap_err().to_string();
    assert!(message.contains("medium.density") && message.contains(name), "{message}");
    message
}

#[test]
fn volumes_that_are_missing_truncated_empty_or_not_densities() {
    let message = build(&with_density("gone.vdb"), &mut Library::default()).unwrap_err().to_string();
    assert!(message.contains("gone.vdb"), "{message}");
    assert!(build(&with_density(""), &mut Library::default()).is_err());
    assert!(build(&with_density("embedded:no.vdb"), &mut Library::default()).is_err());
    refused("empty.vdb", b"");
    refused("text.vdb", b"this is no volume, whatever its name says");
    refused("short.npy", &npy("(2, 2, 2)", &[1.0; 7]));
    refused("zero.npy", &npy("(0, 2, 2)", &[]));
    refused("huge.npy", &npy("(99999, 99999, 99999)", &[]));
    refused("flat.npy", &npy("(4,)", &[1.0; 4]));
    refused("short.vol", b"VOL\x03\x01\x00\x00\x00");
    refused("cloud.obj", b"v 0 0 0");
    let message = refused("negative.npy", &npy("(1, 1, 2)", &[1.0, -0.5]));
    assert!(message.contains("-0.5"), "{message}");
}

#[test]
fn nan_and_infinite_voxels_are_repaired_and_said() {
    let folder = folder();
    let bytes = npy("(1, 2, 2)", &[1.0, f32::NAN, f32::INFINITY, 0.5]);
    std::fs::write(folder.path().join("holes.npy"), bytes).unwrap();
    let scene = frozen(&with_density("holes.npy"), folder.path());
    assert_eq!(scene.info.medium(0).unwrap().max_density, 1.0);
    assert!(scene.notices[0].contains("2 voxels"), "{:?}", scene.notices);
}

#[test]
fn an_rgb_grid_is_not_a_density_and_the_other_way_round() {
    let message = refused("colour.npy", &npy("(1, 1, 1, 3)", &[1.0; 3]));
    assert!(message.contains('3'), "{message}");
    let folder = folder();
    std::fs::write(folder.path().join("grey.npy"), npy("(1, 1, 1)", &[1.0])).unwrap();
    let mut doc = SceneDoc::default();
    doc.medium_mut().density = DensityDoc::RgbGrid(GridRef { file: "grey.npy".into(), grid: None });
    assert!(build(&doc, &mut Library::default().with_base(folder.path())).is_err());
}

#[test]
fn an_albedo_grid_above_one_is_refused() {
    let folder = folder();
    std::fs::write(folder.path().join("a.npy"), npy("(1, 1, 1, 3)", &[0.5, 1.5, 0.2])).unwrap();
    let mut doc = SceneDoc::default();
    doc.medium_mut().albedo_grid = Some(GridRef { file: "a.npy".into(), grid: None });
    let message = build(&doc, &mut Library::default().with_base(folder.path())).unwrap_err().to_string();
    assert!(message.contains("albedo_grid") && message.contains("1.5"), "{message}");
}

#[test]
fn phase_tables_are_read_from_files_and_bad_ones_refused() {
    let folder = folder();
    let with_table = |text: &str| {
        std::fs::write(folder.path().join("lobe.csv"), text).unwrap();
        let mut doc = SceneDoc::default();
        doc.medium_mut().phase =
            PhaseDoc::Tabulated { angle: Angle::Degrees, points: Vec::new(), file: "lobe.csv".into() };
        build(&doc, &mut Library::default().with_base(folder.path()))
    };
    let scene = with_table("theta, p\n0, 3\n90, 1\n180, 1\n").unwrap();
    assert_eq!(scene.info.medium(0).unwrap().phase_points, [[0.0, 3.0], [90.0, 1.0], [180.0, 1.0]]);
    // 1 in the backward hemisphere, 1 to 3 in the forward hemisphere: the mean is 1.5.
    let expected = 2.0 / 1.5 / (4.0 * std::f32::consts::PI);
    assert!((scene.media[0].phase.value(0.5) / expected - 1.0).abs() < 1e-5);
    for (text, word) in [
        ("", "0 points"),
        ("0, 1\n90, x\n", "lobe.csv:2"),
        ("0, 1\n90, nan\n", "not finite"),
        ("0, 1\n90, -1\n", "negative"),
        ("90, 1\n0, 1\n", "increase"),
        ("0, 1\n200, 1\n", "outside"),
        ("0, 0\n180, 0\n", "everywhere"),
    ] {
        let message = with_table(text).unwrap_err().to_string();
        assert!(message.contains("medium.phase.file") && message.contains(word), "{text}: {message}");
    }
    let mut doc = SceneDoc::default();
    doc.medium_mut().phase =
        PhaseDoc::Tabulated { angle: Angle::Cosine, points: Vec::new(), file: "no.csv".into() };
    let message = build(&doc, &mut Library::default().with_base(folder.path())).unwrap_err().to_string();
    assert!(message.contains("no.csv"), "{message}");
}

#[test]
fn a_scene_without_light_is_black_and_says_so() {
    let doc = SceneDoc { lights: Vec::new(), ..SceneDoc::default() };
    let scene = frozen(&doc, Path::new(""));
    assert!(scene.notices[0].contains("No light"), "{:?}", scene.notices);
    for entry in majorant_core::estimator::REGISTRY {
        let settings = majorant_core::estimator::Settings::new(&doc.estimator, 0);
        let rgb = (entry.kernel)(
            &scene,
            &settings,
            PathIndex { x: 480, y: 270, sample: 0 },
            CancelToken::NEVER.into(),
        )
        .rgb;
        assert_eq!(rgb.to_array(), [0.0; 3], "{}", entry.id);
    }
}

#[test]
fn pictures_that_are_missing_damaged_or_black() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    for (name, bytes) in [
        ("text.exr", b"no picture".to_vec()),
        ("text.hdr", b"no picture".to_vec()),
        ("cut.exr", vec![0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0]),
        ("what.jpg", vec![0xff, 0xd8]),
    ] {
        std::fs::write(path(name), bytes).unwrap();
        let message = picture::read_panorama(&path(name)).unwrap_err().to_string();
        assert!(message.contains(name), "{message}");
    }
    assert!(picture::read_panorama(&path("gone.exr")).is_err());
    exr::prelude::write_rgb_file(path("black.exr"), 4, 2, |_, _| (0.0f32, 0.0f32, 0.0f32)).unwrap();
    let message = picture::read_panorama(&path("black.exr")).unwrap_err().to_string();
    assert!(message.contains("black"), "{message}");

    // Texels that are not finite are repaired and counted; the others emit light.
    let pixel = |x: usize, _: usize| if x == 0 { (f32::NAN, 1.0, -1.0) } else { (1.0f32, 2.0f32, 3.0f32) };
    exr::prelude::write_rgb_file(path("good.exr"), 4, 2, pixel).unwrap();
    let (_, repaired) = picture::read_panorama(&path("good.exr")).unwrap();
    assert!(
        repaired.len() == 2 && repaired.iter().all(|notice| notice.contains(": 2 texel(s)")),
        "{repaired:?}"
    );
    let map = LightDoc::EnvironmentMap {
        file: "good.exr".into(),
        rotate_deg: 30.0,
        scale: 1.0,
        visible: true,
        enabled: true,
    };
    let doc = SceneDoc { lights: vec![map], ..SceneDoc::default() };
    frozen(&doc, folder.path());

    // Every truncation is an error, without a panic or an excessive allocation.
    let whole = std::fs::read(path("good.exr")).unwrap();
    for cut in (0..whole.len()).step_by(7) {
        std::fs::write(path("part.exr"), &whole[..cut]).unwrap();
        assert!(picture::read_panorama(&path("part.exr")).is_err(), "{cut} bytes");
    }
}

#[test]
fn absurd_scenes_are_refused_by_name() {
    for (text, word) in [
        ("[film]\nwidth = 100000\nheight = 100000", "film"),
        ("[film]\nwidth = 0\nheight = 0", "film"),
        ("[render]\nspp = 0", "spp"),
        ("[render]\nspp = 9223372036854775808", ""),
        ("[render]\nthreads = 0", "threads"),
        ("[render]\nseconds = -1.0", "seconds"),
        ("[medium]\nscale = -1.0", "medium.scale"),
        ("[medium]\nscale = inf", "medium.scale"),
        ("[medium]\nextinction = -2.0", "medium.extinction"),
        ("[medium.majorant]\nfactor = 0.0", "factor"),
        ("[medium.phase]\nkind = \"henyey-greenstein\"\ng = 1.0", "medium.phase.g"),
        ("[medium.phase]\nkind = \"draine\"\ng = 1.0\nalpha = 1.0", "medium.phase.g"),
        ("[medium.phase]\nkind = \"draine\"\ng = 0.0\nalpha = nan", "medium.phase.alpha"),
        ("[medium.phase]\nkind = \"mie\"\ndiameter_um = 0.0", "medium.phase.diameter_um"),
        ("[medium.phase]\nkind = \"tabulated\"", "medium.phase.points"),
        ("[medium.phase]\nkind = \"tabulated\"\npoints = [[0.0, 1.0], [0.5, nan]]", "not finite"),
        ("[medium.phase]\nkind = \"tabulated\"\npoints = [[0.0, 1.0], [0.5, -1.0]]", "negative"),
        ("[medium.phase]\nkind = \"tabulated\"\npoints = [[0.5, 1.0], [0.0, 1.0]]", "increase"),
        (
            "[medium.phase]\nkind = \"tabulated\"\nfile = \"a\"\npoints = [[0.5, 1.0], [0.7, 1.0]]",
            "medium.phase.file",
        ),
        (
            "[medium.coefficients]\nkind = \"mean-free-path-colour\"\nmean_free_path = 0.0\ncolour = 0.5",
            "medium.coefficients.mean_free_path",
        ),
        (
            "[medium.coefficients]\nkind = \"mean-free-path-colour\"\nmean_free_path = { points = \"500:1\", outside = \"zero\" }\ncolour = 0.5",
            "zero beyond",
        ),
        (
            "[medium.coefficients]\nkind = \"mean-free-path-colour\"\nmean_free_path = 1.0\ncolour = 1.5",
            "medium.coefficients.colour",
        ),
        ("[medium.placement]\nfit = 0.0", "fit"),
        ("[camera]\norigin = [0.0, 0.0, 0.0]", "camera.target"),
        ("[camera]\norigin = [0.0, 0.0, 1e-30]", "camera.target"),
        ("[camera]\norigin = [0.0, 0.0, 1e30]", "camera.origin"),
        ("[render]\nseed = 9223372036854775808", ""),
        ("[camera]\nfov_deg = 180.0", "fov_deg"),
        ("[[lights]]\nkind = \"environment-map\"\nfile = \"\"", "file"),
        ("[[objects]]\nkind = \"ground\"\nnormal = [0.0, 0.0, 0.0]", "normal"),
    ] {
        let message =
            scene_file::parse(&format!("majorant = 1\n{text}\n"), "s.toml").unwrap_err().to_string();
        assert!(message.contains(word), "{message}");
    }
    // An optical depth beyond the resolution of positions: a walk would not terminate.
    let mut deep = SceneDoc::default();
    deep.medium_mut().scale = 1e6;
    let message = build(&deep, &mut Library::default()).unwrap_err().to_string();
    assert!(message.contains("medium.scale") && message.contains("optical depth"), "{message}");
    let mut tiny = SceneDoc::default();
    tiny.medium_mut().placement.scale = [1e-11; 3];
    assert!(build(&tiny, &mut Library::default()).is_ok());
    let mut flat = SceneDoc::default();
    flat.medium_mut().placement.scale = [1.0, 0.0, 1.0];
    let message = build(&flat, &mut Library::default()).unwrap_err().to_string();
    assert!(message.contains("placement"), "{message}");
}
