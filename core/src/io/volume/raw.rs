//! Raw float32 voxels without a header, x fastest, then y, then z, little-endian.
//!
//! The size is part of the file name, x × y × z, as in `smoke_64x64x96.raw`. The transformation is that of
//! `.npy` files.

use std::path::Path;

use super::cursor::Cursor;
use super::error::{Fault, VolumeError};
use super::grid::VoxelGrid;
use super::npy::{chunks, data};
use super::read_limits::{ReadLimits, allocate};

/// Reads a raw file in memory; `label` is its path, with the size.
///
/// # Errors
/// When the name contains no size, the number of bytes does not match, or the grid exceeds the limits.
pub fn read_raw_bytes(bytes: &[u8], label: &str, limits: &ReadLimits) -> Result<VoxelGrid, VolumeError> {
    read(bytes, label, limits).map_err(|fault| fault.in_file(label, None))
}

fn read(bytes: &[u8], label: &str, limits: &ReadLimits) -> Result<VoxelGrid, Fault> {
    let size = size_in_name(label).ok_or_else(|| {
        let cure = "Put the size into the name, x × y × z: smoke_64x64x96.raw";
        Fault::unsupported("a raw file without the size in its name", cure)
    })?;
    let len = limits.dense_values(size.map(|n| n as u64), 1)?;
    let mut cursor = Cursor::new(bytes);
    let data = data(&mut cursor, len, 4)?;
    let mut values = allocate(len)?;
    values.extend(chunks(data).map(f32::from_le_bytes));
    Ok(VoxelGrid::without_place(size, 1, values))
}

/// The last `NxNxN` in a file name.
fn size_in_name(label: &str) -> Option<[usize; 3]> {
    let stem = Path::new(label).file_stem()?.to_str()?;
    let words = stem.split(|c: char| !(c.is_ascii_digit() || c == 'x'));
    words.rev().find_map(|word| {
        let mut sides = word.split('x').map(|n| n.parse().ok().filter(|n: &usize| *n > 0));
        let size = [sides.next()??, sides.next()??, sides.next()??];
        sides.next().is_none().then_some(size)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_holds_the_size() {
        assert_eq!(size_in_name("a/smoke_64x32x96.raw"), Some([64, 32, 96]));
        assert_eq!(size_in_name("2x2x2-old-3x4x5.raw"), Some([3, 4, 5]));
        for bad in ["smoke.raw", "smoke_64x64.raw", "smoke_0x1x1.raw", "smoke_1x2x3x4.raw"] {
            assert_eq!(size_in_name(bad), None, "{bad}");
        }
    }

    #[test]
    fn voxels_are_read_x_fastest_and_counted() {
        let bytes: Vec<u8> = (0..6u8).flat_map(|i| f32::from(i).to_le_bytes()).collect();
        let read = |label| read_raw_bytes(&bytes, label, &ReadLimits::default());
        let grid = read("r_3x2x1.raw").unwrap();
        assert_eq!(grid.voxel([2, 1, 0]), Some(&[5.0][..]));
        let message = read("r_3x2x2.raw").unwrap_err().to_string();
        assert!(message.contains("48 bytes") && message.contains("r_3x2x2.raw"), "{message}");
        assert!(read("r.raw").unwrap_err().to_string().contains("64x64x96"));
    }
}
