//! Procedural grids for cases: small, rough, and identical on every machine.

use super::truth::Lattice3;

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
