//! Validation of a grid before its bytes reach `vdb-rs`.

use glam::DAffine3;

use super::super::error::Fault;
use super::super::read_limits::ReadLimits;
use super::archive::Archive;
use super::block::BlockFormat;
use super::descriptor::GridDescriptor;
use super::transcript::Transcript;
use super::tree::{Topology, Walk};
use super::value_type::ValueType;

/// A validated grid.
#[derive(Debug)]
pub(super) struct Preflight {
    /// Input for `vdb-rs`.
    pub(super) transcript: Vec<u8>,
    pub(super) format: BlockFormat,
    pub(super) topology: Topology,
    pub(super) world_from_index: DAffine3,
    /// Grid class in the file, for example `fog volume`.
    pub(super) class: String,
    /// Number of active voxels stated by the writer.
    pub(super) voxel_count: Option<i64>,
    /// First and last active index coordinates stated by the writer.
    pub(super) bbox: Option<[i32; 6]>,
}

/// Validates grid `index` from its descriptor to its last leaf.
pub(super) fn check(archive: &Archive, index: usize, limits: &ReadLimits) -> Result<Preflight, Fault> {
    let grid = descriptor(archive, index)?;
    let head = archive.grid_head(grid)?;
    let (world_from_index, _) = head.map?;
    let owner = archive.tree_owner(grid)?;
    let WalkedTree { transcript, format, topology, .. } = walk(archive, owner, limits)?;
    let bbox_min = head.metadata.vec3i("file_bbox_min");
    let bbox_max = head.metadata.vec3i("file_bbox_max");
    Ok(Preflight {
        transcript,
        format,
        topology,
        world_from_index,
        class: class(head.metadata.text("class")),
        voxel_count: head.metadata.int64("file_voxel_count"),
        bbox: bbox_min.zip(bbox_max).map(|([x, y, z], [u, v, w])| [x, y, z, u, v, w]),
    })
}

/// Grid class from its metadata entry; `unknown` if empty.
pub(super) fn class(entry: Option<String>) -> String {
    entry.filter(|class| !class.is_empty()).unwrap_or_else(|| "unknown".to_owned())
}

/// Offset of the end of a grid in a file without offsets, in bytes.
pub(super) fn end_of_grid(archive: &Archive, index: usize, limits: &ReadLimits) -> Result<u64, Fault> {
    let grid = descriptor(archive, index)?;
    if grid.instance_parent.is_empty() {
        walk(archive, grid, limits).map(|tree| tree.end)
    } else {
        let (_, cursor) = archive.grid_head(grid)?.map?;
        Ok(cursor.position())
    }
}

fn descriptor<'a>(archive: &'a Archive, index: usize) -> Result<&'a GridDescriptor, Fault> {
    archive.grids.get(index).ok_or_else(|| Fault::invalid(None, format!("no grid number {index}")))
}

/// A tree that has been walked completely.
struct WalkedTree {
    transcript: Vec<u8>,
    format: BlockFormat,
    topology: Topology,
    /// Offset in the file of the byte behind the tree.
    end: u64,
}

/// Walks the tree of a grid that is not an instance.
fn walk(archive: &Archive, grid: &GridDescriptor, limits: &ReadLimits) -> Result<WalkedTree, Fault> {
    let value_type = ValueType::of_tree(&grid.tree_type)?;
    let head = archive.grid_head(grid)?;
    let (_, cursor) = head.map?;
    let half = head.metadata.boolean("is_saved_as_half_float").unwrap_or(grid.half);
    let format = BlockFormat {
        version: archive.header.version,
        compression: head.compression,
        value_type,
        stored: value_type.stored(half),
    };
    // A transcript is only slightly longer than the bytes copied: the remainder fits into 512 bytes.
    let mut transcript = Transcript::begin(&format, 512 + cursor.remaining());
    let mut walk = Walk::new(cursor, transcript.tree(), format, limits);
    walk.topology()?;
    if let Some(blocks) = grid.extent.blocks {
        walk.expect_leaf_values_at(blocks)?;
    }
    let blocks = walk.written();
    walk.leaf_values()?;
    let end = walk.position();
    if let Some(expected) = grid.extent.end.filter(|&expected| expected != end) {
        return Err(Fault::invalid(
            end,
            format!("the leaf values end here, but the grid is declared to end at byte {expected}"),
        ));
    }
    let topology = walk.finish();
    Ok(WalkedTree { transcript: transcript.finish(blocks), format, topology, end })
}
