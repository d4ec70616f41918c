//! Header of an OpenVDB file: magic number, versions, flags, file metadata.
//!
//! Layout after OpenVDB's `io/Archive.cc` (`Archive::readHeader`), little-endian.

use super::super::cursor::Cursor;
use super::super::error::Fault;
use super::metadata::Metadata;

/// First eight bytes of every OpenVDB file.
pub(crate) const MAGIC: [u8; 8] = *b"\x20BDV\0\0\0\0";

/// Oldest version that is read; from this version on each block may be switched between zip and none.
pub(super) const VERSION_SELECTIVE_COMPRESSION: u32 = 220;
/// From this version on compression is stored per grid and inactive values may be omitted.
pub(super) const VERSION_NODE_MASK_COMPRESSION: u32 = 222;
/// Newest version that `vdb-rs` supports (OpenVDB 5 to 12).
pub(super) const VERSION_MULTIPASS_IO: u32 = 224;
/// Newest existing version (OpenVDB 13): 224 with grids of native half floats.
pub(super) const VERSION_NEWEST: u32 = 225;

const UUID_BYTES: usize = 36;

/// Contents of the file header.
#[derive(Debug, Clone)]
pub(super) struct Header {
    /// Version of the layout; a newer version is read as [`VERSION_NEWEST`].
    pub(super) version: u32,
    /// Version stated by the file, if it is newer than [`VERSION_NEWEST`].
    pub(super) newer: Option<u32>,
    /// Whether grids have offsets; otherwise they follow one another without marks.
    pub(super) has_offsets: bool,
    /// Compression flags of all grids; from version 222 on each grid has its own.
    pub(super) compression: u32,
    pub(super) grid_count: u32,
}

impl Header {
    /// Reads the header; leaves the cursor at the first grid descriptor.
    pub(super) fn read(cursor: &mut Cursor) -> Result<Self, Fault> {
        if cursor.take(MAGIC.len()).ok() != Some(MAGIC.as_slice()) {
            return Err(Fault::invalid(0, "this is not an OpenVDB file: its magic number is missing"));
        }
        let version = cursor.u32()?;
        if version < VERSION_SELECTIVE_COMPRESSION {
            return Err(Fault::unsupported(
                format!("OpenVDB file version {version}"),
                format!(
                    "Save the file again with OpenVDB 5 or newer \
                     (versions {VERSION_SELECTIVE_COMPRESSION} to {VERSION_NEWEST} can be read)"
                ),
            )
            .at(MAGIC.len() as u64));
        }
        let newer = Some(version).filter(|&version| version > VERSION_NEWEST);
        let version = version.min(VERSION_NEWEST);
        let _library = (cursor.u32()?, cursor.u32()?);
        let has_offsets = cursor.u8()? != 0;
        let compression =
            if version < VERSION_NODE_MASK_COMPRESSION { u32::from(cursor.u8()? != 0) } else { 0 };
        cursor.take(UUID_BYTES)?;
        Metadata::read(cursor)?;
        let grid_count = cursor.u32()?;
        Ok(Self { version, newer, has_offsets, compression, grid_count })
    }

    /// Notice for a file of a newer version than this reader supports.
    pub(super) fn notice(&self) -> Option<String> {
        let newer = self.newer?;
        Some(format!(
            "it has OpenVDB file version {newer}, and is read as version {VERSION_NEWEST}, the newest known version"
        ))
    }

    /// Adds the file version as the likely cause to a fault, if the version is newer than the newest known
    /// one.
    pub(super) fn blamed(&self, fault: Fault) -> Fault {
        match self.newer {
            None => fault,
            Some(newer) => fault.with_cure(format!(
                "The file has OpenVDB file version {newer}, but the newest known version is {VERSION_NEWEST}: save it \
                 again with OpenVDB 13"
            )),
        }
    }
}
