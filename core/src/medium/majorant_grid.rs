//! Local upper bounds of a field: one per cell of a coarse lattice over the unit cube.

use super::{CellWalk, Grid, Interpolation};
use crate::math::BoxRay;
use glam::Vec3;
use rayon::prelude::*;

/// How far beyond its own cell a bound holds, in samples: a point on a ray may round across a face.
const REACH: f32 = 1e-3;

/// Bounds of an interpolated field over `n³` cells of the unit cube.
#[derive(Clone, Debug)]
pub struct MajorantGrid<const C: usize> {
    cells: usize,
    /// `(n + 2)³` bounds, x fastest: the outermost layer is empty, so that a walk which rounds out of the
    /// cube finds nothing there.
    padded: Vec<[f32; C]>,
    /// Mean of the field over each of `n³` cells, largest channel.
    mean: Vec<f32>,
}

impl<const C: usize> MajorantGrid<C> {
    /// Bounds the field that look-ups see over every cell, neighbouring samples included: a stochastic look-up
    /// may meet any of those.
    ///
    /// Trilinear interpolation is linear along every axis, so it is largest at the samples and where the
    /// cell's faces cut the lattice; taking the maximum axis by axis never falls below that, and exceeds
    /// it by less than the largest neighbouring sample does.
    #[must_use]
    pub fn new(grid: &Grid<C>, cells: usize, interpolation: Interpolation) -> Self {
        let cells = cells.max(1);
        let spans: [Vec<Span>; 3] = std::array::from_fn(|axis| {
            (0..cells).map(|i| Span::of_cell(grid, (axis, i, cells), interpolation)).collect()
        });
        let (bound, mean): (Vec<_>, Vec<_>) = (0..cells * cells)
            .into_par_iter()
            .flat_map_iter(|yz| {
                let (y, z) = (&spans[1][yz % cells], &spans[2][yz / cells]);
                spans[0].iter().map(move |x| summary(grid, [x, y, z]))
            })
            .unzip();
        Self::padded(cells, &bound, mean)
    }

    fn padded(cells: usize, bound: &[[f32; C]], mean: Vec<f32>) -> Self {
        let mut grid = Self { cells, padded: vec![[0.0; C]; (cells + 2).pow(3)], mean };
        for (yz, row) in bound.chunks_exact(cells).enumerate() {
            let first = grid.number([0, yz % cells, yz / cells]);
            grid.padded[first..first + cells].copy_from_slice(row);
        }
        grid
    }

    /// Half as many cells per axis, each the largest of eight; `None` for an odd number of cells.
    #[must_use]
    pub fn halved(&self) -> Option<Self> {
        if !self.cells.is_multiple_of(2) {
            return None;
        }
        let half = self.cells / 2;
        let eight = |cell: usize| {
            let at = [cell % half, cell / half % half, cell / half / half];
            (0..8).map(move |corner: usize| {
                std::array::from_fn::<usize, 3, _>(|axis| 2 * at[axis] + (corner >> axis & 1))
            })
        };
        let largest = |cell| {
            let bounds = eight(cell).map(|at| self.bound(at));
            bounds.fold([0.0f32; C], |max, bound| std::array::from_fn(|c| max[c].max(bound[c])))
        };
        let mean = |cell| eight(cell).map(|at| self.mean(at)).sum::<f32>() / 8.0;
        let bound: Vec<_> = (0..half.pow(3)).map(largest).collect();
        Some(Self::padded(half, &bound, (0..half.pow(3)).map(mean).collect()))
    }

