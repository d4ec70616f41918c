//! Dense grid produced by the readers, and the checks for use as a density.

use std::path::Path;

use glam::{DAffine3, DVec3};

use super::error::{Place, VolumeError};

/// Position of a value in its voxel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SampleConvention {
    /// At the integer index coordinates (OpenVDB).
    VertexCentred,
    /// At index + 1/2: value i of n is at (i + 1/2)/n of the box (NumPy, Mitsuba).
    CellCentred,
}

/// A dense box of voxels.
#[derive(Debug, Clone)]
pub struct VoxelGrid {
    /// Display name of the grid in its file; empty where the format has none.
    pub name: String,
    /// Voxels along x, y and z.
    pub size: [usize; 3],
    /// Values per voxel: 1 or 3.
    pub channels: usize,
    /// Values, x fastest, then y, then z; channels interleaved. All finite.
    pub values: Vec<f32>,
    /// Index coordinates of the first voxel.
    pub min_index: [i32; 3],
    /// Value outside the box (of the first channel, if there are three).
    pub background: f32,
    /// Maps index coordinates to world coordinates.
    pub world_from_index: DAffine3,
    /// Position of a value in its voxel.
    pub convention: SampleConvention,
    /// Whether the file declares the grid a level set, that is, a signed distance.
    pub level_set: bool,
    /// NaN or infinite voxels that the reader set to 0.
    pub repaired: usize,
    /// Notices about the file and the choice of the grid, as sentences with the file name.
    pub notices: Vec<String>,
    /// Number of voxels with a negative value. See [`validate_density`].
    pub negative: usize,
}

impl VoxelGrid {
    /// Creates a grid with one unnamed box of cell-centred values. Repairs and counts voxels.
    pub(super) fn cell_centred(
        size: [usize; 3],
        channels: usize,
        values: Vec<f32>,
        world_from_index: DAffine3,
    ) -> Self {
        let mut grid = Self {
            name: String::new(),
            size,
            channels,
            values,
            min_index: [0; 3],
            background: 0.0,
            world_from_index,
            convention: SampleConvention::CellCentred,
            level_set: false,
            repaired: 0,
            notices: Vec::new(),
            negative: 0,
        };
        grid.repair_and_count();
        grid
    }

    /// Creates a grid for a file without a transformation: voxels are cubes, the longest side is one world
    /// unit, and the corner of index (0, 0, 0) is the origin.
    pub(super) fn without_place(size: [usize; 3], channels: usize, values: Vec<f32>) -> Self {
        let longest = size.iter().fold(1, |longest, &n| longest.max(n)) as f64;
        Self::cell_centred(size, channels, values, DAffine3::from_scale(DVec3::splat(1.0 / longest)))
    }

    /// Number of voxels.
    pub fn voxels(&self) -> usize {
        self.size.iter().product()
    }

    /// Channels of voxel (x, y, z), relative to the corner of the box.
    pub fn voxel(&self, [x, y, z]: [usize; 3]) -> Option<&[f32]> {
        let [nx, ny, nz] = self.size;
        if x >= nx || y >= ny || z >= nz {
            return None;
        }
        let first = ((z * ny + y) * nx + x) * self.channels;
        self.values.get(first..first + self.channels)
    }

    /// First and last index coordinates, both inclusive: (min x, y, z, max x, y, z).
    pub fn index_bbox(&self) -> [i32; 6] {
        let [x, y, z] = self.min_index;
        // Readers create no grid whose last index would exceed the range of i32.
        let last = |min: i32, n: usize| min.saturating_add(i32::try_from(n).unwrap_or(i32::MAX) - 1);
        let [nx, ny, nz] = self.size;
        [x, y, z, last(x, nx), last(y, ny), last(z, nz)]
    }

    /// Smallest and largest value, over all channels; `None` for an empty grid.
    pub fn min_max(&self) -> Option<(f32, f32)> {
        self.values.iter().fold(None, |range, &v| match range {
            None => Some((v, v)),
            Some((min, max)) => Some((v.min(min), v.max(max))),
        })
    }

    /// Mean over all voxels and channels, inactive ones included; 0 for an empty grid.
    pub fn mean(&self) -> f64 {
        let sum: f64 = self.values.iter().map(|&v| f64::from(v)).sum();
        sum / self.values.len().max(1) as f64
    }

