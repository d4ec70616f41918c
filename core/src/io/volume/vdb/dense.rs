//! Conversion of leaves and tiles to a dense grid over the active bounding box.

use rayon::prelude::*;

use super::super::error::Fault;
use super::super::grid::{SampleConvention, VoxelGrid};
use super::super::read_limits::{ReadLimits, allocate};
use super::mask;
use super::sparse::LEAF_EDGE;
use super::sparse::{IndexBox, Leaf, SparseGrid, Tile};

/// Converts `sparse` to a dense grid over its active bounding box: active voxels with their values, all
/// others with the background. Name, map and class are set by the caller.
///
/// # Errors
/// When no voxel is active, or the box exceeds the limit (before memory is allocated).
pub(super) fn densify(sparse: &SparseGrid, limits: &ReadLimits) -> Result<VoxelGrid, Fault> {
    let bbox = active_box(sparse)?;
    let channels = sparse.channels;
    let len = limits.dense_values(bbox.size(), channels)?;
    let size = bbox.size().map(|n| n as usize);
    let background = &sparse.background[..channels];
    let mut values = allocate(len)?;
    while values.len() < len {
        values.extend_from_slice(background);
    }

    let slabs = split_slabs(&mut values, &bbox, size[0] * size[1] * channels);
    let contents = sort_into_slabs(sparse, &bbox, slabs.len());
    slabs.into_par_iter().zip(contents).for_each(|(mut slab, contents)| {
        for tile in contents.tiles {
            slab.fill_tile(tile, channels);
        }
        for (leaf, leaf_values) in contents.leaves {
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
        notices: Vec::new(),
        negative: 0,
    };
    grid.repair_and_count();
    Ok(grid)
}

/// Bounding box of the active voxels.
///
/// # Errors
/// When no voxel is active.
pub(super) fn active_box(sparse: &SparseGrid) -> Result<IndexBox, Fault> {
    sparse.active_bbox().ok_or_else(|| {
        Fault::invalid(None, "no voxel is active")
            .with_cure("Export a frame in which the volume is not empty, or choose another grid")
    })
}

/// Up to eight z planes of the dense grid, aligned to the leaves: slabs share no leaf and can be filled in
/// parallel.
struct Slab<'a> {
    values: &'a mut [f32],
    bbox: IndexBox,
}

/// Tiles and leaves of a slab.
#[derive(Default)]
struct SlabContents<'a> {
    tiles: Vec<&'a Tile>,
    leaves: Vec<(&'a Leaf, &'a [f32])>,
}

/// Splits the dense values at every multiple of eight in z.
fn split_slabs<'a>(values: &'a mut [f32], bbox: &IndexBox, plane: usize) -> Vec<Slab<'a>> {
    let mut slabs = Vec::new();
    let mut rest = values;
    let mut z = bbox.min[2];
    while !rest.is_empty() {
        let last = (z | (LEAF_EDGE - 1)).min(bbox.max[2]);
        let (values, behind) = rest.split_at_mut((last - z + 1) as usize * plane);
        let ([x0, y0, _], [x1, y1, _]) = (bbox.min, bbox.max);
        slabs.push(Slab { values, bbox: IndexBox { min: [x0, y0, z], max: [x1, y1, last] } });
        rest = behind;
        z = last.saturating_add(1);
    }
    slabs
}

/// Collects the tiles and leaves that overlap each slab.
fn sort_into_slabs<'a>(sparse: &'a SparseGrid, bbox: &IndexBox, slab_count: usize) -> Vec<SlabContents<'a>> {
    let mut contents: Vec<SlabContents> = Vec::new();
    contents.resize_with(slab_count, SlabContents::default);
    let slab_of = |z: i32| (z.div_euclid(LEAF_EDGE) - bbox.min[2].div_euclid(LEAF_EDGE)) as usize;
    for tile in &sparse.tiles {
        let z_range = tile.bbox().intersection(bbox).map(|common| (common.min[2], common.max[2]));
        let Some((first, last)) = z_range else {
            continue;
        };
        for slab in contents.iter_mut().take(slab_of(last) + 1).skip(slab_of(first)) {
            slab.tiles.push(tile);
        }
    }
    // A leaf without active voxels may be outside the box and contributes nothing.
    for (leaf, values) in sparse.leaves().filter(|(leaf, _)| leaf.active != [0; 8]) {
        if let Some(slab) = contents.get_mut(slab_of(leaf.origin[2])) {
            slab.leaves.push((leaf, values));
        }
    }
    contents
}

impl Slab<'_> {
    /// Linear index of a voxel within this slab.
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
