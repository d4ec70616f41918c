//! List of the grids of an OpenVDB file, before their trees are walked.

use super::super::cursor::Cursor;
use super::super::error::Fault;
use super::compression::Compression;
use super::descriptor::{self, GridDescriptor};
use super::header::{Header, VERSION_NODE_MASK_COMPRESSION};
use super::map;
use super::metadata::Metadata;

/// Maximum number of grids of a file. Real files have fewer than 100; with instances each grid costs a walk.
const MAX_GRIDS: u32 = 1024;

/// An OpenVDB file with its header and list of grids.
#[derive(Debug)]
pub(super) struct Archive<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) header: Header,
    /// In file order.
    pub(super) grids: Vec<GridDescriptor>,
    /// Number of grids stated by the file that cannot be found; see [`Archive::open`].
    pub(super) unreachable: u32,
}

/// Data in front of the tree of a grid.
#[derive(Debug)]
pub(super) struct GridHead<'a> {
    pub(super) compression: Compression,
    pub(super) metadata: Metadata<'a>,
    pub(super) map_type: String,
    /// World from index, and a cursor at the tree; or the reason why this map cannot be read.
    pub(super) map: Result<(glam::DAffine3, Cursor<'a>), Fault>,
}

/// Finds the offset behind a grid, by its index in the archive read so far.
pub(super) type EndOfGrid<'f> = &'f dyn Fn(&Archive<'_>, usize) -> Result<u64, Fault>;

impl<'a> Archive<'a> {
    /// Reads the header of the file and the list of its grids.
    ///
    /// In a file without offsets `end_of_grid` finds the end of a grid by a walk through its tree;
    /// behind a grid that cannot be walked, no other can be found.
    pub(super) fn open(bytes: &'a [u8], end_of_grid: EndOfGrid<'_>) -> Result<Self, Fault> {
        let mut cursor = Cursor::new(bytes);
        let header = Header::read(&mut cursor)?;
        Self::find_grids(bytes, cursor, header.clone(), end_of_grid).map_err(|fault| header.blamed(fault))
    }

    /// Reads the list of grids that follows the header.
    fn find_grids(
        bytes: &'a [u8],
        mut cursor: Cursor<'a>,
        header: Header,
        end_of_grid: EndOfGrid<'_>,
    ) -> Result<Self, Fault> {
        let count = header.grid_count;
        if count > MAX_GRIDS {
            return Err(Fault::too_large(
                "the list of grids",
                format_args!("{count} grids"),
                MAX_GRIDS,
                "Copy or export the file again, with fewer grids",
            ));
        }
        let mut archive = Self { bytes, header, grids: Vec::new(), unreachable: 0 };
        for index in 0..count {
            let grid = GridDescriptor::read(&mut cursor, &archive.header)?;
            let end = grid.extent.end;
            archive.grids.push(grid);
            if index + 1 == count {
                break;
            }
            let end = match end {
                Some(end) => end,
                None => match end_of_grid(&archive, archive.grids.len() - 1) {
                    Ok(end) => end,
                    // The error is reported when this grid is requested.
                    Err(_) => {
                        archive.unreachable = count - index - 1;
                        break;
                    }
                },
            };
            cursor = Cursor::window(bytes, end, bytes.len() as u64)?;
        }
        descriptor::number_duplicates(&mut archive.grids);
        Ok(archive)
    }

    /// Display names, in file order.
    pub(super) fn names(&self) -> Vec<String> {
        self.grids.iter().map(|grid| grid.display_name.clone()).collect()
    }

    /// Reads the data in front of the tree of a grid.
    pub(super) fn grid_head(&self, grid: &GridDescriptor) -> Result<GridHead<'a>, Fault> {
        let file_end = self.bytes.len() as u64;
        let extent = grid.extent;
        let mut cursor = Cursor::window(self.bytes, extent.grid, extent.end.unwrap_or(file_end))?;
        let at = cursor.position();
        let flags = if self.header.version < VERSION_NODE_MASK_COMPRESSION {
            self.header.compression
        } else {
            cursor.u32()?
        };
        let compression = Compression::from_flags(flags, at)?;
        let metadata = Metadata::read(&mut cursor)?;
        let map_type = cursor.text()?;
        let map = map::read(&map_type, &mut cursor).map(|map| (map, cursor));
        Ok(GridHead { compression, metadata, map_type, map })
    }

    /// Grid that owns the tree of a grid: itself, or the parent of an instance.
    pub(super) fn tree_owner<'g>(&'g self, grid: &'g GridDescriptor) -> Result<&'g GridDescriptor, Fault> {
        let parent = &grid.instance_parent;
        if parent.is_empty() {
            return Ok(grid);
        }
        let owner = self.grids.iter().find(|other| other.unique_name == *parent);
        owner.filter(|owner| owner.instance_parent.is_empty()).ok_or_else(|| {
            Fault::invalid(None, format!("it shares the tree of \"{parent}\", which is not in the file"))
        })
    }
}
