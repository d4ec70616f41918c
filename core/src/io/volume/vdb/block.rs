//! Value block of a tree node, checked and copied into the transcript.
//!
//! Layout in the file (OpenVDB `io/Compression.h`, `readCompressedValues`) from version 222 on: a tag, up to
//! two inactive values, a mask that selects between them, and a chunk with all values or only the active
//! ones. Inactive voxels are treated as background here, so that the transcript omits the inactive values and
//! the mask.

use super::super::cursor::Cursor;
use super::super::error::Fault;
use super::compression::{self, Codec, Compression};
use super::header::VERSION_NODE_MASK_COMPRESSION;
use super::mask;
use super::value_type::{Stored, ValueType};

/// Tags of a block; see `enum` in OpenVDB's `io/Compression.h`.
const NO_MASK_OR_INACTIVE_VALUES: u8 = 0;
const ONE_INACTIVE_VALUE: u8 = 2;
const MASK: u8 = 3;
const MASK_AND_ONE_INACTIVE_VALUE: u8 = 4;
const MASK_AND_TWO_INACTIVE_VALUES: u8 = 5;
const ALL_VALUES: u8 = 6;

/// Format of all value blocks of a tree.
#[derive(Debug, Clone, Copy)]
pub(super) struct BlockFormat {
    /// Version of the file.
    pub(super) version: u32,
    pub(super) compression: Compression,
    pub(super) value_type: ValueType,
    pub(super) stored: Stored,
}

impl BlockFormat {
    /// Whether blocks carry tags, and internal nodes a value for every entry.
    pub(super) fn is_tagged(&self) -> bool {
        self.version >= VERSION_NODE_MASK_COMPRESSION
    }

    /// Checks a block of `len` values with the mask `active`, and copies it to `out`.
    pub(super) fn copy(
        &self,
        cursor: &mut Cursor,
        out: &mut Vec<u8>,
        len: usize,
        active: &[u64],
    ) -> Result<(), Fault> {
        let mut count = len;
        if self.is_tagged() {
            let tag = self.skip_inactive(cursor, len)?;
            if self.compression.active_mask && tag != ALL_VALUES {
                count = mask::count_ones(active);
            }
            out.push(if tag == ALL_VALUES { ALL_VALUES } else { NO_MASK_OR_INACTIVE_VALUES });
        }
        if count == 0 && self.value_type.is_narrowed(self.stored) {
            // For narrowed values OpenVDB writes nothing if there are none, but a size of 0 for other values.
            // `vdb-rs` expects the size in both cases, so that the transcript contains it.
            if self.compression.codec != Codec::None {
                out.extend(0_i64.to_le_bytes());
            }
            return Ok(());
        }
        let unpacked = count * self.stored.bytes();
        let (size, packed) = compression::chunk(cursor, self.compression.codec, unpacked)?;
        if let Some(size) = size {
            out.extend(size.to_le_bytes());
        }
        out.extend_from_slice(packed);
        Ok(())
    }

    /// Reads the tag, and skips the inactive values and the mask that it announces.
    fn skip_inactive(&self, cursor: &mut Cursor, len: usize) -> Result<u8, Fault> {
        let at = cursor.position();
        let tag = cursor.u8()?;
        if tag > ALL_VALUES {
            return Err(Fault::invalid(at, format!("unknown tag {tag} of a value block")));
        }
        let inactive_values = match tag {
            ONE_INACTIVE_VALUE | MASK_AND_ONE_INACTIVE_VALUE => 1,
            MASK_AND_TWO_INACTIVE_VALUES => 2,
            _ => 0,
        };
        cursor.take(inactive_values * self.value_type.bytes())?;
        if (MASK..=MASK_AND_TWO_INACTIVE_VALUES).contains(&tag) {
            cursor.take(len / 8)?;
        }
        Ok(tag)
    }
}
