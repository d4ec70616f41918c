//! The head of an OpenVDB file: magic number, versions, flags, file metadata.
//!
//! Layout after OpenVDB's `io/Archive.cc` (`Archive::readHeader`), little-endian.

use super::super::cursor::Cursor;
use super::super::error::Fault;
use super::metadata::Metadata;

/// First eight bytes of every OpenVDB file.
pub(crate) const MAGIC: [u8; 8] = *b"\x20BDV\0\0\0\0";

/// From this version on each block may be switched between zip and none; oldest that we read.
pub(super) const VERSION_SELECTIVE_COMPRESSION: u32 = 220;
/// From this version on compression is stored per grid and inactive values may be left out.
pub(super) const VERSION_NODE_MASK_COMPRESSION: u32 = 222;
/// The newest version there is (OpenVDB 5 to 12).
pub(super) const VERSION_NEWEST: u32 = 224;

const UUID_BYTES: usize = 36;

/// What the head of the file says about the whole of it.
#[derive(Debug, Clone)]
pub(super) struct Header {
    pub(super) version: u32,
    /// Whether grids can be found by offset; otherwise they follow one another unmarked.
    pub(super) has_offsets: bool,
    /// Compression flags of all grids; from version 222 on each grid has its own.
    pub(super) compression: u32,
    pub(super) grid_count: u32,
}

impl Header {
    /// Reads the head; the cursor is left at the first grid descriptor.
    pub(super) fn read(cursor: &mut Cursor) -> Result<Self, Fault> {
        if cursor.take(MAGIC.len()).ok() != Some(MAGIC.as_slice()) {
            return Err(Fault::invalid(0, "this is not an OpenVDB file: its magic number is missing"));
        }
        let version = cursor.u32()?;
        if !(VERSION_SELECTIVE_COMPRESSION..=VERSION_NEWEST).contains(&version) {
            return Err(Fault::unsupported(
                format!("OpenVDB file version {version}"),
                format!(
                    "Save the file again with OpenVDB 5 or newer \
                     (versions {VERSION_SELECTIVE_COMPRESSION} to {VERSION_NEWEST} can be read)"
                ),
            )
            .at(MAGIC.len() as u64));
        }
        let _library = (cursor.u32()?, cursor.u32()?);
        let has_offsets = cursor.u8()? != 0;
        let compression =
            if version < VERSION_NODE_MASK_COMPRESSION { u32::from(cursor.u8()? != 0) } else { 0 };
        cursor.take(UUID_BYTES)?;
        Metadata::read(cursor)?;
        let grid_count = cursor.u32()?;
        Ok(Self { version, has_offsets, compression, grid_count })
    }
}
