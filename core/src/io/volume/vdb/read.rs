//! Unpacking of a validated grid by `vdb-rs`; the result is flattened and checked again.

use std::io::Cursor as IoCursor;
use std::panic::{AssertUnwindSafe, catch_unwind};

use half::f16;
use vdb_rs::{Grid, Node4, Node5, VdbReader};

use super::super::counted::Counted;
use super::super::error::Fault;
use super::super::read_limits::allocate;
use super::block::BlockFormat;
use super::mask;
use super::preflight::Preflight;
use super::sparse::{LEAF_EDGE, LEAF_VOXELS, Leaf, SparseGrid, Tile};
use super::transcript::GRID_NAME;
use super::tree::{Topology, UPPER_EDGE};
use super::value_type::Stored;

/// A voxel value as read by `vdb-rs`.
trait StoredValue: Copy {
    /// Values per channel; a scalar is repeated in all three channels.
    fn channels(self) -> [f32; 3];
}

macro_rules! impl_stored_value {
    ($($stored:ty => |$value:ident| $number:expr;)*) => {$(
        impl StoredValue for $stored {
            fn channels(self) -> [f32; 3] {
                let $value = self;
                [$number; 3]
            }
        }
        impl StoredValue for [$stored; 3] {
            fn channels(self) -> [f32; 3] {
                self.map(|$value| $number)
            }
        }
    )*};
}
impl_stored_value! {
    f16 => |value| value.to_f32();
    f32 => |value| value;
    f64 => |value| value as f32;
    i32 => |value| value as f32;
    i64 => |value| value as f32;
}

/// Unpacks a validated grid, reporting the completed fraction to `watch`.
///
/// # Errors
/// When `vdb-rs` fails, or its tree disagrees with the walk, or with the writer's voxel count and bounding
/// box.
pub(super) fn unpack(preflight: Preflight, watch: &dyn Fn(f64)) -> Result<SparseGrid, Fault> {
    let Preflight { transcript, format, topology, voxel_count, bbox, .. } = preflight;
    // The transcript contains nothing on which `vdb-rs` is known to panic. If it panics nevertheless, the
    // user gets an error and the program continues.
    let unpacked = catch_unwind(AssertUnwindSafe(|| unpack_transcript(&transcript, &format, watch)));
    let mut grid = unpacked.unwrap_or_else(|_| {
        Err(Fault::unsupported(
            "vdb-rs panicked on this grid",
            "Please report it with the file; meanwhile, save the grid again with zip compression",
        ))
    })?;
    check_topology(&grid, &topology)?;
    grid.background = topology.background;
    grid.tiles.extend(topology.root_tiles);
    check_summary(&grid, voxel_count, bbox)?;
    Ok(grid)
}

fn unpack_transcript(
    transcript: &[u8],
    format: &BlockFormat,
    watch: &dyn Fn(f64),
) -> Result<SparseGrid, Fault> {
    macro_rules! unpack_as {
        ($stored:ty) => {{
            let counted = Counted::new(IoCursor::new(transcript), transcript.len(), watch);
            let mut reader = VdbReader::new(counted).map_err(refusal)?;
            flatten(reader.read_grid::<$stored>(GRID_NAME).map_err(refusal)?, format)
        }};
    }
    match format.stored {
        Stored::F16 => unpack_as!(f16),
        Stored::F32 => unpack_as!(f32),
        Stored::F64 => unpack_as!(f64),
        Stored::I32 => unpack_as!(i32),
        Stored::I64 => unpack_as!(i64),
        Stored::F16x3 => unpack_as!([f16; 3]),
        Stored::F32x3 => unpack_as!([f32; 3]),
        Stored::F64x3 => unpack_as!([f64; 3]),
    }
}

fn refusal(error: vdb_rs::ParseError) -> Fault {
    let what = match &error {
        vdb_rs::ParseError::IoError(source) => {
            format!("a value chunk cannot be unpacked: {source}")
        }
        other => format!("a value chunk cannot be unpacked: {other}"),
    };
    Fault::invalid(None, what)
}

