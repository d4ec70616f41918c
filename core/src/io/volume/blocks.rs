//! Sparse grids of 8³ blocks, the representation of OpenVDB files without an array of the whole box.

use super::error::{Place, VolumeError};
use super::grid::VoxelGrid;
use glam::DAffine3;
use std::path::Path;

/// Voxels along the edge of a block.
pub const BLOCK_EDGE: i32 = 8;
/// Number of voxels of a block.
pub const BLOCK: usize = 512;

/// Voxels at integer index coordinates, zero outside blocks and tiles.
#[derive(Debug, Clone)]
pub struct BlockGrid {
    /// Display name of the grid in its file.
    pub name: String,
    /// Values per voxel: 1 or 3.
    pub channels: usize,
    /// First and last index coordinates of all active voxels, both inclusive.
    pub bbox: [[i32; 3]; 2],
    /// Index coordinates of the first voxel of every block: multiples of 8.
    pub origins: Vec<[i32; 3]>,
    /// 512 voxels per block: x fastest, then y, then z; channels interleaved. All finite.
    pub values: Vec<f32>,
    /// Cubes of constant value. Blocks do not overlap them.
    pub tiles: Vec<ConstantTile>,
    /// Maps index coordinates to world coordinates.
    pub world_from_index: DAffine3,
    /// Whether the file declares the grid a level set, that is, a signed distance.
    pub level_set: bool,
    /// NaN or infinite voxels that the reader set to 0.
    pub repaired: u64,
    /// Notices about the file and the choice of the grid, as sentences with the file name.
    pub notices: Vec<String>,
    /// First negative voxel in array order, its value, and the number of negative voxels.
    pub negative: Option<([i32; 3], f32, u64)>,
}

/// A cube of voxels of constant value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConstantTile {
    /// Index coordinates of its first voxel: multiples of its edge.
    pub origin: [i32; 3],
    /// Voxels along an edge: 8, 128 or 4096.
    pub edge: i32,
    /// Value per channel; a scalar is repeated in all three channels.
    pub value: [f32; 3],
}

/// Contents of a volume file.
#[derive(Debug, Clone)]
pub enum Volume {
    /// A dense array of voxels.
    Array(VoxelGrid),
    /// Sparse blocks.
    Blocks(BlockGrid),
}

impl Volume {
    /// Values per voxel: 1 or 3.
    #[must_use]
    pub fn channels(&self) -> usize {
        match self {
            Self::Array(grid) => grid.channels,
            Self::Blocks(grid) => grid.channels,
        }
    }

    /// Voxels along x, y and z of the bounding box.
    #[must_use]
    pub fn size(&self) -> [usize; 3] {
        match self {
            Self::Array(grid) => grid.size,
            Self::Blocks(grid) => grid.size(),
        }
    }

    /// Largest sum of values along any grid line, over axes and channels: the optical thickness of that line
    /// per unit of extinction and voxel edge.
    #[must_use]
    pub fn thickest_line(&self) -> f32 {
        match self {
            Self::Array(grid) => grid.thickest_line(),
            Self::Blocks(grid) => grid.thickest_line(),
        }
    }

    /// Checks that the volume can serve as a density, without negative values. Separate from the readers, so
    /// that a level set can still be described.
    ///
    /// # Errors
    /// [`VolumeError::NegativeDensity`] with the index of the first negative voxel in array order.
    pub fn validate_density(&self, path: &Path) -> Result<(), VolumeError> {
        match self {
            Self::Array(grid) => super::validate_density(grid, path),
            Self::Blocks(grid) => grid.validate_density(path),
        }
    }
}

impl BlockGrid {
    /// Voxels along x, y and z of the bounding box of active voxels.
    #[must_use]
    pub fn size(&self) -> [usize; 3] {
        [0, 1, 2].map(|axis| self.bbox[1][axis].abs_diff(self.bbox[0][axis]) as usize + 1)
    }

    fn validate_density(&self, path: &Path) -> Result<(), VolumeError> {
        let Some((index, value, count)) = self.negative else { return Ok(()) };
        Err(VolumeError::NegativeDensity {
            file: path.display().to_string(),
            place: Place { grid: Some(self.name.clone()).filter(|name| !name.is_empty()), byte: None },
            index,
            value,
            count: usize::try_from(count).unwrap_or(usize::MAX),
            level_set: self.level_set,
        })
    }

    fn thickest_line(&self) -> f32 {
        let size = self.size();
        let offset = |at: [i32; 3]| [0, 1, 2].map(|axis| at[axis].abs_diff(self.bbox[0][axis]) as usize);
        let mut thickest = 0.0f32;
        for channel in 0..self.channels {
            // Sums along every axis, indexed by the two other axes.
            let mut sums: [Vec<f32>; 3] =
                [size[1] * size[2], size[0] * size[2], size[0] * size[1]].map(|n| vec![0.0; n]);
            let mut add = |[x, y, z]: [usize; 3], value: f32| {
                sums[0][y + size[1] * z] += value;
                sums[1][x + size[0] * z] += value;
                sums[2][x + size[0] * y] += value;
            };
            for (origin, block) in self.origins.iter().zip(self.values.chunks_exact(BLOCK * self.channels)) {
                for (voxel, values) in block.chunks_exact(self.channels).enumerate() {
                    let value = values[channel];
                    let within = [voxel % 8, voxel / 8 % 8, voxel / 64];
                    let at = [0, 1, 2].map(|axis| origin[axis] + within[axis] as i32);
                    // Voxels outside the box are zero.
                    if value != 0.0 {
                        add(offset(at), value);
                    }
                }
            }
            for tile in &self.tiles {
                let from = offset(tile.origin);
                let edge = tile.edge.unsigned_abs() as usize;
                let through = tile.value[channel] * edge as f32;
                for (axis, sums) in sums.iter_mut().enumerate() {
                    let (a, b) = [(1, 2), (0, 2), (0, 1)][axis];
                    for j in from[b]..from[b] + edge {
                        for sum in &mut sums[from[a] + size[a] * j..][..edge] {
                            *sum += through;
                        }
                    }
                }
            }
            thickest = sums.into_iter().flatten().fold(thickest, f32::max);
        }
        thickest
    }
}
