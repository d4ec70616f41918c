//! A tree flattened to leaves and tiles; its size does not depend on the extent of the volume.

use super::mask;

/// Voxels along the edge of a leaf, that is, of an entry of a 16³ node.
pub(super) const LEAF_EDGE: i32 = 8;
/// Voxels of a leaf.
pub(super) const LEAF_VOXELS: usize = 512;

/// An 8³ block of voxels.
#[derive(Debug, Clone)]
pub(super) struct Leaf {
    /// Index coordinates of its first voxel.
    pub(super) origin: [i32; 3],
    /// Mask of active voxels: one word per x, bits `8 y + z`.
    pub(super) active: [u64; 8],
}

/// An active cube of constant value.
#[derive(Debug, Clone)]
pub(super) struct Tile {
    /// Index coordinates of its first voxel.
    pub(super) origin: [i32; 3],
    /// Voxels along an edge: 8, 128 or 4096.
    pub(super) edge: i32,
    /// Value per channel; a scalar is repeated in all three channels.
    pub(super) value: [f32; 3],
}

/// A grid as leaves and tiles. Inactive voxels have the background value.
#[derive(Debug)]
pub(super) struct SparseGrid {
    /// Values per voxel: 1 or 3.
    pub(super) channels: usize,
    pub(super) background: [f32; 3],
    pub(super) leaves: Vec<Leaf>,
    /// Values of all leaves, 512 voxels each, z fastest; channels interleaved.
    pub(super) leaf_values: Vec<f32>,
    pub(super) tiles: Vec<Tile>,
}

/// First and last index coordinates, both inclusive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct IndexBox {
    pub(super) min: [i32; 3],
    pub(super) max: [i32; 3],
}

/// Statistics of the active voxels. Tiles count by their volume.
#[derive(Debug, Clone, Default)]
pub(super) struct ActiveStats {
    pub(super) voxels: u64,
    /// Voxels with a NaN or infinite channel; excluded from the values below.
    pub(super) non_finite: u64,
    /// Smallest value over all channels.
    pub(super) min: Option<f32>,
    /// Largest value over all channels.
    pub(super) max: Option<f32>,
    sum: f64,
}

impl SparseGrid {
    /// Leaves with their values.
    pub(super) fn leaves(&self) -> impl Iterator<Item = (&Leaf, &[f32])> {
        let values = self.leaf_values.chunks_exact(LEAF_VOXELS * self.channels);
        self.leaves.iter().zip(values)
    }

    /// Bounding box of the active voxels; `None` if there are none.
    pub(super) fn active_bbox(&self) -> Option<IndexBox> {
        let leaves = self.leaves.iter().filter_map(Leaf::active_bbox);
        leaves.chain(self.tiles.iter().map(Tile::bbox)).reduce(IndexBox::union)
    }

    /// Number of active voxels.
    pub(super) fn active_voxels(&self) -> u64 {
        let in_leaves: u64 = self.leaves.iter().map(|l| mask::count_ones(&l.active) as u64).sum();
        self.tiles.iter().fold(in_leaves, |sum, tile| sum.saturating_add(tile.voxels()))
    }

    /// Statistics of the active voxels.
    pub(super) fn stats(&self) -> ActiveStats {
        let mut stats = ActiveStats::default();
        for (leaf, values) in self.leaves() {
            for voxel in mask::ones(&leaf.active) {
                stats.add(&values[voxel * self.channels..(voxel + 1) * self.channels], 1);
            }
        }
        for tile in &self.tiles {
            stats.add(&tile.value[..self.channels], tile.voxels());
        }
        stats
    }
}

