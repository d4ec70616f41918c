//! Procedural grids for cases: small, rough, and identical on every machine.

use super::truth::Lattice3;
use glam::DVec3;

/// A grid as the bytes of a `.npy` file, in which form a scene reads it, so that the reader is tested as
/// well.
pub(super) fn npy([nx, ny, nz]: [usize; 3], channels: usize, values: &[f32]) -> Vec<u8> {
    let shape = match channels {
        1 => format!("({nz}, {ny}, {nx})"),
        n => format!("({nz}, {ny}, {nx}, {n})"),
    };
    let header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}");
    // The format requires the values to begin at a multiple of 64 bytes.
    let padded = format!("{header:<width$}\n", width = (header.len() + 11).next_multiple_of(64) - 11);
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((padded.len() as u16).to_le_bytes());
    bytes.extend(padded.as_bytes());
    bytes.extend(values.iter().flat_map(|v| v.to_le_bytes()));
    bytes
}

/// A box as an OBJ file, by quadrilaterals whose corners are counter-clockwise as seen from outside.
pub(super) fn obj_box(lo: DVec3, hi: DVec3) -> String {
    obj_boxes(&[(lo, hi)])
}

fn obj_boxes(boxes: &[(DVec3, DVec3)]) -> String {
    let mut text = String::new();
    for (index, (lo, hi)) in boxes.iter().enumerate() {
        for corner in 0..8u8 {
            let pick = |axis: usize| if corner >> axis & 1 == 0 { lo[axis] } else { hi[axis] };
            text += &format!("v {} {} {}\n", pick(0), pick(1), pick(2));
        }
        let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        for face in faces {
            let [a, b, c, d] = face.map(|corner| 8 * index + corner + 1);
            text += &format!("f {a} {b} {c} {d}\n");
        }
    }
    text
}

/// Two boxes apart along x, −0.9 to −0.3 and 0.25 to 0.8, as one mesh.
pub(super) fn two_boxes() -> String {
    let half = DVec3::new(0.0, 0.6, 0.7);
    let at = |from: f64, to: f64| (DVec3::X * from - half, DVec3::X * to + half);
    obj_boxes(&[at(-0.9, -0.3), at(0.25, 0.8)])
}

/// Length of the axis within both boxes.
pub(super) const TWO_BOXES_LENGTH: f64 = 0.6 + 0.55;

/// Length of the axis within the boxes beyond x = −0.2.
pub(super) const TWO_BOXES_BELOW: f64 = 0.55;

/// An octahedron with the normals of a sphere as an OBJ file: far from those of its faces.
pub(super) fn smooth_octahedron() -> String {
    let mut text = String::new();
    for [x, y, z] in [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]] {
        text += &format!("v {x} {y} {z}\nvn {x} {y} {z}\n");
    }
    let faces = [[1, 3, 5], [5, 3, 2], [2, 3, 6], [6, 3, 1], [5, 4, 1], [2, 4, 5], [6, 4, 2], [1, 4, 6]];
    for face in faces {
        let [a, b, c] = face.map(|index| format!("{index}//{index}"));
        text += &format!("f {a} {b} {c}\n");
    }
    text
}

/// A torus about the y axis as an OBJ file.
pub(super) fn torus(radius: f64, tube: f64, [around, across]: [usize; 2]) -> String {
    use std::f64::consts::TAU;
    let mut text = String::new();
    for i in 0..around {
        let (sin, cos) = (TAU * i as f64 / around as f64).sin_cos();
        for j in 0..across {
            let (up, out) = (TAU * j as f64 / across as f64).sin_cos();
            let r = radius + tube * out;
            text += &format!("v {} {} {}\n", r * cos, tube * up, r * sin);
        }
    }
    for i in 0..around {
        for j in 0..across {
            let at = |i: usize, j: usize| (i % around) * across + j % across + 1;
            text += &format!("f {} {} {} {}\n", at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
        }
    }
    text
}

/// Values between 0 and 1 without a pattern.
pub(super) fn rough(count: usize) -> impl Iterator<Item = f32> {
    // Weyl's sequence of the squared golden ratio, folded, so that neighbours differ.
    (1..=count).map(|i| {
        ((i as f64 * 0.381_966_011_250_105).fract() * (i as f64 * 0.754_877_666).fract()).sqrt() as f32
    })
}

/// A rough lattice in which `keep` of every 7 values are kept and the others are 0.
pub(super) fn rough_lattice(size: [usize; 3], keep: usize) -> Lattice3 {
    let values = rough(size.iter().product());
    let values = values.enumerate().map(|(i, v)| if i * 5 % 7 < keep { v } else { 0.0 }).collect();
    Lattice3 { size, values }
}

impl Lattice3 {
    /// Encodes the lattice as a `.npy` file.
    pub fn npy(&self) -> Vec<u8> {
        npy(self.size, 1, &self.values)
    }
}
