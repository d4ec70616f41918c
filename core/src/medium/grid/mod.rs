//! Sample grids over the unit cube, with trilinear interpolation.

mod bricks;
mod pages;
mod precision;
mod store;
#[cfg(test)]
mod tests;

pub use bricks::{BRICK_EDGE, Bricks};
pub use precision::{Interpolation, Precision};

use crate::math::numbers_of_point;
use bricks::BRICK;
use glam::Vec3;
use rayon::prelude::*;
use store::Store;

/// Positions of the `n` samples along an axis of the unit cube.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lattice {
    /// Sample `i` at (i + ½)/n: `.npy` and `.vol`. The value is constant beyond the outermost samples.
    CellCentred,
    /// Sample `i` at i/(n − 1): OpenVDB, whose values are at integer indices.
    VertexCentred,
}

/// Storage format of samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Packing {
    /// Precision of every value.
    pub precision: Precision,
    /// Position of the first sample within a brick of the file, along every axis.
    pub phase: [usize; 3],
}

/// Grid with `C` values per sample, stored in bricks; empty bricks take no memory.
#[derive(Clone, Debug)]
pub struct Grid<const C: usize> {
    size: [usize; 3],
    store: Store<C>,
    /// Index = scale · unit + offset.
    scale: Vec3,
    offset: Vec3,
    last: Vec3,
    max: [f32; C],
    mean: [f32; C],
    occupied: usize,
    error: f32,
    precision: Precision,
}

impl<const C: usize> Grid<C> {
    /// Creates a grid with `size` samples per axis, x fastest, then y, then z; `None` if the number of values
    /// does not match or is zero.
    #[must_use]
    pub fn new(size: [usize; 3], values: Vec<[f32; C]>, lattice: Lattice) -> Option<Self> {
        Self::packed(size, &values, lattice, Packing::default())
    }

    /// As [`Self::new`], in a given storage format.
    #[must_use]
    pub fn packed(size: [usize; 3], values: &[[f32; C]], lattice: Lattice, packing: Packing) -> Option<Self> {
        Some(Self::of_bricks(Bricks::of_array(size, values, packing.phase)?, lattice, packing.precision))
    }

    /// Creates a grid from bricks.
    #[must_use]
    pub fn of_bricks(bricks: Bricks<C>, lattice: Lattice, precision: Precision) -> Self {
        let size = bricks.size;
        let n = Vec3::from(size.map(|n| n as f32));
        let last = n - Vec3::ONE;
        let (scale, offset) = match lattice {
            Lattice::CellCentred => (n, Vec3::splat(-0.5)),
            Lattice::VertexCentred => (last, Vec3::ZERO),
        };
        let uses = bricks.uses();
        let exact = (precision != Precision::F32).then(|| bricks.values.clone());
        let store = Store::new(bricks, precision);
        let totals: Vec<_> = uses
            .par_iter()
            .enumerate()
            .filter(|(_, uses)| **uses > 0)
            .map(|(brick, uses)| Totals::of_brick(&store, brick, *uses, exact.as_deref()))
            .collect();
        let Totals { max, sum, occupied, error } = totals.into_iter().fold(Totals::ZERO, Totals::and);
        let count = size.iter().map(|n| *n as f64).product::<f64>();
        let mean = sum.map(|s| (s / count) as f32);
        Self { size, store, scale, offset, last, max, mean, occupied, error, precision }
    }

    /// Trilinearly interpolated value at a point of the unit cube.
    #[must_use]
    #[inline]
    pub fn at(&self, unit: Vec3) -> [f32; C] {
        let index = (unit * self.scale + self.offset).clamp(Vec3::ZERO, self.last);
        let (x, y, z) = (index.x as u32 as usize, index.y as u32 as usize, index.z as u32 as usize);
        let f = index - Vec3::new(x as u32 as f32, y as u32 as f32, z as u32 as f32);
        // The upper neighbour of the last sample is the sample itself, with weight 0.
        let [nx, ny, nz] = self.size;
        let next = [(x + 1).min(nx - 1), (y + 1).min(ny - 1), (z + 1).min(nz - 1)];
        let v = self.store.corners([x, y, z], next);
        let lerp = |a: f32, b: f32, t: f32| a + (b - a) * t;
        std::array::from_fn(|c| {
            let along_x = |i: usize| lerp(v[i][c], v[i + 1][c], f.x);
            let along_y = |i: usize| lerp(along_x(i), along_x(i + 2), f.y);
            lerp(along_y(0), along_y(4), f.z)
        })
    }

