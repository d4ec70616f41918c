//! Conversion of leaves and tiles to blocks over the active bounding box, without an array of the box.

use rayon::prelude::*;

use super::super::blocks::{BLOCK, BlockGrid, ConstantTile};
use super::super::error::Fault;
use super::super::read_limits::ReadLimits;
use super::dense::active_box;
use super::mask;
use super::sparse::{Leaf, SparseGrid};

/// Statistics of one block.
#[derive(Default)]
struct CollisionRecord {
    repaired: u64,
    negatives: u64,
    /// First negative voxel in array order.
    first: Option<([i32; 3], f32)>,
    empty: bool,
}

/// Converts `sparse`, whose background is zero, to blocks. Name, map and class are set by the caller.
///
/// # Errors
/// When no voxel is active, or the box exceeds the limit (before memory is allocated).
pub(super) fn blocks(sparse: SparseGrid, limits: &ReadLimits) -> Result<BlockGrid, Fault> {
    let bbox = active_box(&sparse)?;
    limits.blocks(bbox.size())?;
    let SparseGrid { channels, leaves, mut leaf_values, tiles, .. } = sparse;
    let found: Vec<_> = leaf_values
        .par_chunks_exact_mut(BLOCK * channels)
        .zip(&leaves)
        .map(|(values, leaf)| rearrange(values, leaf, channels))
        .collect();

    // Empty blocks are removed and the others moved up.
    let mut origins = Vec::with_capacity(leaves.len());
    for (number, leaf) in leaves.iter().enumerate().filter(|(number, _)| !found[*number].empty) {
        let block = BLOCK * channels;
        leaf_values.copy_within(number * block..(number + 1) * block, origins.len() * block);
        origins.push(leaf.origin);
    }
    leaf_values.truncate(origins.len() * BLOCK * channels);

    let mut grid = BlockGrid {
        name: String::new(),
        channels,
        bbox: [bbox.min, bbox.max],
        origins,
        values: leaf_values,
        tiles: Vec::new(),
        world_from_index: glam::DAffine3::IDENTITY,
        level_set: false,
        repaired: found.iter().map(|f| f.repaired).sum(),
        notices: Vec::new(),
        negative: None,
    };
    let mut negatives: u64 = found.iter().map(|f| f.negatives).sum();
    let mut first = found.into_iter().filter_map(|f| f.first).min_by_key(|(at, _)| array_order(*at));
    for tile in tiles {
        let voxels = tile.voxels();
        let value = &tile.value[..channels];
        if value.iter().any(|v| !v.is_finite()) {
            grid.repaired = grid.repaired.saturating_add(voxels);
            continue;
        }
        if let Some(negative) = value.iter().find(|v| **v < 0.0) {
            negatives = negatives.saturating_add(voxels);
            let candidate = (tile.origin, *negative);
            first = first.into_iter().chain([candidate]).min_by_key(|(at, _)| array_order(*at));
        }
        grid.tiles.push(ConstantTile { origin: tile.origin, edge: tile.edge, value: tile.value });
    }
    grid.negative = first.map(|(at, value)| (at, value, negatives));
    Ok(grid)
}

fn array_order([x, y, z]: [i32; 3]) -> [i32; 3] {
    [z, y, x]
}

/// Reorders voxels from z fastest to x fastest; inactive and non-finite voxels become zero.
fn rearrange(values: &mut [f32], leaf: &Leaf, channels: usize) -> CollisionRecord {
    let mut found = CollisionRecord { empty: true, ..CollisionRecord::default() };
    let mut block = vec![0.0; values.len()];
    for entry in mask::ones(&leaf.active) {
        let [x, y, z] = mask::entry_offset(entry, 3, 1);
        let voxel = &values[entry * channels..(entry + 1) * channels];
        if voxel.iter().any(|v| !v.is_finite()) {
            found.repaired += 1;
            continue;
        }
        if let Some(negative) = voxel.iter().find(|v| **v < 0.0) {
            found.negatives += 1;
            let here = (mask::add(leaf.origin, [x, y, z]), *negative);
            found.first = found.first.into_iter().chain([here]).min_by_key(|(at, _)| array_order(*at));
        }
        found.empty &= voxel.iter().all(|v| *v == 0.0);
        let to = (x + 8 * y + 64 * z) as usize * channels;
        block[to..to + channels].copy_from_slice(voxel);
    }
    values.copy_from_slice(&block);
    found
}
