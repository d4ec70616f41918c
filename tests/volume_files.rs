//! Volumes that are part of the project: read exactly, refused with a reason, or repaired.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test may panic, and prints its tables"
)]

use std::path::Path;

use majorant_core::io::volume::{
    GridChoice, GridRole, ReadLimits, Volume, VolumeError, info, info_bytes, read_sparse_volume_bytes,
    read_vdb, read_vdb_bytes, read_volume, validate_density,
};
use majorant_tests::volumes::write::{TinyGrid, vdb};
use majorant_tests::volumes::{self, truth};

#[test]
fn fixtures_are_exact_or_refused() {
    let folder = volumes::fixtures();
    let verdicts = truth::compare(&folder, &folder.join("truth-small.json"));
    truth::print(&verdicts);
    let wrong: Vec<_> = verdicts.iter().filter(|v| v.is_wrong()).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    let refused: Vec<_> = verdicts.iter().filter(|v| v.refused.is_some()).collect();
    let files: Vec<_> = refused.iter().map(|v| v.file.as_str()).collect();
    assert_eq!(files, ["t_mask.vdb", "tree433.vdb"], "{refused:#?}");
    assert_eq!(verdicts.len(), 15);
}

#[test]
fn hostile_chunks_are_refused_before_they_are_unpacked() {
    let files = volumes::files(&volumes::fixtures().join("hostile"));
    let reasons = [
        ("A_oobread.vdb", "Blosc chunk: it unpacks to 1048576 bytes"),
        ("B_oobwrite.vdb", "Blosc chunk: it unpacks to 27 bytes"),
        ("C_short.vdb", "of a file of 17697 bytes"),
        ("D_2GB.vdb", "Blosc chunk: it unpacks to"),
    ];
    assert_eq!(files.len(), reasons.len());
    for (path, (name, reason)) in files.iter().zip(reasons) {
        let error = read_vdb(path, None, &ReadLimits::default()).unwrap_err().to_string();
        assert!(path.ends_with(name) && error.contains(reason), "{error}");
        assert!(error.contains("byte "), "{error}");
        assert!(info(path).map_or(true, |grids| grids.iter().all(|grid| grid.error.is_some())));
    }
}

#[test]
fn missing_magic_number_is_an_error() {
    let mut bytes = std::fs::read(volumes::fixtures().join("gaffer_sphere.vdb")).unwrap();
    bytes[..8].fill(0);
    let error = info_bytes(&bytes, "nomagic.vdb", &ReadLimits::default()).unwrap_err().to_string();
    assert!(error.contains("not an OpenVDB file"), "{error}");
}

#[test]
fn nan_and_infinite_voxels_are_repaired_and_counted() {
    let path = volumes::fixtures().join("nan_inf.vdb");
    let grid = read_volume(&path, Some("density"), &ReadLimits::default()).unwrap();
    assert_eq!((grid.size, grid.repaired, grid.negative), ([4, 1, 1], 2, 1));
    assert!(grid.values.iter().all(|value| value.is_finite()));
    assert_eq!(info(&path).unwrap()[0].non_finite, Some(2));
    let error = validate_density(&grid, &path).unwrap_err().to_string();
    assert!(error.contains("-1") && error.contains("cannot be negative"), "{error}");
}

#[test]
fn level_set_is_read_but_is_no_density() {
    let path = volumes::fixtures().join("tiny_level_set.vdb");
    let error = read_vdb(&path, None, &ReadLimits::default()).unwrap_err().to_string();
    assert!(error.contains("none of its grids is a density") && error.contains("\"surface\""), "{error}");
    let grid = read_vdb(&path, Some("surface"), &ReadLimits::default()).unwrap();
    assert!(grid.level_set && grid.negative > 0);
    let error = validate_density(&grid, &path).unwrap_err();
    assert!(matches!(error, VolumeError::NegativeDensity { level_set: true, .. }));
    assert!(error.to_string().contains("convert it to a fog volume"), "{error}");
}

