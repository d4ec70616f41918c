//! Traversal of majorant cells: a 3D digital differential analyser (Amanatides and Woo 1987).

use super::MajorantGrid;
use crate::math::BoxRay;
use glam::{UVec3, Vec3A};

/// Segment of a ray inside one cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellSegment<const C: usize> {
    /// Ray parameter at its start.
    pub t0: f32,
    /// Ray parameter at its end.
    pub t1: f32,
    /// Bound of the field in the cell.
    pub bound: [f32; C],
}

/// Iterator over the cells along a ray whose bound is not zero, in order.
///
/// Which face comes next is unpredictable, so the axis is found by arithmetic instead of branches.
#[derive(Clone, Copy, Debug)]
pub struct CellWalk<'a, const C: usize> {
    grid: &'a MajorantGrid<C>,
    /// Index of the cell that is entered at `t`.
    cell: usize,
    t: f32,
    t_end: f32,
    /// Ray parameter of the next face along each axis.
    next: Vec3A,
    /// Ray parameter between faces along each axis.
    step: Vec3A,
    /// Change of the cell index on crossing a face; wraps where it is negative.
    stride: [usize; 3],
}

const UNIT: [Vec3A; 4] = [Vec3A::X, Vec3A::Y, Vec3A::Z, Vec3A::ZERO];

impl<'a, const C: usize> CellWalk<'a, C> {
    /// Creates a walk that starts at the ray's origin, inside the cube.
    #[must_use]
    #[inline]
    pub fn new(grid: &'a MajorantGrid<C>, ray: &BoxRay) -> Self {
        let n = grid.cells() as f32;
        let place = ray.origin * n;
        // The last cell includes the cube's far faces.
        let [i, j, k] = place.clamp(Vec3A::ZERO, Vec3A::splat(n - 0.5)).as_uvec3().to_array();
        let forward = ray.direction.cmpgt(Vec3A::ZERO);
        let step = ray.inverse / n;
        let face = UVec3::new(i, j, k).as_vec3a() + Vec3A::select(forward, Vec3A::ONE, Vec3A::ZERO);
        let [x, y, z] = grid.strides();
        let signed = |stride: usize, forward: bool| if forward { stride } else { stride.wrapping_neg() };
        Self {
            grid,
            cell: grid.number([i as usize, j as usize, k as usize]),
            t: 0.0,
            t_end: ray.t_end,
            // Never behind the start: rounding may put the start just beyond the face.
            next: ((face - place) * step).max(Vec3A::ZERO),
            step: step.abs(),
            stride: [signed(x, forward.test(0)), signed(y, forward.test(1)), signed(z, forward.test(2))],
        }
    }
}

impl<const C: usize> Iterator for CellWalk<'_, C> {
    type Item = CellSegment<C>;

    #[inline(always)]
    fn next(&mut self) -> Option<CellSegment<C>> {
        while self.t < self.t_end {
            let face = self.next.min_element();
            let segment = CellSegment {
                t0: self.t,
                t1: face.min(self.t_end),
                bound: self.grid.bound_by_number(self.cell),
            };
            self.t = face;
            // One face at a time: where a ray hits an edge, a cell of length zero is inserted.
            let axis = self.next.cmple(Vec3A::splat(face)).bitmask().trailing_zeros() as usize % 4;
            self.next += self.step * UNIT[axis];
            self.cell = self.cell.wrapping_add(self.stride[axis.min(2)]);
            if segment.bound != [0.0; C] {
                return Some(segment);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{BoxRay, Ray, Sampler, uniform_direction};
    use crate::medium::{Grid, Interpolation, Lattice};
    use glam::{Affine3A, Vec3};

    fn noise(size: [usize; 3], lattice: Lattice) -> Grid<1> {
        let mut random = Sampler::new(3, 1, 4);
        let count = size.iter().product();
        // A third of the samples are empty, in runs.
        let values =
            (0..count).map(|i: usize| [if (i / 7).is_multiple_of(3) { 0.0 } else { random.next_1d() }]);
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
            let bounds = MajorantGrid::new(&grid, cells, Interpolation::Trilinear);
            let looser = MajorantGrid::new(&grid, cells, Interpolation::Stochastic);
            for i in 0..400 {
                let target = Vec3::new(random.next_1d(), random.next_1d(), random.next_1d());
                let mut direction = uniform_direction(random.next_2d()) * 3.0;
                // Includes rays along the axes and in the faces of cells.
                if i % 5 == 0 {
                    direction = Vec3::AXES[i % 3] * if i % 2 == 0 { 1.0 } else { -1.0 };
                }
                let ray = Ray { origin: target - direction, direction };
                let Some((_, ray)) = BoxRay::enter(&ray, &Affine3A::IDENTITY, f32::INFINITY) else {
                    continue;
                };
                let segments: Vec<_> = bounds.walk(&ray).collect();
                for pair in segments.windows(2) {
                    assert!(pair[0].t1 <= pair[1].t0, "{pair:?}");
                }
                for k in 0..200u8 {
                    let t = ray.t_end * (f32::from(k) + 0.5) / 200.0;
                    let [density] = grid.at(ray.at(t));
                    let here = segments.iter().find(|s| (s.t0..s.t1).contains(&t));
                    let bound = here.map_or(0.0, |s| s.bound[0]);
                    assert!(density <= bound, "{density} > {bound} at {t} of {ray:?}");
                    let [one] = grid.look_up(ray.at(t), Interpolation::Stochastic, 0);
                    let by_sample = looser.walk(&ray).find(|s| (s.t0..s.t1).contains(&t));
                    let [least] = bounds.least(bounds.cell_at(ray.at(t)));
                    assert!(least <= density.min(one), "{least} at {t} of {ray:?}");
                    assert!(one <= by_sample.map_or(0.0, |s| s.bound[0]), "{one} at {t} of {ray:?}");
                }
            }
        }
    }

    #[test]
    fn bounds_are_no_looser_than_the_neighbours_and_tight_where_a_cell_holds_its_maximum() {
        let grid = noise([16, 16, 16], Lattice::CellCentred);
        let one = MajorantGrid::new(&grid, 1, Interpolation::Trilinear);
        assert!((one.bound([0; 3])[0] / grid.max()[0] - 1.0).abs() < 1e-6);
        assert!((one.mean([0; 3]) / grid.mean()[0] - 1.0).abs() < 1e-5);
        // Halving gives valid bounds that are never looser.
        let mut fine = MajorantGrid::new(&grid, 8, Interpolation::Trilinear);
        while let Some(coarse) = fine.halved() {
            let direct = MajorantGrid::new(&grid, coarse.cells(), Interpolation::Trilinear);
            let n = coarse.cells();
            for cell in (0..n.pow(3)).map(|i| [i % n, i / n % n, i / n / n]) {
                assert!(coarse.bound(cell)[0] <= direct.bound(cell)[0] * 1.000_001);
                assert!(coarse.least(cell)[0] >= direct.least(cell)[0] * 0.999_999);
            }
            assert!(coarse.mean_bound() >= fine.mean_bound());
            fine = coarse;
        }
        assert_eq!(fine.cells(), 1);
    }
}