    /// Largest sum of values along any grid line, over axes and channels: the optical thickness of that line
    /// per unit of extinction and voxel edge.
    pub fn thickest_line(&self) -> f32 {
        let [nx, ny, nz] = self.size;
        let mut thickest = 0.0f32;
        for channel in 0..self.channels {
            let value =
                |x: usize, y: usize, z: usize| self.values[((z * ny + y) * nx + x) * self.channels + channel];
            let (mut along_y, mut along_z) = (vec![0.0f32; nx * nz], vec![0.0f32; nx * ny]);
            for z in 0..nz {
                for y in 0..ny {
                    let mut along_x = 0.0;
                    for x in 0..nx {
                        let v = value(x, y, z);
                        along_x += v;
                        along_y[z * nx + x] += v;
                        along_z[y * nx + x] += v;
                    }
                    thickest = thickest.max(along_x);
                }
            }
            thickest = along_y.into_iter().chain(along_z).fold(thickest, f32::max);
        }
        thickest
    }

    /// World coordinates of two opposite corners of the box of voxels, each mapped from index space. The box
    /// is axis-aligned in world space only if `world_from_index` is.
    pub fn world_corners(&self) -> (DVec3, DVec3) {
        let [x, y, z] = self.min_index;
        let min = DVec3::new(f64::from(x), f64::from(y), f64::from(z));
        let size = DVec3::from(self.size.map(|n| n as f64));
        let max = match self.convention {
            SampleConvention::VertexCentred => min + size - 1.0,
            SampleConvention::CellCentred => min + size,
        };
        (self.world_from_index.transform_point3(min), self.world_from_index.transform_point3(max))
    }

    /// Sets voxels with a NaN or infinite channel to 0, and counts these and the negative ones.
    pub(super) fn repair_and_count(&mut self) {
        for voxel in self.values.chunks_exact_mut(self.channels) {
            if voxel.iter().any(|v| !v.is_finite()) {
                voxel.fill(0.0);
                self.repaired += 1;
            } else if voxel.iter().any(|&v| v < 0.0) {
                self.negative += 1;
            }
        }
        if !self.background.is_finite() {
            self.background = 0.0;
        }
    }
}

/// Checks that a grid can serve as a density, without negative values.
///
/// Separate from the readers, so that a level set can still be described and shown.
///
/// # Errors
/// [`VolumeError::NegativeDensity`] with the index of the first negative voxel in memory order.
pub fn validate_density(grid: &VoxelGrid, path: &Path) -> Result<(), VolumeError> {
    let Some(at) = grid.values.iter().position(|&v| v < 0.0) else {
        return Ok(());
    };
    let voxel = at / grid.channels;
    let [nx, ny, _] = grid.size;
    let offset = [voxel % nx, voxel / nx % ny, voxel / nx / ny];
    let index = [0, 1, 2].map(|axis| grid.min_index[axis].saturating_add(offset[axis] as i32));
    Err(VolumeError::NegativeDensity {
        file: path.display().to_string(),
        place: Place { grid: Some(grid.name.clone()).filter(|name| !name.is_empty()), byte: None },
        index,
        value: grid.values[at],
        count: grid.negative,
        level_set: grid.level_set,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(values: Vec<f32>) -> VoxelGrid {
        VoxelGrid {
            name: "density".to_owned(),
            size: [2, 1, values.len() / 2],
            channels: 1,
            values,
            min_index: [10, 20, 30],
            background: 0.0,
            world_from_index: DAffine3::IDENTITY,
            convention: SampleConvention::VertexCentred,
            level_set: false,
            repaired: 0,
            notices: Vec::new(),
            negative: 0,
        }
    }

    #[test]
    fn repair_counts_non_finite_and_negative_voxels() {
        let mut grid = grid(vec![f32::NAN, 1.0, f32::NEG_INFINITY, -2.0]);
        grid.repair_and_count();
        assert_eq!((grid.repaired, grid.negative), (2, 1));
        assert_eq!(grid.values, [0.0, 1.0, 0.0, -2.0]);
        assert_eq!(grid.min_max(), Some((-2.0, 1.0)));
        assert_eq!(grid.index_bbox(), [10, 20, 30, 11, 20, 31]);
    }

    #[test]
    fn thickest_line_is_found_along_any_axis() {
        // Two voxels along x, two along z.
        let grid = grid(vec![1.0, 0.5, 2.0, 0.25]);
        assert_eq!(grid.thickest_line(), 3.0);
    }

    #[test]
    fn negative_density_is_named_with_its_index() {
        let mut grid = grid(vec![0.0, 1.0, 0.5, -2.0]);
        grid.repair_and_count();
        let message = validate_density(&grid, Path::new("a.vdb")).unwrap_err().to_string();
        assert!(message.contains("[11, 20, 31]") && message.contains("\"density\""), "{message}");
        grid.level_set = true;
        let message = validate_density(&grid, Path::new("a.vdb")).unwrap_err().to_string();
        assert!(message.contains("level set") && message.contains("fog volume"), "{message}");
    }
}
