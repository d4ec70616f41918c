//! Grid descriptors of a file: names, types, and byte ranges.
//!
//! Layout after OpenVDB's `io/GridDescriptor.cc`.

use std::collections::HashMap;

use super::super::cursor::Cursor;
use super::super::error::Fault;
use super::header::Header;

/// Separator between the name of a grid and the number that makes it unique in its file.
const NAME_SEPARATOR: char = '\x1e';
/// Suffix of the type of a grid whose real numbers are saved as half floats.
const HALF_SUFFIX: &str = "_HalfFloat";

/// Descriptor of one grid.
#[derive(Debug, Clone)]
pub(super) struct GridDescriptor {
    /// Name with its `\x1eN` suffix, by which other grids refer to it.
    pub(super) unique_name: String,
    /// Display name without the suffix; the second grid of a name is `name[1]`.
    pub(super) display_name: String,
    /// Tree type without the half suffix, for example `Tree_float_5_4_3`.
    pub(super) tree_type: String,
    /// Whether the type has the half suffix.
    pub(super) half: bool,
    /// Unique name of the grid whose tree this one shares; empty if it has its own.
    pub(super) instance_parent: String,
    pub(super) extent: Extent,
}

/// Byte range of a grid, as offsets from the start of the file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    /// Start of compression flags, metadata, map and tree topology.
    pub(super) grid: u64,
    /// Start of the leaf values; in a file without offsets they follow the topology.
    pub(super) blocks: Option<u64>,
    /// End of the leaf values; unknown in a file without offsets.
    pub(super) end: Option<u64>,
}

impl GridDescriptor {
    /// Reads one descriptor; leaves the cursor at the bytes of the grid.
    pub(super) fn read(cursor: &mut Cursor, header: &Header) -> Result<Self, Fault> {
        let unique_name = cursor.text()?;
        let full_type = cursor.text()?;
        let (tree_type, half) = match full_type.strip_suffix(HALF_SUFFIX) {
            Some(stem) => (stem.to_owned(), true),
            None => (full_type, false),
        };
        let instance_parent = cursor.text()?;
        let at = cursor.position();
        let (grid, blocks, end) = (cursor.u64()?, cursor.u64()?, cursor.u64()?);
        // An instance has no leaf values and states an offset of 0 for them.
        let blocks = if instance_parent.is_empty() { blocks } else { end };
        let here = cursor.position();
        let extent = if header.has_offsets {
            let file_end = here + cursor.remaining() as u64;
            if !(here <= grid && grid <= blocks && blocks <= end && end <= file_end) {
                return Err(Fault::invalid(
                    at,
                    format!(
                        "the grid \"{unique_name}\" is declared to occupy bytes {grid}, {blocks} to \
                         {end} of a file of {file_end} bytes"
                    ),
                ));
            }
            Extent { grid, blocks: Some(blocks), end: Some(end) }
        } else {
            Extent { grid: here, blocks: None, end: None }
        };
        let display_name = match unique_name.split_once(NAME_SEPARATOR) {
            Some((name, _)) => name.to_owned(),
            None => unique_name.clone(),
        };
        Ok(Self { unique_name, display_name, tree_type, half, instance_parent, extent })
    }
}

/// Numbers the grids that share a display name, in file order: `density`, `density[1]`, ...
pub(super) fn number_duplicates(grids: &mut [GridDescriptor]) {
    let mut seen: HashMap<String, usize> = HashMap::new();
    for grid in grids {
        let count = seen.entry(grid.display_name.clone()).or_default();
        if *count > 0 {
            grid.display_name = format!("{}[{count}]", grid.display_name);
        }
        *count += 1;
    }
}
