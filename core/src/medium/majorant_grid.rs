//! Local upper and lower bounds of a field, per cell of a coarse grid over the unit cube.

use super::majorant::ROUNDED_UP;
use super::{CellWalk, Grid, Interpolation, Violations};
use crate::math::BoxRay;
use glam::Vec3;
use rayon::prelude::*;

/// Distance, in samples, by which bounds extend beyond their cell: rounding may move a point on a ray across
/// a face.
const REACH: f32 = 1e-3;

/// Bounds of an interpolated field over `n³` cells of the unit cube.
#[derive(Clone, Debug)]
pub struct MajorantGrid<const C: usize> {
    cells: usize,
    /// `(n + 2)³` bounds, x fastest. The outermost layer is zero, so that a walk that leaves the cube by
    /// rounding finds an empty cell.
    padded: Vec<[f32; C]>,
    /// Lower bounds of `n³` cells, x fastest.
    least: Vec<[f32; C]>,
    /// Mean of the field over each of `n³` cells, maximum over the channels.
    mean: Vec<f32>,
}

impl<const C: usize> MajorantGrid<C> {
    /// Computes bounds of the field over every cell, including neighbouring samples that look-ups read: a
    /// stochastic look-up may return any of them.
    ///
    /// Trilinear interpolation is linear along every axis, so its maximum is at the samples and where the
    /// cell's faces cut the lattice. The maximum taken axis by axis is never below that, and exceeds it by
    /// less than the largest neighbouring sample does.
    #[must_use]
    pub fn new(grid: &Grid<C>, cells: usize, interpolation: Interpolation) -> Self {
        let cells = cells.max(1);
        let spans: [Vec<Span>; 3] = std::array::from_fn(|axis| {
            (0..cells).map(|i| Span::of_cell(grid, (axis, i, cells), interpolation)).collect()
        });
        let size = grid.size();
        // One axis after the other, so that every sample is read once.
        let planes: Vec<_> = (0..size[2])
            .into_par_iter()
            .map_init(Vec::new, |row, z| {
                let rows: Vec<_> = (0..size[1])
                    .map(|y| grid.row([y, z], row).then(|| Summary::of_row(row, &spans[0])))
                    .collect();
                let cells: Vec<_> = spans[1].iter().map(|span| span.summary(&rows, cells)).collect();
                cells.iter().any(Option::is_some).then(|| Summary::joined(&cells, spans[0].len()))
            })
            .collect();
        let layers: Vec<_> = spans[2].par_iter().map(|span| span.summary(&planes, cells * cells)).collect();
        let Summary { largest, smallest, sum } = Summary::joined(&layers, cells * cells);
        // Rounding errors of the interpolation itself are relative to the values.
        let bound: Vec<_> = largest.iter().map(|b| b.map(|b| b * (1.0 + 4.0 * f32::EPSILON))).collect();
        let count = |cell: usize| {
            let at = [cell % cells, cell / cells % cells, cell / cells / cells];
            (0..3).map(|axis| spans[axis][at[axis]].samples()).product::<usize>() as f32
        };
        let most = |sum: &[f32; C]| sum.iter().fold(0.0f32, |a, b| a.max(*b));
        let mean = sum.iter().enumerate().map(|(cell, sum)| most(sum) / count(cell)).collect();
        let least = smallest.into_iter().map(|b| b.map(|b| b * (1.0 - 4.0 * f32::EPSILON))).collect();
        Self::padded(cells, &bound, least, mean)
    }

    fn padded(cells: usize, bound: &[[f32; C]], least: Vec<[f32; C]>, mean: Vec<f32>) -> Self {
        let mut grid = Self { cells, padded: vec![[0.0; C]; (cells + 2).pow(3)], least, mean };
        for (yz, row) in bound.chunks_exact(cells).enumerate() {
            let first = grid.number([0, yz % cells, yz / cells]);
            grid.padded[first..first + cells].copy_from_slice(row);
        }
        grid
    }