    /// Value of one of the eight samples around a point of the unit cube, selected with its trilinear weight
    /// by three numbers uniform in [0, 1). The expectation is [`Self::at`], at the cost of a single fetch
    /// (Hofmann et al. 2021, "Efficient unbiased volume path tracing on the GPU").
    #[must_use]
    #[inline]
    pub fn at_stochastic(&self, unit: Vec3, u: Vec3) -> [f32; C] {
        let index = (unit * self.scale + self.offset).clamp(Vec3::ZERO, self.last) + u;
        let at = |i: f32, n: usize| (i as u32 as usize).min(n - 1);
        self.sample([at(index.x, self.size[0]), at(index.y, self.size[1]), at(index.z, self.size[2])])
    }

    /// Looks up a value with either interpolation. The random numbers of a stochastic look-up are a hash of
    /// the point and `salt`, which has to differ between grids that are looked up at the same point.
    #[must_use]
    #[inline]
    pub fn look_up(&self, unit: Vec3, interpolation: Interpolation, salt: u32) -> [f32; C] {
        match interpolation {
            Interpolation::Trilinear => self.at(unit),
            Interpolation::Stochastic => self.at_stochastic(unit, numbers_of_point(unit, salt)),
        }
    }

    /// Position of a point of the unit cube in samples; for some lattices beyond the outermost ones.
    #[must_use]
    pub fn index_from_unit(&self, unit: Vec3) -> Vec3 {
        unit * self.scale + self.offset
    }

    /// Value of one sample.
    #[must_use]
    #[inline]
    pub fn sample(&self, at: [usize; 3]) -> [f32; C] {
        self.store.sample(at)
    }

    /// Copies the samples of a row along x; returns false if all of them are known to be zero.
    pub(super) fn row(&self, yz: [usize; 2], row: &mut Vec<[f32; C]>) -> bool {
        self.store.row(yz, self.size[0], row)
    }

    /// Maximum per channel, which bounds the interpolated field.
    #[must_use]
    pub fn max(&self) -> [f32; C] {
        self.max
    }

    /// Mean per channel.
    #[must_use]
    pub fn mean(&self) -> [f32; C] {
        self.mean
    }

    /// Samples per axis, x, y, z.
    #[must_use]
    pub fn size(&self) -> [usize; 3] {
        self.size
    }

    /// Number of non-zero samples.
    #[must_use]
    pub fn occupied(&self) -> usize {
        self.occupied
    }

    /// Precision of the values.
    #[must_use]
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// Maximum error of any value due to reduced precision.
    #[must_use]
    pub fn storage_error(&self) -> f32 {
        self.error
    }

    /// Memory of the values and their index in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.store.bytes()
    }
}

/// Statistics of many samples.
struct Totals<const C: usize> {
    max: [f32; C],
    sum: [f64; C],
    occupied: usize,
    error: f32,
}

impl<const C: usize> Totals<C> {
    const ZERO: Self = Self { max: [0.0; C], sum: [0.0; C], occupied: 0, error: 0.0 };

    /// Statistics of a brick that is referenced `uses` times, with errors relative to its exact values.
    fn of_brick(store: &Store<C>, brick: usize, uses: u64, exact: Option<&[[f32; C]]>) -> Self {
        let mut totals = Self::ZERO;
        for place in brick * BRICK..(brick + 1) * BRICK {
            let kept = store.value(place);
            let value = exact.map_or(kept, |values| values[place]);
            totals.occupied += usize::from(value != [0.0; C]);
            for c in 0..C {
                totals.max[c] = totals.max[c].max(kept[c]);
                totals.sum[c] += f64::from(kept[c]);
                totals.error = totals.error.max((kept[c] - value[c]).abs());
            }
        }
        totals.occupied *= uses as usize;
        totals.sum = totals.sum.map(|sum| sum * uses as f64);
        totals
    }

    fn and(self, other: Self) -> Self {
        Self {
            max: std::array::from_fn(|c| self.max[c].max(other.max[c])),
            sum: std::array::from_fn(|c| self.sum[c] + other.sum[c]),
            occupied: self.occupied + other.occupied,
            error: self.error.max(other.error),
        }
    }
}
