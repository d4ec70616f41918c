//! Grids that cases make up: small, rough, and the same on every machine.

use super::truth::Lattice3;

/// A grid as the bytes of a `.npy` file, which is how a scene gets it: reading is checked as well.
pub(super) fn npy([nx, ny, nz]: [usize; 3], channels: usize, values: &[f32]) -> Vec<u8> {
    let shape = match channels {
        1 => format!("({nz}, {ny}, {nx})"),
        n => format!("({nz}, {ny}, {nx}, {n})"),
    };
    let header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}");
    // The format wants the values to begin at a multiple of 64 bytes.
    let padded = format!("{header:<width$}\n", width = (header.len() + 11).next_multiple_of(64) - 11);
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((padded.len() as u16).to_le_bytes());
    bytes.extend(padded.as_bytes());
    bytes.extend(values.iter().flat_map(|v| v.to_le_bytes()));
    bytes
}

/// Values between 0 and 1 without any pattern.
pub(super) fn rough(count: usize) -> impl Iterator<Item = f32> {
    // Weyl's sequence of the golden ratio's square, folded: neighbours are unlike each other.
    (1..=count).map(|i| {
        ((i as f64 * 0.381_966_011_250_105).fract() * (i as f64 * 0.754_877_666).fract()).sqrt() as f32
    })
}

/// A rough lattice, every value in `keep` of 7 kept and the others 0.
pub(super) fn rough_lattice(size: [usize; 3], keep: usize) -> Lattice3 {
    let values = rough(size.iter().product());
    let values = values.enumerate().map(|(i, v)| if i * 5 % 7 < keep { v } else { 0.0 }).collect();
    Lattice3 { size, values }
}

impl Lattice3 {
    /// The bytes of a `.npy` file.
    pub fn npy(&self) -> Vec<u8> {
        npy(self.size, 1, &self.values)
    }
}
