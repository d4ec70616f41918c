//! Reading of a whole file with a size limit.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::error::{Fault, VolumeError};
use super::read_limits::ReadLimits;

/// Reads the whole file.
///
/// # Errors
/// When it cannot be read, or is longer than [`ReadLimits::max_file_bytes`].
pub(super) fn read(path: &Path, limits: &ReadLimits) -> Result<Vec<u8>, VolumeError> {
    let label = path.display().to_string();
    let io_error = |source| VolumeError::Io { file: label.clone(), source };
    let file = File::open(path).map_err(io_error)?;
    let length = file.metadata().map_err(io_error)?.len();
    let too_large = |length: u64| {
        Fault::too_large(
            "the file",
            format_args!("{length} bytes"),
            format_args!("{} bytes", limits.max_file_bytes),
            "Crop or resample the volume to a coarser voxel size",
        )
        .in_file(&label, None)
    };
    if length > limits.max_file_bytes {
        return Err(too_large(length));
    }
    let mut bytes = Vec::new();
    // A pipe or a growing file may hold more than its metadata says.
    file.take(limits.max_file_bytes.saturating_add(1)).read_to_end(&mut bytes).map_err(io_error)?;
    if bytes.len() as u64 > limits.max_file_bytes {
        return Err(too_large(bytes.len() as u64));
    }
    Ok(bytes)
}