impl Leaf {
    fn active_bbox(&self) -> Option<IndexBox> {
        let x_bits = self.active.iter().rev().fold(0_u8, |bits, &w| bits << 1 | u8::from(w != 0));
        let rows = self.active.iter().fold(0, |all, word| all | word).to_le_bytes();
        let y_bits = rows.iter().rev().fold(0_u8, |bits, &row| bits << 1 | u8::from(row != 0));
        let z_bits = rows.iter().fold(0, |all, row| all | row);
        let axes = [x_bits, y_bits, z_bits];
        (x_bits != 0).then(|| IndexBox {
            min: mask::add(self.origin, axes.map(|bits| bits.trailing_zeros() as i32)),
            max: mask::add(self.origin, axes.map(|bits| LEAF_EDGE - 1 - bits.leading_zeros() as i32)),
        })
    }
}

impl Tile {
    pub(super) fn voxels(&self) -> u64 {
        u64::from(self.edge.unsigned_abs()).pow(3)
    }

    pub(super) fn bbox(&self) -> IndexBox {
        IndexBox { min: self.origin, max: mask::add(self.origin, [self.edge - 1; 3]) }
    }
}

impl IndexBox {
    fn union(self, other: Self) -> Self {
        Self {
            min: [0, 1, 2].map(|axis| self.min[axis].min(other.min[axis])),
            max: [0, 1, 2].map(|axis| self.max[axis].max(other.max[axis])),
        }
    }

    /// Intersection of both boxes; `None` if it is empty.
    pub(super) fn intersection(&self, other: &Self) -> Option<Self> {
        let min = [0, 1, 2].map(|axis| self.min[axis].max(other.min[axis]));
        let max = [0, 1, 2].map(|axis| self.max[axis].min(other.max[axis]));
        min.iter().zip(&max).all(|(min, max)| min <= max).then_some(Self { min, max })
    }

    /// Voxels along each axis.
    pub(super) fn size(&self) -> [u64; 3] {
        [0, 1, 2].map(|axis| u64::from(self.max[axis].abs_diff(self.min[axis])) + 1)
    }

    /// Minimum followed by maximum.
    pub(super) fn to_array(self) -> [i32; 6] {
        let ([x, y, z], [u, v, w]) = (self.min, self.max);
        [x, y, z, u, v, w]
    }
}

impl ActiveStats {
    /// Adds `volume` voxels of the same value.
    fn add(&mut self, channels: &[f32], volume: u64) {
        self.voxels = self.voxels.saturating_add(volume);
        if channels.iter().any(|value| !value.is_finite()) {
            self.non_finite = self.non_finite.saturating_add(volume);
            return;
        }
        for &value in channels {
            self.min = Some(self.min.map_or(value, |min| min.min(value)));
            self.max = Some(self.max.map_or(value, |max| max.max(value)));
            self.sum += f64::from(value) * volume as f64 / channels.len() as f64;
        }
    }

    /// Mean over the finite active voxels and all channels.
    pub(super) fn mean(&self) -> Option<f64> {
        let finite = self.voxels - self.non_finite;
        (finite > 0).then(|| self.sum / finite as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaf_bbox_is_tight() {
        let mut leaf = Leaf { origin: [8, -8, 16], active: [0; 8] };
        assert_eq!(leaf.active_bbox(), None);
        leaf.active[2] = 1 << (8 * 3 + 5);
        leaf.active[6] = 1 << (8 * 7 + 1);
        let expected = IndexBox { min: [10, -5, 17], max: [14, -1, 21] };
        assert_eq!(leaf.active_bbox(), Some(expected));
    }

    #[test]
    fn tiles_count_by_volume() {
        let tile = |edge, value| Tile { origin: [0; 3], edge, value: [value; 3] };
        let grid = SparseGrid {
            channels: 1,
            background: [0.0; 3],
            leaves: Vec::new(),
            leaf_values: Vec::new(),
            tiles: vec![tile(4096, 1.0), tile(8, 3.0), tile(8, f32::NAN)],
        };
        let stats = grid.stats();
        let (large, small) = (4096_f64.powi(3), 512.0);
        assert_eq!(stats.voxels, (large + 2.0 * small) as u64);
        assert_eq!(stats.non_finite, 512);
        assert_eq!(stats.mean(), Some((large + 3.0 * small) / (large + small)));
    }
}
