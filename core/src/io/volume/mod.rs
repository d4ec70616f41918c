//! Readers of volume files: OpenVDB, NumPy arrays, Mitsuba volumes and raw voxels, into a dense
//! [`VoxelGrid`], or OpenVDB into sparse blocks ([`BlockGrid`]).
//!
//! Files are untrusted input. Readers check every size before they use it, respect [`ReadLimits`], and refuse
//! files that they could not read exactly, with an error that states file, place and remedy
//! ([`VolumeError`]). The only repair, NaN and infinite voxels set to 0, is counted in
//! [`VoxelGrid::repaired`].
//!
//! To add a format: a file with a `read_bytes`, and one line each in the two matches on `Format`.

mod blocks;
mod choice;
mod counted;
mod cursor;
mod error;
mod file;
mod grid;
mod mitsuba_vol;
mod npy;
mod raw;
mod read_limits;
mod vdb;

use std::path::Path;

pub use blocks::{BLOCK, BLOCK_EDGE, BlockGrid, ConstantTile, Volume};
pub use choice::{GridChoice, GridRole};
pub use error::{Place, VolumeError};
pub use grid::{SampleConvention, VoxelGrid, validate_density};
pub use mitsuba_vol::read_mitsuba_vol_bytes;
pub use npy::read_npy_bytes;
pub use raw::read_raw_bytes;
pub use read_limits::ReadLimits;
pub use vdb::{Background, FileInfo, GridInfo, file_info, info, info_bytes, read_vdb, read_vdb_bytes};

use error::Fault;

/// Extensions of the supported formats.
pub const EXTENSIONS: &[&str] = &["vdb", "npy", "vol", "raw"];

/// Supported formats.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    OpenVdb,
    Npy,
    MitsubaVol,
    Raw,
}

impl Format {
    /// Format by the extension of the file name, or else by the first bytes.
    fn of(label: &str, bytes: &[u8]) -> Option<Self> {
        let extension = Path::new(label).extension().and_then(|extension| extension.to_str());
        match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("vdb") => Some(Self::OpenVdb),
            Some("npy") => Some(Self::Npy),
            Some("vol") => Some(Self::MitsubaVol),
            Some("raw") => Some(Self::Raw),
            _ if bytes.starts_with(&vdb::MAGIC) => Some(Self::OpenVdb),
            _ if bytes.starts_with(npy::MAGIC) => Some(Self::Npy),
            _ if bytes.starts_with(mitsuba_vol::MAGIC) => Some(Self::MitsubaVol),
            _ => None,
        }
    }
}

/// Reads a volume file of any supported format: `.vdb`, `.npy`, `.vol`, `.raw`.
///
/// `grid` selects a grid of an OpenVDB file; see [`read_vdb`]. The other formats contain one unnamed grid.
///
/// # Errors
/// When the file is missing, of an unknown format, damaged, too large, or has no such grid.
pub fn read_volume(path: &Path, grid: Option<&str>, limits: &ReadLimits) -> Result<VoxelGrid, VolumeError> {
    read_volume_bytes(&file::read(path, limits)?, &path.display().to_string(), grid, limits)
}

/// Reads a volume file of any supported format, as sparse blocks where the format allows it, and reports the
/// completed fraction, from 0 to 1, to `watch`.
///
/// # Errors
/// As [`read_volume`].
pub fn read_sparse_volume<'a>(
    path: &Path,
    grid: impl Into<GridChoice<'a>>,
    limits: &ReadLimits,
    watch: &dyn Fn(f64),
) -> Result<Volume, VolumeError> {
    read_sparse_volume_bytes(&file::read(path, limits)?, &path.display().to_string(), grid, limits, watch)
}

/// [`read_volume`] for a file in memory; `label` is its path, with the extension.
///
/// # Errors
/// As [`read_volume`].
pub fn read_volume_bytes(
    bytes: &[u8],
    label: &str,
    grid: Option<&str>,
    limits: &ReadLimits,
) -> Result<VoxelGrid, VolumeError> {
    read_array(format_of(bytes, label, grid)?, bytes, label, grid, limits)
}

/// [`read_sparse_volume`] for a file in memory.
///
/// # Errors
/// As [`read_volume`].
pub fn read_sparse_volume_bytes<'a>(
    bytes: &[u8],
    label: &str,
    grid: impl Into<GridChoice<'a>>,
    limits: &ReadLimits,
    watch: &dyn Fn(f64),
) -> Result<Volume, VolumeError> {
    let grid = grid.into();
    match format_of(bytes, label, grid.name)? {
        Format::OpenVdb => vdb::read_sparse(bytes, label, grid, limits, watch),
        other => read_array(other, bytes, label, grid.name, limits).map(Volume::Array),
    }
}

/// Format of a file, and a check that it can have a grid of this name.
fn format_of(bytes: &[u8], label: &str, grid: Option<&str>) -> Result<Format, VolumeError> {
    let Some(format) = Format::of(label, bytes) else {
        let what = "this file format";
        let cure = "Use an OpenVDB (.vdb), NumPy (.npy), Mitsuba (.vol) or raw float32 (.raw) file";
        return Err(Fault::unsupported(what, cure).in_file(label, None));
    };
    if let (Some(wanted), Format::Npy | Format::MitsubaVol | Format::Raw) = (grid, format) {
        return Err(VolumeError::NoSuchGrid {
            file: label.to_owned(),
            what: format!("it has no grid named \"{wanted}\": the format holds one unnamed grid"),
            available: Vec::new(),
        });
    }
    Ok(format)
}

fn read_array(
    format: Format,
    bytes: &[u8],
    label: &str,
    grid: Option<&str>,
    limits: &ReadLimits,
) -> Result<VoxelGrid, VolumeError> {
    match format {
        Format::OpenVdb => read_vdb_bytes(bytes, label, grid, limits),
        Format::Npy => read_npy_bytes(bytes, label, limits),
        Format::MitsubaVol => read_mitsuba_vol_bytes(bytes, label, limits),
        Format::Raw => read_raw_bytes(bytes, label, limits),
    }
}
