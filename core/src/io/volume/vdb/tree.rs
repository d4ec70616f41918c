//! Walk through a tree that validates every mask, tile and value block against the length of the file.
//!
//! Layout after OpenVDB's `tree/RootNode.h`, `tree/InternalNode.h` and `tree/LeafNode.h` (`readTopology`,
//! then `readBuffers`), for the 5-4-3 tree. Validated bytes are copied to a transcript; see
//! [`super::transcript`].

use std::collections::HashSet;

use super::super::cursor::Cursor;
use super::super::error::Fault;
use super::super::read_limits::ReadLimits;
use super::block::BlockFormat;
use super::mask;
use super::sparse::{LEAF_EDGE, LEAF_VOXELS, Tile};

/// Voxels along the edge of a root tile or child.
pub(super) const ROOT_EDGE: i32 = 4096;
/// Voxels along the edge of an entry of a 32³ node, that is, of a 16³ node.
pub(super) const UPPER_EDGE: i32 = 128;

const UPPER_LOG2: u32 = 5;
const LOWER_LOG2: u32 = 4;
const UPPER_WORDS: usize = (1 << (3 * UPPER_LOG2)) / 64;
const LOWER_WORDS: usize = (1 << (3 * LOWER_LOG2)) / 64;
const LEAF_WORDS: usize = 8;

/// Topology found by the walk, without values.
#[derive(Debug, Default)]
pub(super) struct Topology {
    /// Value of all voxels that are not in the tree.
    pub(super) background: [f32; 3],
    /// Active tiles of the root; `vdb-rs` skips them, so they are taken from here.
    pub(super) root_tiles: Vec<Tile>,
    /// Origin and active mask of each leaf, in file order.
    pub(super) leaves: Vec<([i32; 3], [u64; LEAF_WORDS])>,
}

/// A walk in progress.
pub(super) struct Walk<'a, 'out> {
    cursor: Cursor<'a>,
    out: &'out mut Vec<u8>,
    format: BlockFormat,
    unpacked_bytes: u64,
    max_unpacked_bytes: u64,
    topology: Topology,
}

impl<'a, 'out> Walk<'a, 'out> {
    /// Starts at the first byte of the tree; validated bytes are appended to `out`.
    pub(super) fn new(
        cursor: Cursor<'a>,
        out: &'out mut Vec<u8>,
        format: BlockFormat,
        limits: &ReadLimits,
    ) -> Self {
        Self {
            cursor,
            out,
            format,
            unpacked_bytes: 0,
            max_unpacked_bytes: limits.max_tree_bytes,
            topology: Topology::default(),
        }
    }

    /// Offset of the next unread byte.
    pub(super) fn position(&self) -> u64 {
        self.cursor.position()
    }

    /// Length of the transcript so far, in bytes.
    pub(super) fn written(&self) -> u64 {
        self.out.len() as u64
    }

    /// Reads the first half: the root, its tiles, and all masks.
    pub(super) fn topology(&mut self) -> Result<(), Fault> {
        let at = self.position();
        let buffers = self.cursor.u32()?;
        if buffers != 1 {
            return Err(Fault::invalid(at, format!("a tree with {buffers} buffers instead of 1")));
        }
        self.topology.background = self.format.value_type.read(&mut self.cursor)?;
        let (tiles, children) = (self.cursor.u32()?, self.cursor.u32()?);
        // Buffers, background (four bytes for every type), tiles, children.
        for word in [1, 0, 0, children] {
            self.out.extend(word.to_le_bytes());
        }
        let mut origins = HashSet::new();
        for _ in 0..tiles {
            let origin = self.root_origin(&mut origins)?;
            let value = self.format.value_type.read(&mut self.cursor)?;
            if self.cursor.u8()? != 0 {
                self.topology.root_tiles.push(Tile { origin, edge: ROOT_EDGE, value });
            }
        }
        for _ in 0..children {
            let origin = self.root_origin(&mut origins)?;
            for coordinate in origin {
                self.out.extend(coordinate.to_le_bytes());
            }
            self.upper_node(origin)?;
        }
        Ok(())
    }

