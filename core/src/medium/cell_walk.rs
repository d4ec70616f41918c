//! The walk through majorant cells: a 3D digital differential analyser (Amanatides and Woo 1987).

use super::MajorantGrid;
use crate::math::Ray;
use glam::Vec3;

/// A stretch of a ray inside one cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellSegment<const C: usize> {
    /// Ray parameter at which it begins.
    pub t0: f32,
    /// Ray parameter at which it ends.
    pub t1: f32,
    /// Bound of the field in the cell.
    pub bound: [f32; C],
}

/// The cells along a ray whose bound is not zero, in order; empty ones are passed over.
#[derive(Clone, Debug)]
pub struct CellWalk<'a, const C: usize> {
    grid: &'a MajorantGrid<C>,
    cell: usize,
    t: f32,
    t_end: f32,
    /// Ray parameter of the next face along each axis; infinite once there is none.
    next: [f32; 3],
    /// Parameter between faces along each axis.
    step: [f32; 3],
    /// What crossing a face adds to the cell's number; its sign wraps.
    stride: [usize; 3],
    /// Faces that are left along each axis.
    left: [u32; 3],
}

impl<'a, const C: usize> CellWalk<'a, C> {
    /// Starts at `t0`, in or on the border of the unit cube.
    #[must_use]
    pub fn new(grid: &'a MajorantGrid<C>, ray: &Ray, t0: f32, t1: f32) -> Self {
        let cells = grid.cells();
        let n = cells as f32;
        let origin = (ray.at(t0) * n).clamp(Vec3::ZERO, Vec3::splat(n));
        let direction = ray.direction * n;
        let mut walk = Self {
            grid,
            cell: 0,
            t: t0,
            t_end: t1,
            next: [f32::INFINITY; 3],
            step: [f32::INFINITY; 3],
            stride: [1, cells, cells * cells],
            left: [0; 3],
        };
        for axis in 0..3 {
            let index = (origin[axis] as usize).min(cells - 1);
            walk.cell += index * walk.stride[axis];
            let d = direction[axis];
            if d == 0.0 {
                continue;
            }
            let inverse = 1.0 / d;
            let (face, left) = if d > 0.0 { (index + 1, cells - 1 - index) } else { (index, index) };
            walk.step[axis] = inverse.abs();
            walk.left[axis] = left as u32;
            if left > 0 {
                // Never behind the start: rounding may put the origin just beyond the face.
                walk.next[axis] = t0 + ((face as f32 - origin[axis]) * inverse).max(0.0);
            }
            if d < 0.0 {
                walk.stride[axis] = walk.stride[axis].wrapping_neg();
            }
        }
        walk
    }
}

impl<const C: usize> Iterator for CellWalk<'_, C> {
    type Item = CellSegment<C>;

    #[inline]
    fn next(&mut self) -> Option<CellSegment<C>> {
        while self.t < self.t_end {
            let [x, y, z] = self.next;
            let axis = if x < y {
                if x < z { 0 } else { 2 }
            } else if y < z {
                1
            } else {
                2
            };
            let segment = CellSegment {
                t0: self.t,
                t1: self.next[axis].min(self.t_end),
                bound: self.grid.bound(self.cell),
            };
            self.t = segment.t1;
            if self.t < self.t_end {
                self.cell = self.cell.wrapping_add(self.stride[axis]);
                self.left[axis] -= 1;
                self.next[axis] =
                    if self.left[axis] == 0 { f32::INFINITY } else { self.next[axis] + self.step[axis] };
            }
            if segment.bound != [0.0; C] && segment.t0 < segment.t1 {
                return Some(segment);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Sampler, UnitBox, uniform_direction};
    use crate::medium::{Grid, Lattice};

    fn noise(size: [usize; 3], lattice: Lattice) -> Grid<1> {
        let mut random = Sampler::new(3, 1, 4);
        let count = size.iter().product();
        // A third of it empty, in runs.
        let values = (0..count).map(|i: usize| [if i / 7 % 3 == 0 { 0.0 } else { random.next_1d() }]);
        Grid::new(size, values.collect(), lattice).expect("the sizes agree")
    }

    #[test]
    fn the_cells_of_a_ray_bound_the_field_and_leave_out_only_what_is_empty() {
        let mut random = Sampler::new(1, 0, 0);
        for (lattice, size, cells) in [
            (Lattice::CellCentred, [9, 17, 5], 4),
            (Lattice::VertexCentred, [9, 17, 5], 4),
            (Lattice::CellCentred, [4, 3, 6], 16),
            (Lattice::VertexCentred, [12, 12, 12], 1),
            (Lattice::CellCentred, [30, 31, 32], 7),
        ] {
            let grid = noise(size, lattice);
            let bounds = MajorantGrid::new(&grid, cells);
            for i in 0..400 {
                let target = Vec3::new(random.next_1d(), random.next_1d(), random.next_1d());
                let mut direction = uniform_direction(random.next_2d()) * 3.0;
                // Along the axes, and in the faces of cells, too.
                if i % 5 == 0 {
                    direction = Vec3::AXES[i % 3] * if i % 2 == 0 { 1.0 } else { -1.0 };
                }
                let ray = Ray { origin: target - direction, direction };
                let Some((t0, t1)) = UnitBox::interval(&ray) else { continue };
                let ray = Ray { origin: ray.at(t0), direction };
                let segments: Vec<_> = bounds.walk(&ray, 0.0, t1 - t0).collect();
                for pair in segments.windows(2) {
                    assert!(pair[0].t1 <= pair[1].t0, "{pair:?}");
                }
                for k in 0..200u8 {
                    let t = (t1 - t0) * (f32::from(k) + 0.5) / 200.0;
                    let [density] = grid.at(ray.at(t));
                    let here = segments.iter().find(|s| (s.t0..s.t1).contains(&t));
                    let bound = here.map_or(0.0, |s| s.bound[0]);
                    assert!(density <= bound, "{density} > {bound} at {t} of {ray:?}");
                }
            }
        }
    }

    #[test]
    fn bounds_are_no_looser_than_the_neighbours_and_tight_where_a_cell_holds_its_maximum() {
        let grid = noise([16, 16, 16], Lattice::CellCentred);
        let one = MajorantGrid::new(&grid, 1);
        assert!((one.bound(0)[0] / grid.max()[0] - 1.0).abs() < 1e-6);
        assert!((one.mean(0) / grid.mean()[0] - 1.0).abs() < 1e-5);
        // Halving gives bounds that hold as well, and never looser ones.
        let mut fine = MajorantGrid::new(&grid, 8);
        while let Some(coarse) = fine.halved() {
            let direct = MajorantGrid::new(&grid, coarse.cells());
            for cell in 0..coarse.cells().pow(3) {
                assert!(coarse.bound(cell)[0] <= direct.bound(cell)[0] * 1.000_001);
            }
            assert!(coarse.mean_bound() >= fine.mean_bound());
            fine = coarse;
        }
        assert_eq!(fine.cells(), 1);
    }
}