/// Converts the tree to leaves and tiles, consuming it node by node to limit memory.
fn flatten<T: StoredValue>(tree: Grid<T>, format: &BlockFormat) -> Result<SparseGrid, Fault> {
    let channels = format.value_type.channels();
    let lower_nodes = || tree.tree.root_nodes.iter().flat_map(|upper| upper.nodes.values());
    let leaf_count: usize = lower_nodes().map(|lower| lower.nodes.len()).sum();
    let mut grid = SparseGrid {
        channels,
        background: [0.0; 3],
        leaves: allocate(leaf_count)?,
        leaf_values: allocate(leaf_count.saturating_mul(LEAF_VOXELS * channels))?,
        tiles: Vec::new(),
    };
    for upper in tree.tree.root_nodes {
        let Node5 { child_mask, value_mask, nodes, data, origin } = upper;
        let masks = (child_mask.as_raw_slice(), value_mask.as_raw_slice());
        push_tiles(&mut grid.tiles, masks, &data, origin.to_array(), (5, UPPER_EDGE), format)?;
        // `vdb-rs` stores children in a hash map; the file has them in ascending order.
        for (_, lower) in in_order(nodes) {
            let Node4 { child_mask, value_mask, nodes, data, origin } = lower;
            let masks = (child_mask.as_raw_slice(), value_mask.as_raw_slice());
            push_tiles(&mut grid.tiles, masks, &data, origin.to_array(), (4, LEAF_EDGE), format)?;
            for (_, leaf) in in_order(nodes) {
                let words = leaf.value_mask.as_raw_slice();
                let active = <[u64; 8]>::try_from(words).map_err(|_| wrong_length("leaf mask"))?;
                if leaf.buffer.len() != LEAF_VOXELS {
                    return Err(wrong_length("leaf"));
                }
                grid.leaves.push(Leaf { origin: leaf.origin.to_array(), active });
                for value in leaf.buffer {
                    grid.leaf_values.extend_from_slice(&value.channels()[..channels]);
                }
            }
        }
    }
    Ok(grid)
}

fn in_order<T>(nodes: std::collections::HashMap<u32, T>) -> Vec<(u32, T)> {
    let mut nodes: Vec<_> = nodes.into_iter().collect();
    nodes.sort_unstable_by_key(|(index, _)| *index);
    nodes
}

/// Adds the active tiles of an internal node with 2^`log2_dim` entries per axis, each of `edge` voxels.
fn push_tiles<T: StoredValue>(
    tiles: &mut Vec<Tile>,
    (children, active): (&[u64], &[u64]),
    data: &[T],
    origin: [i32; 3],
    (log2_dim, edge): (u32, i32),
    format: &BlockFormat,
) -> Result<(), Fault> {
    // Before version 222 a node stores no values for its children, so that positions shift.
    let mut children = mask::ones(children).filter(|_| !format.is_tagged()).peekable();
    let mut children_before = 0;
    for entry in mask::ones(active) {
        while children.next_if(|&child| child < entry).is_some() {
            children_before += 1;
        }
        let value = data.get(entry - children_before).ok_or_else(|| wrong_length("tile block"))?;
        let origin = mask::add(origin, mask::entry_offset(entry, log2_dim, edge));
        tiles.push(Tile { origin, edge, value: value.channels() });
    }
    Ok(())
}

fn wrong_length(what: &str) -> Fault {
    Fault::invalid(None, format!("a {what} with the wrong number of values"))
}

/// Checks that the tree of `vdb-rs` has the leaves of the walk, in the same order.
fn check_topology(grid: &SparseGrid, topology: &Topology) -> Result<(), Fault> {
    let same = |(leaf, walked): (&Leaf, &([i32; 3], [u64; 8]))| (leaf.origin, leaf.active) == *walked;
    let all = grid.leaves.iter().zip(&topology.leaves).all(same);
    if all && grid.leaves.len() == topology.leaves.len() {
        return Ok(());
    }
    Err(Fault::invalid(None, "vdb-rs found leaves that differ from those of the walk through the tree"))
}

/// Checks voxel count and bounding box against those stated by the writer, if any.
fn check_summary(grid: &SparseGrid, voxel_count: Option<i64>, bbox: Option<[i32; 6]>) -> Result<(), Fault> {
    let counted = grid.active_voxels();
    if let Some(noted) = voxel_count.filter(|&noted| u64::try_from(noted) != Ok(counted)) {
        return Err(Fault::invalid(None, format!("{counted} active voxels, but the file notes {noted}")));
    }
    let found = grid.active_bbox().map(|bbox| bbox.to_array());
    match (found, bbox) {
        (Some(found), Some(noted)) if found != noted => {
            Err(Fault::invalid(None, format!("active voxels in {found:?}, but the file notes {noted:?}")))
        }
        _ => Ok(()),
    }
}
