//! Conversion of voxels to a grid over the unit cube, and the transformation of that cube.

use super::volume::{BLOCK_EDGE, BlockGrid, SampleConvention, Volume, VoxelGrid};
use crate::medium::{BRICK_EDGE, Bricks, Grid, Lattice, Majorants, Packing, Precision};
use crate::scene::{PlacedGrid, ResourceError};
use glam::{DAffine3, DVec3};
use std::path::Path;
use std::sync::Arc;

// Blocks of a file are used as bricks without rearrangement.
const _: () = assert!(BLOCK_EDGE as usize == BRICK_EDGE);

/// Converts voxels to a grid over the unit cube with its transformation.
///
/// # Errors
/// When it has a different number of channels, or no voxels.
pub(super) fn place<const C: usize>(
    volume: Volume,
    path: &Path,
    precision: Precision,
) -> Result<PlacedGrid<C>, ResourceError> {
    if volume.channels() != C {
        return Err(ResourceError(format!(
            "{}: the grid has {} values per voxel where {C} are needed",
            path.display(),
            volume.channels()
        )));
    }
    let (name, mut notices) = match &volume {
        Volume::Array(voxels) => (voxels.name.clone(), voxels.notices.clone()),
        Volume::Blocks(blocks) => (blocks.name.clone(), blocks.notices.clone()),
    };
    let (repaired, world_from_index) = match &volume {
        Volume::Array(voxels) => (voxels.repaired as u64, voxels.world_from_index),
        Volume::Blocks(blocks) => (blocks.repaired, blocks.world_from_index),
    };
    if repaired > 0 {
        let file = path.display();
        notices.push(format!("{file}: {repaired} voxels that were NaN or infinite were set to 0."));
    }
    let (grid, index_from_unit) = match volume {
        Volume::Array(voxels) => of_array(voxels, precision),
        Volume::Blocks(blocks) => of_blocks(blocks, precision),
    };
    let grid = grid.ok_or_else(|| ResourceError(format!("{}: the grid has no voxels", path.display())))?;
    if grid.storage_error() > 0.0 {
        notices.push(format!(
            "{}: kept at less than full precision, which changes values by up to {:.1e}.",
            path.display(),
            grid.storage_error()
        ));
    }
    if grid.max().iter().all(|m| *m <= 0.0) {
        notices.push(format!("{}: the grid is empty, its density is 0.", path.display()));
    }
    let object_from_unit = world_from_index * index_from_unit;
    // The readers choose the box of `.npy` and `.raw` files.
    let has_position =
        path.extension().is_none_or(|e| !e.eq_ignore_ascii_case("npy") && !e.eq_ignore_ascii_case("raw"));
    let grid = Arc::new(grid);
    let majorants = Arc::new(Majorants::new(Arc::clone(&grid)));
    Ok(PlacedGrid { name, grid, majorants, object_from_unit, has_position, notices })
}

/// Grid of an array, and the transformation from the unit cube to its indices.
fn of_array<const C: usize>(voxels: VoxelGrid, precision: Precision) -> (Option<Grid<C>>, DAffine3) {
    let samples: Vec<[f32; C]> =
        voxels.values.chunks_exact(C).map(|c| std::array::from_fn(|i| c[i])).collect();
    match voxels.convention {
        SampleConvention::CellCentred => {
            let packing = Packing { precision, ..Packing::default() };
            let min = DVec3::from(voxels.min_index.map(f64::from));
            let size = DVec3::from(voxels.size.map(|n| n as f64));
            let place = DAffine3::from_translation(min) * DAffine3::from_scale(size);
            (Grid::packed(voxels.size, &samples, Lattice::CellCentred, packing), place)
        }
        SampleConvention::VertexCentred => {
            let packing = Packing { precision, phase: phase(voxels.min_index) };
            let (size, padded) = pad(voxels.size, &samples, [voxels.background; C]);
            let place = between_vertices(voxels.min_index, voxels.size);
            (Grid::packed(size, &padded, Lattice::VertexCentred, packing), place)
        }
    }
}

/// As [`of_array`], for blocks, without an array of the box.
fn of_blocks<const C: usize>(blocks: BlockGrid, precision: Precision) -> (Option<Grid<C>>, DAffine3) {
    let (min, size) = (blocks.bbox[0], blocks.size());
    let place = between_vertices(min, size);
    let Some(mut bricks) = Bricks::<C>::zero(size.map(|n| n + 2), phase(min)) else { return (None, place) };
    let edge = i64::from(BLOCK_EDGE);
    let first = min.map(|i| (i64::from(i) - 1).div_euclid(edge));
    let brick_of = |origin: [i32; 3]| -> [usize; 3] {
        // Every block and tile contains values within the box.
        std::array::from_fn(|axis| (i64::from(origin[axis]).div_euclid(edge) - first[axis]).max(0) as usize)
    };
    let places: Vec<_> = blocks.origins.iter().map(|origin| brick_of(*origin)).collect();
    bricks.put_all(&places, &blocks.values);
    for tile in &blocks.tiles {
        let number = bricks.add_constant(std::array::from_fn(|c| tile.value[c]));
        let (from, count) = (brick_of(tile.origin), (tile.edge / BLOCK_EDGE) as usize);
        for z in from[2]..from[2] + count {
            for y in from[1]..from[1] + count {
                for x in from[0]..from[0] + count {
                    bricks.put([x, y, z], number);
                }
            }
        }
    }
    drop(blocks);
    (Some(Grid::of_bricks(bricks, Lattice::VertexCentred, precision)), place)
}

/// Offset within a brick of the background layer before the first voxel, chosen so that bricks coincide with
/// the blocks of the file's tree.
fn phase(min_index: [i32; 3]) -> [usize; 3] {
    min_index.map(|i| (i64::from(i) - 1).rem_euclid(BRICK_EDGE as i64) as usize)
}

/// Unit cube between the first and the last vertex of a box with one layer of background on every side.
fn between_vertices(min_index: [i32; 3], size: [usize; 3]) -> DAffine3 {
    let min = DVec3::from(min_index.map(f64::from));
    DAffine3::from_translation(min - 1.0) * DAffine3::from_scale(DVec3::from(size.map(|n| n as f64)) + 1.0)
}

/// Adds one layer of background on every side, so that the field fades out as in OpenVDB.
fn pad<const C: usize>(
    [nx, ny, nz]: [usize; 3],
    samples: &[[f32; C]],
    background: [f32; C],
) -> ([usize; 3], Vec<[f32; C]>) {
    let size = [nx + 2, ny + 2, nz + 2];
    let mut padded = vec![background; size[0] * size[1] * size[2]];
    for z in 0..nz {
        for y in 0..ny {
            let from = nx * (y + ny * z);
            let to = 1 + size[0] * (y + 1 + size[1] * (z + 1));
            padded[to..to + nx].copy_from_slice(&samples[from..from + nx]);
        }
    }
    (size, padded)
}