#[test]
fn grids_are_chosen_by_name() {
    let path = volumes::fixtures().join("usd_densityAndHeat.vdb");
    let limits = ReadLimits::default();
    assert_eq!(read_vdb(&path, None, &limits).unwrap().name, "density");
    assert_eq!(read_vdb(&path, Some("heat"), &limits).unwrap().name, "heat");
    let error = read_vdb(&path, Some("smoke"), &limits).unwrap_err().to_string();
    assert!(error.contains("\"smoke\""), "{error}");
    assert!(error.contains("\"density\", \"heat\""), "{error}");
    // Without a grid of the default name, one with a similar name is chosen.
    let torus = volumes::fixtures().join("arnold_torus01.vdb");
    assert_eq!(read_vdb(&torus, None, &limits).unwrap().name, "voxel_fog_density");
    let vectors = volumes::fixtures().join("tiny_vector.vdb");
    assert!(matches!(read_vdb(&vectors, None, &limits), Err(VolumeError::NoSuchGrid { .. })));
    assert_eq!(read_vdb(&vectors, Some("velocity"), &limits).unwrap().channels, 3);
    let empty = volumes::fixtures().join("nogrids.vdb");
    assert!(info(&empty).unwrap().is_empty());
    assert!(matches!(read_vdb(&empty, None, &limits), Err(VolumeError::NoSuchGrid { .. })));
}

#[test]
fn every_voxel_is_in_its_place() {
    // The value of the ball in `make_tiny.py` is a ramp over its array, x slowest.
    let grid = read_vdb(&volumes::fixtures().join("tiny_affine.vdb"), None, &ReadLimits::default());
    let grid = grid.unwrap();
    assert_eq!((grid.size, grid.min_index), ([11; 3], [3, 4, 5]));
    for (i, &value) in grid.values.iter().enumerate() {
        let (x, y, z) = (i % 11, i / 11 % 11, i / 121);
        let squared: usize = [x, y, z].map(|n| n.abs_diff(5).pow(2)).iter().sum();
        let ramp = ((x * 11 + y) * 11 + z) as f32 / 1331.0 + 0.125;
        assert_eq!(value, if squared <= 25 { ramp } else { 0.0 }, "voxel {x} {y} {z}");
    }
}

#[test]
fn limits_are_kept_and_named() {
    let path = volumes::fixtures().join("tiny_root_tile.vdb");
    let bytes = std::fs::read(&path).unwrap();
    let read = |limits: ReadLimits| read_vdb_bytes(&bytes, "bomb.vdb", None, &limits).unwrap_err();
    let error = read(ReadLimits::default());
    assert!(matches!(error, VolumeError::TooLarge { .. }), "{error}");
    assert!(error.to_string().contains("8192 × 4116 × 4116"), "{error}");
    let error = read(ReadLimits { max_tree_bytes: 1000, ..ReadLimits::default() });
    assert!(error.to_string().contains("unpacked tree"), "{error}");
    let limits = ReadLimits { max_file_bytes: 1000, ..ReadLimits::default() };
    let error = read_vdb(&path, None, &limits).unwrap_err();
    assert!(error.to_string().contains("1000 bytes"), "{error}");
    let missing = read_volume(Path::new("missing.vdb"), None, &limits).unwrap_err().to_string();
    assert!(missing.starts_with("missing.vdb: cannot be read"), "{missing}");
}

#[test]
fn info_has_the_promised_keys() {
    let grids = info(&volumes::fixtures().join("gaffer_sphere.vdb")).unwrap();
    let json = serde_json::to_value(&grids[0]).unwrap();
    let keys: Vec<_> = json.as_object().unwrap().keys().map(String::as_str).collect();
    let mut expected =
        ["name", "type", "class", "half", "map", "active_voxels", "min", "max", "mean", "bbox", "background"];
    expected.sort_unstable();
    assert_eq!(keys, expected);
    let refused = info(&volumes::fixtures().join("t_mask.vdb")).unwrap();
    let json = serde_json::to_value(&refused[0]).unwrap();
    assert!(json["error"].as_str().unwrap().contains("mask grid"));
    assert!(json.get("active_voxels").is_none() && json["type"] == "Tree_mask_5_4_3");
}

#[test]
fn a_refused_grid_leaves_the_others_readable() {
    let mut bytes = std::fs::read(volumes::fixtures().join("usd_densityAndHeat.vdb")).unwrap();
    let kind = b"Tree_float_5_4_3";
    let at = bytes.windows(kind.len()).position(|window| window == kind).unwrap();
    bytes[at..at + kind.len()].copy_from_slice(b"Tree_vec3i_5_4_3");
    let limits = ReadLimits::default();
    let grids = info_bytes(&bytes, "two.vdb", &limits).unwrap();
    let refused = grids[0].error.as_deref().unwrap();
    assert!(refused.contains("two.vdb, grid \"density\"") && refused.contains("vec3i"), "{refused}");
    assert!(grids[1].error.is_none());
    assert_eq!(read_vdb_bytes(&bytes, "two.vdb", Some("heat"), &limits).unwrap().name, "heat");
    assert!(read_vdb_bytes(&bytes, "two.vdb", None, &limits).is_err(), "density is not replaced");
}