    /// Reads the second half: the values of the leaves.
    pub(super) fn leaf_values(&mut self) -> Result<(), Fault> {
        let leaves = std::mem::take(&mut self.topology.leaves);
        for (origin, active) in &leaves {
            let at = self.position();
            if self.masks::<LEAF_WORDS>()? != *active {
                return Err(Fault::invalid(
                    at,
                    format!("the two active masks of the leaf at {origin:?} differ"),
                ));
            }
            if !self.format.is_tagged() {
                let (again, buffers) = (self.cursor.i32x3()?, self.cursor.u8()?);
                if again != *origin || buffers != 1 {
                    return Err(Fault::invalid(
                        at,
                        format!("{buffers} buffers of a leaf at {again:?} instead of 1 at {origin:?}"),
                    ));
                }
                for coordinate in origin {
                    self.out.extend(coordinate.to_le_bytes());
                }
                self.out.push(1);
            }
            self.values(LEAF_VOXELS, active)?;
        }
        self.topology.leaves = leaves;
        Ok(())
    }

    /// Returns the topology.
    pub(super) fn finish(self) -> Topology {
        self.topology
    }

    /// Checks that the leaf values start at the offset stated by the file.
    pub(super) fn expect_leaf_values_at(&self, blocks: u64) -> Result<(), Fault> {
        let here = self.position();
        if blocks != here {
            return Err(Fault::invalid(
                here,
                format!("the leaf values are declared to start at byte {blocks}, but the masks end here"),
            ));
        }
        Ok(())
    }

    /// Reads the origin of a root tile or child: a multiple of its edge, without duplicates.
    fn root_origin(&mut self, seen: &mut HashSet<[i32; 3]>) -> Result<[i32; 3], Fault> {
        let at = self.position();
        let origin = self.cursor.i32x3()?;
        if origin.iter().any(|n| n % ROOT_EDGE != 0) || !seen.insert(origin) {
            return Err(Fault::invalid(
                at,
                format!("the root entry at {origin:?} is off the {ROOT_EDGE} grid, or a duplicate"),
            ));
        }
        Ok(origin)
    }

    fn upper_node(&mut self, origin: [i32; 3]) -> Result<(), Fault> {
        let children = self.internal_node::<UPPER_WORDS>()?;
        for child in mask::ones(&children) {
            let offset = mask::entry_offset(child, UPPER_LOG2, UPPER_EDGE);
            self.lower_node(mask::add(origin, offset))?;
        }
        Ok(())
    }

    fn lower_node(&mut self, origin: [i32; 3]) -> Result<(), Fault> {
        let children = self.internal_node::<LOWER_WORDS>()?;
        for child in mask::ones(&children) {
            let offset = mask::entry_offset(child, LOWER_LOG2, LEAF_EDGE);
            let active = self.masks::<LEAF_WORDS>()?;
            self.topology.leaves.push((mask::add(origin, offset), active));
        }
        Ok(())
    }

    /// Reads masks and tile values of an internal node; returns the mask of its children.
    fn internal_node<const WORDS: usize>(&mut self) -> Result<[u64; WORDS], Fault> {
        let at = self.position();
        let children = self.masks::<WORDS>()?;
        let active = self.masks::<WORDS>()?;
        if children.iter().zip(&active).any(|(child, tile)| child & tile != 0) {
            return Err(Fault::invalid(at, "a node entry that is both a child and an active tile"));
        }
        let entries = 64 * WORDS;
        // Before version 222 children have no value of their own.
        let len = if self.format.is_tagged() { entries } else { entries - mask::count_ones(&children) };
        self.values(len, &active)?;
        Ok(children)
    }

    fn masks<const WORDS: usize>(&mut self) -> Result<[u64; WORDS], Fault> {
        let words = self.cursor.words::<WORDS>()?;
        for word in words {
            self.out.extend(word.to_le_bytes());
        }
        Ok(words)
    }

    /// Reads a value block, counted against the limit on unpacked bytes.
    fn values(&mut self, len: usize, active: &[u64]) -> Result<(), Fault> {
        self.unpacked_bytes += (len * self.format.value_type.bytes()) as u64;
        if self.unpacked_bytes > self.max_unpacked_bytes {
            return Err(Fault::too_large(
                "the unpacked tree",
                format_args!("more than {} bytes", self.unpacked_bytes),
                format_args!("{} bytes", self.max_unpacked_bytes),
                "Crop or resample the volume to a coarser voxel size",
            ));
        }
        self.format.copy(&mut self.cursor, self.out, len, active)
    }
}