    /// Returns the grid with every bound multiplied by the maximum ratio of extinction to majorant found in
    /// its cell.
    #[must_use]
    pub fn raised(&self, by: &Violations) -> Self {
        let mut raised = self.clone();
        for cell in 0..self.cells.pow(3) {
            let at = [cell % self.cells, cell / self.cells % self.cells, cell / self.cells / self.cells];
            let quotient = by.largest(at);
            if quotient > 1.0 {
                let number = self.number(at);
                raised.padded[number] = raised.padded[number].map(|b| b * quotient * ROUNDED_UP);
            }
        }
        raised
    }

    /// Returns the grid with half as many cells per axis, each bounding eight cells; `None` for an odd number
    /// of cells.
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
        let smallest = |cell| {
            let bounds = eight(cell).map(|at| self.least(at));
            bounds.fold([f32::INFINITY; C], |min, bound| std::array::from_fn(|c| min[c].min(bound[c])))
        };
        let mean = |cell| eight(cell).map(|at| self.mean(at)).sum::<f32>() / 8.0;
        let cells = || (0..half.pow(3)).into_par_iter();
        let bound: Vec<_> = cells().map(largest).collect();
        Some(Self::padded(half, &bound, cells().map(smallest).collect(), cells().map(mean).collect()))
    }

    /// Cells per axis.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.cells
    }

    /// Upper bound of the field in a cell.
    #[must_use]
    pub fn bound(&self, cell: [usize; 3]) -> [f32; C] {
        self.padded[self.number(cell)]
    }

    /// Lower bound of the field in a cell: the minimum of all samples that look-ups there may read.
    #[must_use]
    #[inline]
    pub fn least(&self, [x, y, z]: [usize; 3]) -> [f32; C] {
        self.least[x + self.cells * (y + self.cells * z)]
    }

    /// Mean of the field over a cell, maximum over the channels.
    #[must_use]
    pub fn mean(&self, [x, y, z]: [usize; 3]) -> f32 {
        self.mean[x + self.cells * (y + self.cells * z)]
    }

    /// Cell that contains a point of the unit cube.
    #[must_use]
    #[inline]
    pub fn cell_at(&self, unit: Vec3) -> [usize; 3] {
        // Casts of negative numbers saturate at zero.
        (unit * self.cells as f32).to_array().map(|x| (x as usize).min(self.cells - 1))
    }

    /// Mean over all cells of the bound, maximum over the channels.
    #[must_use]
    pub fn mean_bound(&self) -> f32 {
        let largest = |bound: &[f32; C]| f64::from(bound.iter().fold(0.0f32, |a, b| a.max(*b)));
        (self.padded.iter().map(largest).sum::<f64>() / self.cells.pow(3) as f64) as f32
    }

    /// Index of a cell in the padded array.
    #[inline]
    pub(super) fn number(&self, [x, y, z]: [usize; 3]) -> usize {
        let [_, row, layer] = self.strides();
        (x + 1) + row * (y + 1) + layer * (z + 1)
    }

    /// Index differences between neighbours along each axis.
    #[inline]
    pub(super) fn strides(&self) -> [usize; 3] {
        let row = self.cells + 2;
        [1, row, row * row]
    }

    /// Bound of the cell with this index in the padded array; zero beyond the last.
    #[inline]
    pub(super) fn bound_by_number(&self, number: usize) -> [f32; C] {
        self.padded.get(number).copied().unwrap_or([0.0; C])
    }

    /// Cells that a ray crosses up to `t_end`.
    #[must_use]
    #[inline]
    pub fn walk(&self, ray: &BoxRay) -> CellWalk<'_, C> {
        CellWalk::new(self, ray)
    }
}

/// Extent of a cell along one axis, in samples.
struct Span {
    /// Ends of the cell, extended by [`REACH`] and clamped to the lattice.
    from: f32,
    to: f32,
    /// First and last sample needed to interpolate in the cell.
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

    /// Maximum of the piecewise linear function through `values` (samples `first..=last`).
    fn largest(&self, values: impl Fn(usize) -> f32) -> f32 {
        let at = |x: f32| {
            let i = (x as usize).min(self.last);
            let (a, b) = (values(i), values((i + 1).min(self.last)));
            a + (b - a) * (x - i as f32)
        };
        let inside = (self.from.ceil() as usize)..=(self.to.floor() as usize);
        inside.map(&values).fold(at(self.from).max(at(self.to)), f32::max)
    }

