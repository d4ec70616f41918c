//! Reader of OpenVDB files, based on the crate `vdb-rs` with a validating parser in front.
//!
//! `vdb-rs` 0.6.0 unpacks value blocks exactly, but panics on, misreads or drops many features of real files,
//! and is memory-unsafe on damaged Blosc chunks. The work is therefore split:
//!
//! ```text
//! header → archive → preflight ─ walk of the tree ─→ transcript → vdb-rs → sparse ─→ blocks, BlockGrid
//!  magic    grids     head, map   masks, tiles,       one sound    values   stats  └→ dense, VoxelGrid
//!                                 chunks (blosc)      grid
//! ```
//!
//! * [`header`], [`metadata`], [`descriptor`], [`archive`]: list of grids and their byte ranges;
//! * [`value_type`], [`compression`], [`blosc`], [`block`], [`map`], [`mask`]: components of a grid;
//! * [`tree`], [`preflight`]: validation of every size against the length of the file;
//! * [`transcript`]: the rewritten file that is passed to `vdb-rs`;
//! * [`choice`]: selection of a grid without a name;
//! * [`read`], [`sparse`], [`blocks`], [`dense`], [`info`](mod@info): the unpacked tree and its conversions.
//!
//! Supported: half, float, double, int32, int64, vec3s and vec3d grids with the standard 5-4-3 tree; file
//! versions 220 to 225 (newer ones are tried, with a notice) with every compression, half floats, linear
//! maps, instances, tiles, files without offsets. Refused with a message: bool, mask and point grids, other
//! trees, frustum maps.

mod archive;
mod block;
mod blocks;
mod blosc;
mod choice;
mod compression;
mod dense;
mod descriptor;
mod header;
mod info;
mod map;
mod mask;
mod metadata;
mod preflight;
mod read;
mod sparse;
mod transcript;
mod tree;
mod value_type;

use std::path::Path;

pub use self::info::{Background, FileInfo, GridInfo, file_info, info, info_bytes};
pub(super) use header::MAGIC;

use super::blocks::{BlockGrid, Volume};
use super::choice::GridChoice;
use super::error::{Fault, VolumeError};
use super::file;
use super::grid::VoxelGrid;
use super::read_limits::ReadLimits;
use archive::Archive;
use choice::Chosen;
use glam::DAffine3;
use sparse::SparseGrid;

/// Reads one grid of an OpenVDB file into a dense grid over its active bounding box.
///
/// Without a name, the grid whose name resembles a density most is read, never a temperature, velocity or
/// level set. Values are converted to `f32`; inactive voxels get the background; NaN and infinite voxels are
/// set to 0 and counted. Negative values are accepted: see [`validate_density`](super::validate_density).
///
/// # Errors
/// When the file is missing, damaged or too large, the grid is of an unsupported kind, or there is no grid of
/// this name.
pub fn read_vdb(path: &Path, grid: Option<&str>, limits: &ReadLimits) -> Result<VoxelGrid, VolumeError> {
    read_vdb_bytes(&file::read(path, limits)?, &path.display().to_string(), grid, limits)
}

/// [`read_vdb`] for a file in memory; `label` is its path in messages.
///
/// # Errors
/// As [`read_vdb`].
pub fn read_vdb_bytes(
    bytes: &[u8],
    label: &str,
    grid: Option<&str>,
    limits: &ReadLimits,
) -> Result<VoxelGrid, VolumeError> {
    read(bytes, label, grid.into(), limits, &|_| (), |sparse, head| {
        head.array(dense::densify(&sparse, limits)?)
    })
}

/// As [`read_vdb_bytes`], but into blocks if the background is zero, with the completed fraction reported to
/// `watch`.
pub(super) fn read_sparse(
    bytes: &[u8],
    label: &str,
    grid: GridChoice<'_>,
    limits: &ReadLimits,
    watch: &dyn Fn(f64),
) -> Result<Volume, VolumeError> {
    read(bytes, label, grid, limits, watch, |sparse, head| {
        if sparse.background[..sparse.channels].iter().all(|b| *b == 0.0) {
            head.blocks(blocks::blocks(sparse, limits)?).map(Volume::Blocks)
        } else {
            head.array(dense::densify(&sparse, limits)?).map(Volume::Array)
        }
    })
}

/// Class of a grid with signed distances.
const LEVEL_SET: &str = "level set";

/// Data in front of the tree of a grid.
struct Head {
    name: String,
    world_from_index: DAffine3,
    level_set: bool,
    notices: Vec<String>,
}

impl Head {
    fn array(self, voxels: VoxelGrid) -> Result<VoxelGrid, Fault> {
        let Self { name, world_from_index, level_set, notices } = self;
        Ok(VoxelGrid { name, world_from_index, level_set, notices, ..voxels })
    }

    fn blocks(self, blocks: BlockGrid) -> Result<BlockGrid, Fault> {
        let Self { name, world_from_index, level_set, notices } = self;
        Ok(BlockGrid { name, world_from_index, level_set, notices, ..blocks })
    }
}

/// Completed fractions after validation and after unpacking, measured on a cloud of four million voxels.
const CHECKED: f64 = 0.25;
const UNPACKED: f64 = 0.8;

/// Unpacks a grid and converts it with `then`, reporting the completed fraction to `watch`.
fn read<T>(
    bytes: &[u8],
    label: &str,
    grid: GridChoice<'_>,
    limits: &ReadLimits,
    watch: &dyn Fn(f64),
    then: impl FnOnce(SparseGrid, Head) -> Result<T, Fault>,
) -> Result<T, VolumeError> {
    let archive = Archive::open(bytes, &|archive, index| preflight::end_of_grid(archive, index, limits))
        .map_err(|fault| fault.in_file(label, None))?;
    let Chosen { index, preflight, notices } = choice::choose(&archive, label, grid, limits)?;
    let name = &archive.grids[index].display_name;
    let unpack = || {
        let head = Head {
            name: name.clone(),
            world_from_index: preflight.world_from_index,
            level_set: preflight.class == LEVEL_SET,
            notices,
        };
        watch(CHECKED);
        let sparse = read::unpack(preflight, &|share| watch(CHECKED + share * (UNPACKED - CHECKED)))?;
        watch(UNPACKED);
        let read = then(sparse, head)?;
        watch(1.0);
        Ok(read)
    };
    unpack().map_err(|fault: Fault| archive.header.blamed(fault).in_file(label, Some(name)))
}