    /// Cells per axis.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.cells
    }

    /// The bound of the field in a cell.
    #[must_use]
    pub fn bound(&self, cell: [usize; 3]) -> [f32; C] {
        self.padded[self.number(cell)]
    }

    /// Mean of the field over a cell, largest channel.
    #[must_use]
    pub fn mean(&self, [x, y, z]: [usize; 3]) -> f32 {
        self.mean[x + self.cells * (y + self.cells * z)]
    }

    /// Mean over all cells of the bound's largest channel: what a straight line through the box meets.
    #[must_use]
    pub fn mean_bound(&self) -> f32 {
        let largest = |bound: &[f32; C]| f64::from(bound.iter().fold(0.0f32, |a, b| a.max(*b)));
        (self.padded.iter().map(largest).sum::<f64>() / self.cells.pow(3) as f64) as f32
    }

    /// What a cell goes by in a walk.
    #[inline]
    pub(super) fn number(&self, [x, y, z]: [usize; 3]) -> usize {
        let [_, row, layer] = self.strides();
        (x + 1) + row * (y + 1) + layer * (z + 1)
    }

    /// Between the numbers of neighbours along each axis.
    #[inline]
    pub(super) fn strides(&self) -> [usize; 3] {
        let row = self.cells + 2;
        [1, row, row * row]
    }

    /// The bound by a cell's number; nothing beyond the last.
    #[inline]
    pub(super) fn bound_by_number(&self, number: usize) -> [f32; C] {
        self.padded.get(number).copied().unwrap_or([0.0; C])
    }

    /// The cells that a ray crosses up to `t_end`.
    #[must_use]
    #[inline]
    pub fn walk(&self, ray: &BoxRay) -> CellWalk<'_, C> {
        CellWalk::new(self, ray)
    }
}

/// Where a cell lies along one axis, in samples.
struct Span {
    /// The cell and a little more, held inside the lattice.
    from: f32,
    to: f32,
    /// Samples that are needed to interpolate in it.
    first: usize,
    last: usize,
}

impl Span {
    fn of_cell<const C: usize>(
        grid: &Grid<C>,
        (axis, cell, cells): (usize, usize, usize),
        interpolation: Interpolation,
    ) -> Self {
        let last = (grid.size()[axis] - 1) as f32;
        let index = |edge: usize| grid.index_from_unit(Vec3::splat(edge as f32 / cells as f32))[axis];
        let from = (index(cell) - REACH).clamp(0.0, last);
        let to = (index(cell + 1) + REACH).clamp(0.0, last);
        let (first, last) = (from.floor(), to.ceil());
        let (from, to) = match interpolation {
            Interpolation::Trilinear => (from, to),
            Interpolation::Stochastic => (first, last),
        };
        Self { from, to, first: first as usize, last: last as usize }
    }

    /// The largest value of the piecewise linear function through `values` (samples `first..=last`).
    fn largest(&self, values: impl Fn(usize) -> f32) -> f32 {
        let at = |x: f32| {
            let i = (x as usize).min(self.last);
            let (a, b) = (values(i), values((i + 1).min(self.last)));
            a + (b - a) * (x - i as f32)
        };
        let inside = (self.from.ceil() as usize)..=(self.to.floor() as usize);
        inside.map(&values).fold(at(self.from).max(at(self.to)), f32::max)
    }
}

/// Bound and mean of one cell.
fn summary<const C: usize>(grid: &Grid<C>, [x, y, z]: [&Span; 3]) -> ([f32; C], f32) {
    if grid.is_empty([x.first, y.first, z.first], [x.last, y.last, z.last]) {
        return ([0.0; C], 0.0);
    }
    let mut bound = [0.0f32; C];
    let mut mean = 0.0f32;
    let samples = (x.last - x.first + 1) * (y.last - y.first + 1) * (z.last - z.first + 1);
    for (c, bound) in bound.iter_mut().enumerate() {
        let mut sum = 0.0f32;
        let mut planes = Vec::with_capacity(z.last - z.first + 1);
        for k in z.first..=z.last {
            let mut rows = Vec::with_capacity(y.last - y.first + 1);
            for j in y.first..=y.last {
                let row: Vec<f32> = (x.first..=x.last).map(|i| grid.sample([i, j, k])[c]).collect();
                sum += row.iter().sum::<f32>();
                rows.push(x.largest(|i| row[i - x.first]));
            }
            planes.push(y.largest(|j| rows[j - y.first]));
        }
        *bound = z.largest(|k| planes[k - z.first]);
        mean = mean.max(sum / samples as f32);
    }
    // Rounding in the interpolation itself is relative to the values.
    (bound.map(|b| b * (1.0 + 4.0 * f32::EPSILON)), mean)
}