/// Name and notices of the grid chosen for a role, by both readers of a file with float grids of the given
/// names and classes.
fn chosen(grids: &[(&str, &str)], role: GridRole) -> Result<(String, Vec<String>), String> {
    let grids: Vec<_> =
        grids.iter().map(|(name, class)| TinyGrid { name, class, ..TinyGrid::default() }).collect();
    let file = vdb(224, false, &grids);
    let limits = ReadLimits::default();
    let choice = GridChoice { name: None, role };
    let sparse = read_sparse_volume_bytes(&file, "a.vdb", choice, &limits, &|_| ());
    let sparse = sparse.map(|volume| match volume {
        Volume::Array(grid) => (grid.name, grid.notices),
        Volume::Blocks(grid) => (grid.name, grid.notices),
    });
    if role == GridRole::Density {
        let dense = read_vdb_bytes(&file, "a.vdb", None, &limits).map(|grid| (grid.name, grid.notices));
        assert_eq!(
            dense.map_err(|e| e.to_string()),
            sparse.as_ref().map(Clone::clone).map_err(ToString::to_string)
        );
    }
    sparse.map_err(|error| error.to_string())
}

#[test]
fn the_density_is_found_by_name_and_class_and_told() {
    let fog = "fog volume";
    for (names, expected) in [
        (&["temperature", "Density"][..], "Density"),
        (&["Density", "density"], "density"),
        (&["heat", "flame", "smoke"], "smoke"),
        (&["velocity", "Fog"], "Fog"),
        (&["fuel", "SOOT"], "SOOT"),
        (&["temp", ""], ""),
        (&["grid", "smoke"], "smoke"),
        (&["smoke", "density"], "density"),
        (&["vel.x", "vel.y", "vel.z", "airDensity"], "airDensity"),
        (&["temperature", "grid"], "grid"),
        (&["heat", "density", "density\x1e1"], "density"),
    ] {
        let grids: Vec<_> = names.iter().map(|name| (*name, fog)).collect();
        let (name, notices) = chosen(&grids, GridRole::Density).unwrap();
        assert_eq!(name, expected, "{names:?}");
        assert!(notices.len() == 1 && notices[0].starts_with("a.vdb: "), "{notices:?}");
        assert!(notices[0].contains(&format!("{expected:?} is read as the density")), "{notices:?}");
        assert!(notices[0].contains("medium.density.grid"), "{notices:?}");
    }
    // Without alternatives there is no notice.
    for grids in [&[("density", fog)][..], &[("temperature", fog), ("density", fog), ("v", "unknown")]] {
        assert_eq!(chosen(grids, GridRole::Density).unwrap(), ("density".into(), Vec::new()));
    }
    // By class, if the names are not informative.
    let by_class = [("a", "level set"), ("b", "unknown"), ("c", fog)];
    assert_eq!(chosen(&by_class, GridRole::Density).unwrap().0, "c");
    assert_eq!(chosen(&by_class[..2], GridRole::Density).unwrap().0, "b");
}

#[test]
fn what_is_no_density_is_refused_with_the_list_and_the_key() {
    let fog = "fog volume";
    for grids in [
        &[("temperature", fog)][..],
        &[("Temperature", fog), ("velocity", "unknown")],
        &[("heat", fog), ("flames", fog), ("fuel", fog)],
        &[("smoke", "level set")],
        &[("Density", "level set"), ("sdf", fog)],
        &[("surface", "unknown")],
        &[("v", "unknown")],
    ] {
        let error = chosen(grids, GridRole::Density).unwrap_err();
        assert!(error.contains("none of its grids is a density"), "{error}");
        assert!(error.contains("medium.density.grid"), "{error}");
        assert!(grids.iter().all(|(name, _)| error.contains(&format!("{name:?}"))), "{error}");
    }
    // A vector grid is not a density, whatever its class, but can be read by name.
    let vectors = TinyGrid { name: "smoke", values: "vec3s", ..TinyGrid::default() };
    let file = vdb(224, false, &[vectors]);
    assert!(read_vdb_bytes(&file, "a.vdb", None, &ReadLimits::default()).is_err());
    assert_eq!(read_vdb_bytes(&file, "a.vdb", Some("smoke"), &ReadLimits::default()).unwrap().channels, 3);
}

