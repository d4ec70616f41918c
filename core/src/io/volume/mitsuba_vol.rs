//! Mitsuba `.vol` volumes, version 3.
//!
//! Format: Mitsuba 0.6 documentation, section "Grid-based volume data source (gridvolume)", and
//! <https://mitsuba.readthedocs.io/en/stable/src/generated/plugins_volumes.html>. Little-endian:
//!
//! | bytes | content |
//! | --- | --- |
//! | 0–3 | `VOL` and the version, 3 |
//! | 4–7 | encoding: 1 float32, 2 float16, 3 uint8 (0 to 255 stand for 0 to 1) |
//! | 8–19 | voxels along x, y, z |
//! | 20–23 | channels |
//! | 24–47 | bounding box: min x, y, z, max x, y, z, in world units (float32) |
//! | 48– | values; channel fastest, then x, y, z |

use glam::{DAffine3, DMat3, DVec3};
use half::f16;

use super::cursor::Cursor;
use super::error::{Fault, VolumeError};
use super::grid::VoxelGrid;
use super::npy::{chunks, data};
use super::read_limits::{ReadLimits, allocate};

/// First bytes of every `.vol` file.
pub(super) const MAGIC: &[u8] = b"VOL";

const VERSION: u8 = 3;

/// Reads a `.vol` file in memory; `label` is its path in messages.
///
/// # Errors
/// When the header is malformed, the encoding or the number of channels is not supported, the number of bytes
/// does not match, or the volume exceeds the limits.
pub fn read_mitsuba_vol_bytes(
    bytes: &[u8],
    label: &str,
    limits: &ReadLimits,
) -> Result<VoxelGrid, VolumeError> {
    read(bytes, limits).map_err(|fault| fault.in_file(label, None))
}

fn read(bytes: &[u8], limits: &ReadLimits) -> Result<VoxelGrid, Fault> {
    let mut cursor = Cursor::new(bytes);
    if cursor.take(MAGIC.len()).ok() != Some(MAGIC) {
        return Err(Fault::invalid(0, "this is not a Mitsuba volume: it does not start with VOL"));
    }
    let version = cursor.u8()?;
    if version != VERSION {
        return Err(Fault::unsupported(
            format!("Mitsuba volume version {version}"),
            "Write the file with mitsuba.VolumeGrid (version 3)",
        ));
    }
    let encoding = cursor.i32()?;
    let at = cursor.position();
    let extents = cursor.i32x3()?;
    let size = extents.map(|n| usize::try_from(n).unwrap_or(0));
    if size.contains(&0) {
        return Err(Fault::invalid(at, format!("a volume of {extents:?} voxels")));
    }
    let channels = match cursor.i32()? {
        1 => 1,
        3 => 3,
        other => {
            return Err(Fault::unsupported(
                format!("{other} channels"),
                "Write the volume with 1 channel (density) or 3 (albedo, colour)",
            ));
        }
    };
    let world_from_index = bounding_box(&mut cursor, size)?;
    let len = limits.dense_values(size.map(|n| n as u64), channels)?;
    let mut values = allocate(len)?;
    match encoding {
        1 => values.extend(chunks(data(&mut cursor, len, 4)?).map(f32::from_le_bytes)),
        2 => {
            let halves = chunks(data(&mut cursor, len, 2)?).map(f16::from_le_bytes);
            values.extend(halves.map(f16::to_f32));
        }
        3 => values.extend(data(&mut cursor, len, 1)?.iter().map(|&byte| f32::from(byte) / 255.0)),
        other => {
            return Err(Fault::unsupported(
                format!("encoding {other}"),
                "Write the volume as float32 (encoding 1)",
            )
            .at(4));
        }
    }
    Ok(VoxelGrid::cell_centred(size, channels, values, world_from_index))
}

/// World from index: index (0, 0, 0) at the minimum of the box, `size` at its maximum.
fn bounding_box(cursor: &mut Cursor, size: [usize; 3]) -> Result<DAffine3, Fault> {
    let at = cursor.position();
    let mut corner = || {
        let corner = [cursor.f32()?, cursor.f32()?, cursor.f32()?];
        Ok::<_, Fault>(DVec3::from(corner.map(f64::from)))
    };
    let (min, max) = (corner()?, corner()?);
    if !(min.is_finite() && max.is_finite() && max.cmpgt(min).all()) {
        return Err(Fault::invalid(at, format!("the bounding box from {min} to {max} is empty"))
            .with_cure("Write the file again with a bounding box whose maximum exceeds its minimum"));
    }
    let voxel = (max - min) / DVec3::from(size.map(|n| n as f64));
    Ok(DAffine3::from_mat3_translation(DMat3::from_diagonal(voxel), min))
}