    fn samples(&self) -> usize {
        self.last - self.first + 1
    }

    /// Combines the summaries of all samples along this axis into those of this span; `None` where all are
    /// zero.
    fn summary<const C: usize>(&self, all: &[Option<Summary<C>>], cells: usize) -> Option<Summary<C>> {
        let part = &all[self.first..=self.last];
        part.iter().any(Option::is_some).then(|| {
            let mut summary = Summary::empty(cells);
            let inside = (self.from.ceil() as usize)..=(self.to.floor() as usize);
            for samples in all[inside].iter().flatten() {
                summary.raise(|i| samples.largest[i]);
            }
            for end in [self.from, self.to] {
                let i = (end as usize).min(self.last);
                let s = end - i as f32;
                match (&all[i], &all[(i + 1).min(self.last)]) {
                    (None, None) => {}
                    (Some(a), None) => summary.raise(|i| a.largest[i].map(|a| a - a * s)),
                    (None, Some(b)) => summary.raise(|i| b.largest[i].map(|b| b * s)),
                    (Some(a), Some(b)) => summary.raise(|i| {
                        let (a, b) = (a.largest[i], b.largest[i]);
                        std::array::from_fn(|c| a[c] + (b[c] - a[c]) * s)
                    }),
                }
            }
            for samples in part.iter().flatten() {
                for (sum, more) in summary.sum.iter_mut().zip(&samples.sum) {
                    *sum = std::array::from_fn(|c| sum[c] + more[c]);
                }
            }
            if part.iter().all(Option::is_some) {
                summary.smallest.fill([f32::INFINITY; C]);
                for samples in part.iter().flatten() {
                    for (least, more) in summary.smallest.iter_mut().zip(&samples.smallest) {
                        *least = std::array::from_fn(|c| least[c].min(more[c]));
                    }
                }
            }
            summary
        })
    }
}

/// Maximum, minimum and sum of the samples of each of several cells.
struct Summary<const C: usize> {
    largest: Vec<[f32; C]>,
    smallest: Vec<[f32; C]>,
    sum: Vec<[f32; C]>,
}

impl<const C: usize> Summary<C> {
    fn empty(cells: usize) -> Self {
        let zeros = vec![[0.0; C]; cells];
        Self { largest: zeros.clone(), smallest: zeros.clone(), sum: zeros }
    }

    /// Summary of the cells along a row of samples.
    fn of_row(row: &[[f32; C]], spans: &[Span]) -> Self {
        let largest = |span: &Span| std::array::from_fn(|c| span.largest(|i| row[i][c]));
        let sum = |span: &Span| {
            let samples = row[span.first..=span.last].iter();
            samples.fold([0.0; C], |sum, v| std::array::from_fn(|c| sum[c] + v[c]))
        };
        let smallest = |span: &Span| {
            let samples = row[span.first..=span.last].iter();
            samples.fold([f32::INFINITY; C], |min, v| std::array::from_fn(|c| min[c].min(v[c])))
        };
        Self {
            largest: spans.iter().map(largest).collect(),
            smallest: spans.iter().map(smallest).collect(),
            sum: spans.iter().map(sum).collect(),
        }
    }

    /// Raises every maximum to at least another value.
    #[inline(always)]
    fn raise(&mut self, to: impl Fn(usize) -> [f32; C]) {
        for (i, largest) in self.largest.iter_mut().enumerate() {
            let to = to(i);
            *largest = std::array::from_fn(|c| largest[c].max(to[c]));
        }
    }

    /// Concatenates summaries; missing ones are zero.
    fn joined(parts: &[Option<Self>], cells_of_each: usize) -> Self {
        let mut all = Self::empty(parts.len() * cells_of_each);
        for (i, part) in parts.iter().enumerate() {
            if let Some(part) = part {
                let to = i * cells_of_each..(i + 1) * cells_of_each;
                all.largest[to.clone()].copy_from_slice(&part.largest);
                all.smallest[to.clone()].copy_from_slice(&part.smallest);
                all.sum[to].copy_from_slice(&part.sum);
            }
        }
        all
    }
}