#[test]
fn a_temperature_is_never_a_density() {
    let fog = "fog volume";
    for (names, expected) in [
        (&["density", "temperature"][..], "temperature"),
        (&["density", "Temperature"], "Temperature"),
        (&["smoke", "flame", "heat"], "flame"),
        (&["density", "heat", "temperature"], "temperature"),
    ] {
        let grids: Vec<_> = names.iter().map(|name| (*name, fog)).collect();
        assert_eq!(chosen(&grids, GridRole::Temperature).unwrap().0, expected, "{names:?}");
    }
    let error = chosen(&[("density", fog), ("velocity", fog)], GridRole::Temperature).unwrap_err();
    assert!(error.contains("none of its grids is a temperature"), "{error}");
    assert!(error.contains("medium.emission.temperature.grid"), "{error}");
}

/// The file with another version number.
fn with_version(bytes: &[u8], version: u32) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    bytes[8..12].copy_from_slice(&version.to_le_bytes());
    bytes
}

#[test]
fn newer_file_versions_are_read_as_the_newest_known() {
    let limits = ReadLimits::default();
    let mut compared = 0;
    for path in volumes::files(&volumes::fixtures()) {
        let bytes = std::fs::read(&path).unwrap();
        // The layout of these files is the same from version 222 to 225.
        if path.extension().is_none_or(|e| e != "vdb") || bytes[8] < 222 {
            continue;
        }
        let described = |version| {
            let grids = info_bytes(&with_version(&bytes, version), "a.vdb", &limits).unwrap();
            serde_json::to_value(&grids).unwrap()
        };
        let expected = info_bytes(&bytes, "a.vdb", &limits).unwrap();
        assert_eq!(described(225), serde_json::to_value(&expected).unwrap(), "{}", path.display());
        for grid in expected.iter().filter(|grid| grid.error.is_none() && grid.active_voxels < Some(1 << 24))
        {
            let read = |bytes: &[u8]| read_vdb_bytes(bytes, "a.vdb", Some(&grid.name), &limits).unwrap();
            let (old, new, newer) =
                (read(&bytes), read(&with_version(&bytes, 225)), read(&with_version(&bytes, 226)));
            assert!(old.values == new.values && old.values == newer.values, "{}", path.display());
            assert!(new.notices.is_empty(), "{:?}", new.notices);
            assert!(
                newer.notices.len() == 1 && newer.notices[0].contains("version 226"),
                "{:?}",
                newer.notices
            );
            compared += 1;
        }
    }
    assert!(compared >= 8, "{compared} grids");
    // Errors in files of a newer version mention the version.
    let bytes = std::fs::read(volumes::fixtures().join("gaffer_sphere.vdb")).unwrap();
    let cut = with_version(&bytes[..bytes.len() - 100], 240);
    let error = read_vdb_bytes(&cut, "a.vdb", None, &limits).unwrap_err().to_string();
    assert!(error.contains("version 240") && error.contains("225"), "{error}");
    let old = read_vdb_bytes(&with_version(&bytes, 219), "a.vdb", None, &limits).unwrap_err().to_string();
    assert!(old.contains("version 219") && old.contains("220 to 225"), "{old}");
}

#[test]
fn native_half_grids_are_read() {
    let limits = ReadLimits::default();
    let read = |version, zip, grid: TinyGrid| {
        read_vdb_bytes(&vdb(version, zip, &[grid]), "a.vdb", None, &limits).unwrap().values
    };
    let float = TinyGrid::default();
    let expected = read(224, false, float);
    assert!(expected.len() == 512 && expected.contains(&1.0) && expected.contains(&(1.0 / 512.0)));
    for zip in [false, true] {
        assert_eq!(read(224, zip, float), expected);
        assert_eq!(read(225, zip, TinyGrid { saved_as_half: true, ..float }), expected, "zip: {zip}");
        let native = TinyGrid { values: "half", ..float };
        assert_eq!(read(225, zip, native), expected, "zip: {zip}");
        let grids = info_bytes(&vdb(225, zip, &[native]), "a.vdb", &limits).unwrap();
        assert!(grids[0].half && grids[0].kind == "Tree_half_5_4_3" && grids[0].error.is_none());
    }
}
