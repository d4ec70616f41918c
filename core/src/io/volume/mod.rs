//! Volume files: OpenVDB, NumPy arrays, Mitsuba volumes and raw voxels, into a dense [`VoxelGrid`], or OpenVDB into
//! the blocks that it holds ([`BlockGrid`]).
//!
//! A file is data from outside. Readers check every size before they use it, keep within
//! [`Limits`], and refuse what they would not read exactly, with an error that names the file, the
//! place and the cure ([`VolumeError`]). The one repair, NaN and infinite voxels set to 0, is
//! counted in [`VoxelGrid::repaired`].
//!
//! To add a format: a file with a `read_bytes`, and one line each in the two matches on `Format`.

mod blocks;
mod choice;
mod counted;
mod cursor;
mod error;
mod file;
mod grid;
mod limits;
mod mitsuba_vol;
mod npy;
mod raw;
mod vdb;

use std::path::Path;

pub use blocks::{BLOCK, BLOCK_EDGE, BlockGrid, ConstantTile, Volume};
pub use choice::{GridChoice, GridRole};
pub use error::{Place, VolumeError};
pub use grid::{SampleConvention, VoxelGrid, validate_density};
pub use limits::Limits;
pub use mitsuba_vol::read_mitsuba_vol_bytes;
pub use npy::read_npy_bytes;
pub use raw::read_raw_bytes;
pub use vdb::{Background, FileInfo, GridInfo, file_info, info, info_bytes, read_vdb, read_vdb_bytes};

use error::Fault;

/// Extensions of the formats that are read.
pub const EXTENSIONS: &[&str] = &["vdb", "npy", "vol", "raw"];

/// The formats that are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    OpenVdb,
    Npy,
    MitsubaVol,
    Raw,
}

impl Format {
    /// By the extension of the file name, or else by the first bytes.
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
/// `grid` chooses a grid of an OpenVDB file; see [`read_vdb`]. The other formats hold one unnamed
/// grid.
///
/// # Errors
/// The file is missing, of an unknown format, damaged, too large, or has no such grid.
pub fn read_volume(path: &Path, grid: Option<&str>, limits: &Limits) -> Result<VoxelGrid, VolumeError> {
    read_volume_bytes(&file::read(path, limits)?, &path.display().to_string(), grid, limits)
}

/// Reads a volume file of any supported format without filling what is empty, where the format allows it, telling
/// `watch` the share that is done, from 0 to 1, as it rises.
///
/// # Errors
/// As [`read_volume`].
pub fn read_sparse_volume<'a>(
    path: &Path,
    grid: impl Into<GridChoice<'a>>,
    limits: &Limits,
    watch: &dyn Fn(f64),
) -> Result<Volume, VolumeError> {
    read_sparse_volume_bytes(&file::read(path, limits)?, &path.display().to_string(), grid, limits, watch)
}

/// [`read_volume`] for a file in memory; `label` stands for its path, extension included.
///
/// # Errors
/// As [`read_volume`].
pub fn read_volume_bytes(
    bytes: &[u8],
    label: &str,
    grid: Option<&str>,
    limits: &Limits,
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
    limits: &Limits,
    watch: &dyn Fn(f64),
) -> Result<Volume, VolumeError> {
    let grid = grid.into();
    match format_of(bytes, label, grid.name)? {
        Format::OpenVdb => vdb::read_sparse(bytes, label, grid, limits, watch),
        other => read_array(other, bytes, label, grid.name, limits).map(Volume::Array),
    }
}

/// The format of a file, in which a grid may have been named.
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
    limits: &Limits,
) -> Result<VoxelGrid, VolumeError> {
    match format {
        Format::OpenVdb => read_vdb_bytes(bytes, label, grid, limits),
        Format::Npy => read_npy_bytes(bytes, label, limits),
        Format::MitsubaVol => read_mitsuba_vol_bytes(bytes, label, limits),
        Format::Raw => read_raw_bytes(bytes, label, limits),
    }
}
