//! NumPy and Mitsuba volumes, encoded by the tests.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test may panic, and prints its tables"
)]

use majorant_core::io::volume::{
    ReadLimits, SampleConvention, VolumeError, VoxelGrid, read_volume, read_volume_bytes,
};
use majorant_tests::volumes;

fn read(bytes: &[u8], label: &str) -> Result<VoxelGrid, VolumeError> {
    read_volume_bytes(bytes, label, None, &ReadLimits::default())
}

fn refusal(bytes: &[u8], label: &str) -> String {
    let message = read(bytes, label).unwrap_err().to_string();
    assert!(message.starts_with(label), "{message}");
    message
}

fn npy(version: u8, descr: &str, order: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let header = format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}       \n");
    let mut bytes = b"\x93NUMPY".to_vec();
    bytes.extend([version, 0]);
    let len = header.len() as u32;
    bytes.extend(&len.to_le_bytes()[..if version == 1 { 2 } else { 4 }]);
    bytes.extend(header.as_bytes());
    bytes.extend(data);
    bytes
}

fn f32s(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

fn vol(encoding: i32, size: [i32; 3], channels: i32, data: &[u8]) -> Vec<u8> {
    let mut bytes = b"VOL\x03".to_vec();
    for word in [encoding, size[0], size[1], size[2], channels] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend(f32s(&[-1.0, 0.0, 2.0, 1.0, 3.0, 4.0]));
    bytes.extend(data);
    bytes
}

#[test]
fn npy_axes_are_z_y_x() {
    let values: Vec<f32> = (0..24).map(|n| n as f32).collect();
    for version in [1, 2, 3] {
        let grid = read(&npy(version, "<f4", "False", "(2, 3, 4)", &f32s(&values)), "a.npy");
        let grid = grid.unwrap();
        assert_eq!((grid.size, grid.channels), ([4, 3, 2], 1));
        assert_eq!(grid.voxel([1, 2, 1]), Some([21.0].as_slice()));
        assert_eq!(grid.convention, SampleConvention::CellCentred);
        let (min, max) = grid.world_corners();
        assert_eq!((min.to_array(), max.to_array()), ([0.0; 3], [1.0, 0.75, 0.5]));
    }
    let grid = read(&npy(1, "<f4", "False", "(2, 2, 2, 3)", &f32s(&values)), "a.npy").unwrap();
    assert_eq!((grid.size, grid.channels), ([2; 3], 3));
    assert_eq!(grid.voxel([1, 0, 1]), Some([15.0, 16.0, 17.0].as_slice()));
}

#[test]
fn npy_element_types() {
    let half = [0x00, 0x3c, 0x00, 0xc0]; // 1, -2
    let grid = read(&npy(1, "<f2", "False", "(1, 1, 2)", &half), "a.npy").unwrap();
    assert_eq!((grid.values, grid.negative), (vec![1.0, -2.0], 1));
    let double = [0.25_f64.to_le_bytes(), f64::NAN.to_le_bytes()].concat();
    let grid = read(&npy(1, "<f8", "False", "(1, 1, 2)", &double), "a.npy").unwrap();
    assert_eq!((grid.values, grid.repaired), (vec![0.25, 0.0], 1));
    let grid = read(&npy(1, "|u1", "False", "(1, 2, 1)", &[7, 255]), "a.npy").unwrap();
    assert_eq!(grid.values, [7.0, 255.0]);
}

#[test]
fn npy_refusals_name_the_cure() {
    let data = f32s(&[0.0; 8]);
    let cases = [
        (npy(1, "<f4", "True", "(2, 2, 2)", &data), "ascontiguousarray"),
        (npy(1, ">f4", "False", "(2, 2, 2)", &data), "astype('<f4')"),
        (npy(1, "<f4", "False", "(8,)", &data), "three axes"),
        (npy(1, "<f4", "False", "(2, 2, 2, 4)", &data), "three axes"),
        (npy(1, "<f4", "False", "(2, 0, 2)", &data), "no voxels"),
        (npy(1, "<f4", "False", "(2, 2, 3)", &data), "48 bytes of values expected, but 32 follow"),
        (npy(1, "<f4", "False", "(4294967295, 4294967295, 4294967295)", &data), "limit"),
        (npy(1, "<f4", "False", "(99999999999999999999, 1, 1)", &data), "'shape'"),
        (npy(4, "<f4", "False", "(2, 2, 2)", &data), "version 4"),
        (b"\x93NUMPY\x02\0\xff\xff\xff\xff".to_vec(), "header of 4294967295 bytes"),
        (b"NUMPY".to_vec(), "magic number"),
    ];
    for (bytes, reason) in cases {
        let message = refusal(&bytes, "a.npy");
        assert!(message.contains(reason), "{message}");
    }
}

#[test]
fn vol_has_its_box_and_x_fastest() {
    let values: Vec<f32> = (0..12).map(|n| n as f32).collect();
    let grid = read(&vol(1, [2, 3, 2], 1, &f32s(&values)), "a.vol").unwrap();
    assert_eq!((grid.size, grid.channels), ([2, 3, 2], 1));
    assert_eq!(grid.voxel([1, 2, 1]), Some([11.0].as_slice()));
    let (min, max) = grid.world_corners();
    assert_eq!((min.to_array(), max.to_array()), ([-1.0, 0.0, 2.0], [1.0, 3.0, 4.0]));
    let grid = read(&vol(1, [2, 1, 2], 3, &f32s(&values)), "a.vol").unwrap();
    assert_eq!(grid.voxel([1, 0, 0]), Some([3.0, 4.0, 5.0].as_slice()));
    let grid = read(&vol(2, [1, 1, 2], 1, &[0x00, 0x3c, 0x00, 0x38]), "a.vol").unwrap();
    assert_eq!(grid.values, [1.0, 0.5]);
    let grid = read(&vol(3, [2, 1, 1], 1, &[0, 255]), "a.vol").unwrap();
    assert_eq!(grid.values, [0.0, 1.0]);
}

#[test]
fn vol_refusals_name_the_cure() {
    let mut empty_box = vol(1, [1, 1, 1], 1, &f32s(&[1.0]));
    empty_box[36..40].copy_from_slice(&(-1.0_f32).to_le_bytes());
    let mut version = vol(1, [1, 1, 1], 1, &f32s(&[1.0]));
    version[3] = 2;
    let cases = [
        (vol(1, [2, 2, 2], 1, &f32s(&[1.0; 7])), "32 bytes of values expected, but 28 follow"),
        (vol(1, [0, 2, 2], 1, &[]), "[0, 2, 2] voxels"),
        (vol(1, [-1, 2, 2], 1, &[]), "[-1, 2, 2] voxels"),
        (vol(1, [i32::MAX; 3], 1, &[]), "limit"),
        (vol(1, [1, 1, 1], 2, &f32s(&[1.0; 2])), "2 channels"),
        (vol(4, [1, 1, 1], 1, &[0]), "encoding 4"),
        (empty_box, "bounding box"),
        (version, "version 2"),
        (b"VO".to_vec(), "VOL"),
    ];
    for (bytes, reason) in cases {
        let message = refusal(&bytes, "a.vol");
        assert!(message.contains(reason), "{message}");
    }
}

#[test]
fn formats_are_told_apart() {
    let array = npy(1, "<f4", "False", "(1, 1, 1)", &f32s(&[1.0]));
    assert!(read(&array, "no extension").is_ok(), "by the magic number");
    assert!(refusal(&array, "wrong.vdb").contains("not an OpenVDB file"));
    assert!(refusal(b"P6", "picture.ppm").contains(".npy"));
    let error = read_volume_bytes(&array, "a.npy", Some("density"), &ReadLimits::default());
    assert!(matches!(error, Err(VolumeError::NoSuchGrid { .. })));
}

#[test]
fn real_mitsuba_volumes() {
    let Some(folder) = volumes::volumes() else {
        return;
    };
    // Minimum, maximum and mean computed with NumPy; the third file contains negative values.
    for (name, size, channels, min_max, mean, negative) in [
        ("mitsuba_albedo.vol", [16, 16, 16], 3, (9.988575e-6, 1.0), 0.5125000001796375, 0),
        ("lajolla_smoke.vol", [128, 128, 50], 1, (0.0, 1.0), 0.01156106642304237, 0),
        ("lajolla_colored_density.vol", [80, 80, 40], 3, (-0.004004642, 1.5), 0.016962258856129998, 1484),
    ] {
        let grid = read_volume(&folder.join(name), None, &ReadLimits::default()).unwrap();
        assert_eq!((grid.size, grid.channels, grid.negative), (size, channels, negative), "{name}");
        assert_eq!(grid.min_max(), Some(min_max), "{name}");
        assert!((grid.mean() / mean - 1.0).abs() < 1e-12, "{name}: {}", grid.mean());
    }
}
