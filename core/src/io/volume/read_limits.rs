//! Memory limits of volume files.

use super::error::Fault;

/// Upper bounds on memory. A file of a megabyte can describe 70 billion voxels (a "tile bomb"), so that each
/// bound is checked before memory is allocated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ReadLimits {
    /// Length of a file, in bytes.
    pub max_file_bytes: u64,
    /// Size of the unpacked value blocks of a sparse tree, in bytes.
    pub max_tree_bytes: u64,
    /// Number of values (voxels × channels) of a dense grid; each takes 4 bytes.
    pub max_dense_values: u64,
    /// Number of 8³ blocks in the box of a sparse grid, empty ones included; each takes 4 bytes.
    pub max_blocks: u64,
}

impl Default for ReadLimits {
    /// 1 GiB each for the file, the unpacked tree and the dense grid, and a quarter of that for the block
    /// table: a box of 3200³ voxels.
    fn default() -> Self {
        Self {
            max_file_bytes: 1 << 30,
            max_tree_bytes: 1 << 30,
            max_dense_values: 1 << 28,
            max_blocks: 1 << 26,
        }
    }
}

impl ReadLimits {
    /// Number of values of a dense grid of this size, if it is within the limit.
    pub(super) fn dense_values(&self, size: [u64; 3], channels: usize) -> Result<usize, Fault> {
        // Sides are at most 2^32, so that three of them and a channel count fit in 128 bits.
        let needed = size.iter().map(|&n| u128::from(n)).product::<u128>() * channels as u128;
        let allowed = usize::try_from(needed).ok();
        allowed.filter(|_| needed <= u128::from(self.max_dense_values)).ok_or_else(|| {
            let [x, y, z] = size;
            Fault::too_large(
                &format!("a dense grid of {x} × {y} × {z} voxels, {channels} value(s) each"),
                format_args!("{needed} values"),
                format_args!("{} values", self.max_dense_values),
                "Crop or resample the volume to a coarser voxel size",
            )
        })
    }

    /// Checks the box of a sparse grid of this size.
    pub(super) fn blocks(&self, size: [u64; 3]) -> Result<(), Fault> {
        // Including a layer of background on every side.
        let needed = size.iter().map(|&n| u128::from((n + 2).div_ceil(8) + 1)).product::<u128>();
        if needed <= u128::from(self.max_blocks) {
            return Ok(());
        }
        let [x, y, z] = size;
        Err(Fault::too_large(
            &format!("a box of {x} × {y} × {z} voxels"),
            format_args!("{needed} blocks of 8 × 8 × 8"),
            format_args!("{} blocks", self.max_blocks),
            "Crop or resample the volume to a coarser voxel size",
        ))
    }
}

/// Allocates an empty vector with capacity `len`; returns an error instead of aborting if memory is
/// exhausted.
pub(super) fn allocate<T>(len: usize) -> Result<Vec<T>, Fault> {
    let mut values = Vec::new();
    values.try_reserve_exact(len).map_err(|_| {
        Fault::too_large(
            "values",
            format_args!("{} bytes", len.saturating_mul(size_of::<T>())),
            "the free memory of this machine",
            "Close other programs, or resample the volume to a coarser voxel size",
        )
    })?;
    Ok(values)
}
