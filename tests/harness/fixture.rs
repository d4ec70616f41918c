//! Synthetic grids in files.

/// Encodes a grid as a `.npy` file, x fastest.
pub fn npy([nx, ny, nz]: [usize; 3], channels: usize, values: &[f32]) -> Vec<u8> {
    assert_eq!(values.len(), nx * ny * nz * channels);
    let shape = match channels {
        1 => format!("({nz}, {ny}, {nx})"),
        n => format!("({nz}, {ny}, {nx}, {n})"),
    };
    let header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}");
    let padded = format!("{header:<width$}\n", width = (header.len() + 11).next_multiple_of(64) - 11);
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((padded.len() as u16).to_le_bytes());
    bytes.extend(padded.as_bytes());
    bytes.extend(values.iter().flat_map(|v| v.to_le_bytes()));
    bytes
}
