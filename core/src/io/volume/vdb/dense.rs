//! From leaves and tiles to a dense grid over the active bounding box.

use rayon::prelude::*;

use super::super::error::Fault;
use super::super::grid::{SampleConvention, VoxelGrid};
use super::super::limits::{Limits, allocate};
use super::mask;
use super::sparse::{IndexBox, Leaf, SparseGrid, Tile};
use super::tree::LEAF_EDGE;

/// The active bounding box of `sparse`, filled: active voxels with their values, all others with
/// the background. Name, map and class are left for the caller.
///
/// # Errors
/// No voxel is active, or the box exceeds the limit (long before memory is asked for).
pub(super) fn densify(sparse: &SparseGrid, limits: &Limits) -> Result<VoxelGrid, Fault> {
    let bbox = sparse.active_bbox().ok_or_else(|| {
        Fault::invalid(None, "no voxel is active")
            .with_cure("Export a frame in which the volume is not empty, or choose another grid")
    })?;
    let channels = sparse.channels;
    let len = limits.dense_values(bbox.size(), channels)?;
    let size = bbox.size().map(|n| n as usize);
    let background = &sparse.background[..channels];
    let mut values = allocate(len)?;
    while values.len() < len {
        values.extend_from_slice(background);
    }

    // Slabs of eight z planes, aligned to the leaves, can be filled side by side.
    let first_slab = bbox.min[2].div_euclid(LEAF_EDGE);
    let slab_count = (bbox.max[2].div_euclid(LEAF_EDGE) - first_slab) as usize + 1;
    let mut leaves_of_slab = vec![Vec::new(); slab_count];
    for (leaf, leaf_values) in sparse.leaves() {
        let slab = leaf.origin[2].div_euclid(LEAF_EDGE) - first_slab;
        // A leaf without active voxels may lie outside the box.
        if let Some(leaves) = usize::try_from(slab)
            .ok()
            .and_then(|n| leaves_of_slab.get_mut(n))
        {
            leaves.push((leaf, leaf_values));
        }
    }
    let slabs = split_slabs(&mut values, &bbox, size[0] * size[1] * channels);
    slabs
        .into_par_iter()
        .zip(leaves_of_slab)
        .for_each(|(mut slab, leaves)| {
            for tile in &sparse.tiles {
                slab.fill_tile(tile, channels);
            }
            for (leaf, leaf_values) in leaves {
                slab.fill_leaf(leaf, leaf_values, channels);
            }
        });

    let mut grid = VoxelGrid {
        name: String::new(),
        size,
        channels,
        values,
        min_index: bbox.min,
        background: sparse.background[0],
        world_from_index: glam::DAffine3::IDENTITY,
        convention: SampleConvention::VertexCentred,
        level_set: false,
        repaired: 0,
        negative: 0,
    };
    grid.repair_and_count();
    Ok(grid)
}

/// Some z planes of the dense grid.
struct Slab<'a> {
    values: &'a mut [f32],
    bbox: IndexBox,
}

/// Cuts the dense values at every multiple of eight in z.
fn split_slabs<'a>(values: &'a mut [f32], bbox: &IndexBox, plane: usize) -> Vec<Slab<'a>> {
    let mut slabs = Vec::new();
    let mut rest = values;
    let mut z = bbox.min[2];
    while !rest.is_empty() {
        let last = (z | (LEAF_EDGE - 1)).min(bbox.max[2]);
        let (values, behind) = rest.split_at_mut((last - z + 1) as usize * plane);
        let ([x0, y0, _], [x1, y1, _]) = (bbox.min, bbox.max);
        slabs.push(Slab {
            values,
            bbox: IndexBox {
                min: [x0, y0, z],
                max: [x1, y1, last],
            },
        });
        rest = behind;
        z = last.saturating_add(1);
    }
    slabs
}

impl Slab<'_> {
    /// Position of a voxel of this slab, in voxels.
    fn voxel(&self, index: [i32; 3]) -> usize {
        let [x, y, z] = [0, 1, 2].map(|axis| index[axis].abs_diff(self.bbox.min[axis]) as usize);
        let [nx, ny, _] = self.bbox.size().map(|n| n as usize);
        (z * ny + y) * nx + x
    }

    fn fill_tile(&mut self, tile: &Tile, channels: usize) {
        let Some(common) = self.bbox.intersection(&tile.bbox()) else {
            return;
        };
        let row = common.size()[0] as usize * channels;
        let value = &tile.value[..channels];
        for z in common.min[2]..=common.max[2] {
            for y in common.min[1]..=common.max[1] {
                let start = self.voxel([common.min[0], y, z]) * channels;
                for voxel in self.values[start..start + row].chunks_exact_mut(channels) {
                    voxel.copy_from_slice(value);
                }
            }
        }
    }

    fn fill_leaf(&mut self, leaf: &Leaf, leaf_values: &[f32], channels: usize) {
        for entry in mask::ones(&leaf.active) {
            let index = mask::add(leaf.origin, mask::entry_offset(entry, 3, 1));
            let (to, from) = (self.voxel(index) * channels, entry * channels);
            self.values[to..to + channels].copy_from_slice(&leaf_values[from..from + channels]);
        }
    }
}
