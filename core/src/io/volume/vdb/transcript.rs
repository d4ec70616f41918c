//! Rewritten file for `vdb-rs`: a single grid, without features that `vdb-rs` misreads.
//!
//! `vdb-rs` 0.6.0 panics on most maps, on files without offsets, and on any bad descriptor, even of a grid
//! that was not requested; it misreads half floats with mask compression and non-float backgrounds. Instead
//! of the input file it is given this transcript: a constant header and descriptor, the masks validated by
//! the walk, and the value chunks, byte for byte.

use super::block::BlockFormat;
use super::header::{MAGIC, VERSION_MULTIPASS_IO, VERSION_NODE_MASK_COMPRESSION};

/// Name of the only grid in a transcript.
pub(super) const GRID_NAME: &str = "grid";

/// A transcript up to the start of the tree, with the position of its offsets.
pub(super) struct Transcript {
    bytes: Vec<u8>,
    offsets_at: usize,
    grid: u64,
}

impl Transcript {
    /// Writes the data in front of the tree. `capacity` is the expected total size in bytes.
    pub(super) fn begin(format: &BlockFormat, capacity: usize) -> Self {
        let mut bytes = Vec::with_capacity(capacity);
        bytes.extend(MAGIC);
        for word in [format.version.min(VERSION_MULTIPASS_IO), 0, 0] {
            bytes.extend(word.to_le_bytes()); // file version, library version
        }
        bytes.push(1); // has offsets
        let flags = format.compression.flags();
        if format.version < VERSION_NODE_MASK_COMPRESSION {
            bytes.push(u8::from(flags != 0));
        }
        bytes.extend([b'0'; 36]); // unique id
        bytes.extend(0_u32.to_le_bytes()); // entries of file metadata
        bytes.extend(1_u32.to_le_bytes()); // grids
        for text in [GRID_NAME, "", ""] {
            push_text(&mut bytes, text); // name, type, instance parent
        }
        let offsets_at = bytes.len();
        bytes.extend([0; 24]);
        let grid = bytes.len() as u64;
        if format.version >= VERSION_NODE_MASK_COMPRESSION {
            bytes.extend(flags.to_le_bytes());
        }
        bytes.extend(1_u32.to_le_bytes()); // entries of grid metadata
        push_text(&mut bytes, "is_saved_as_half_float");
        push_text(&mut bytes, "bool");
        bytes.extend(1_u32.to_le_bytes());
        bytes.push(u8::from(format.stored.is_half()));
        push_text(&mut bytes, "UniformScaleMap"); // not used: the actual map has been read
        bytes.extend([0; 5 * 3 * size_of::<f64>()]);
        Self { bytes, offsets_at, grid }
    }

    /// Buffer to which the walk appends validated bytes.
    pub(super) fn tree(&mut self) -> &mut Vec<u8> {
        &mut self.bytes
    }

    /// Fills in the offsets. `blocks` is the length of the transcript before the leaf values.
    pub(super) fn finish(mut self, blocks: u64) -> Vec<u8> {
        let end = self.bytes.len() as u64;
        let offsets = [self.grid, blocks, end].map(u64::to_le_bytes).concat();
        self.bytes[self.offsets_at..self.offsets_at + offsets.len()].copy_from_slice(&offsets);
        self.bytes
    }
}

fn push_text(bytes: &mut Vec<u8>, text: &str) {
    bytes.extend((text.len() as u32).to_le_bytes());
    bytes.extend(text.as_bytes());
}
