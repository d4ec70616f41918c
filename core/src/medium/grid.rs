//! Samples on a lattice over the unit cube, trilinear between.

use glam::Vec3;

/// Where along an axis of the unit cube the `n` samples stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lattice {
    /// Sample `i` at (i + ½)/n: `.npy` and `.vol`. Beyond the outermost samples the value is held.
    CellCentred,
    /// Sample `i` at i/(n − 1): OpenVDB, whose values stand at integer indices.
    VertexCentred,
}

/// `C` values per sample, x fastest, then y, then z.
#[derive(Clone, Debug)]
pub struct Grid<const C: usize> {
    size: [usize; 3],
    values: Vec<[f32; C]>,
    /// Index = scale · unit + offset.
    scale: Vec3,
    offset: Vec3,
    last: Vec3,
    max: [f32; C],
    mean: [f32; C],
}

impl<const C: usize> Grid<C> {
    /// A grid of `size` samples per axis; `None` if the number of values does not fit or is zero.
    #[must_use]
    pub fn new(size: [usize; 3], values: Vec<[f32; C]>, lattice: Lattice) -> Option<Self> {
        let count = size[0].checked_mul(size[1])?.checked_mul(size[2])?;
        if count == 0 || count != values.len() {
            return None;
        }
        let n = Vec3::from(size.map(|n| n as f32));
        let last = n - Vec3::ONE;
        let (scale, offset) = match lattice {
            Lattice::CellCentred => (n, Vec3::splat(-0.5)),
            Lattice::VertexCentred => (last, Vec3::ZERO),
        };
        let mut max = [f32::NEG_INFINITY; C];
        let mut sum = [0.0f64; C];
        for value in &values {
            for c in 0..C {
                max[c] = max[c].max(value[c]);
                sum[c] += f64::from(value[c]);
            }
        }
        let mean = sum.map(|s| (s / count as f64) as f32);
        Some(Self { size, values, scale, offset, last, max, mean })
    }

    /// The value at a point of the unit cube.
    #[must_use]
    #[inline]
    pub fn at(&self, unit: Vec3) -> [f32; C] {
        let index = (unit * self.scale + self.offset).clamp(Vec3::ZERO, self.last);
        let [nx, ny, nz] = self.size;
        let (x, y, z) = (index.x as usize, index.y as usize, index.z as usize);
        let f = index - Vec3::new(x as f32, y as f32, z as f32);
        // The upper neighbour of the last sample is itself, with weight 0.
        let (dx, dy, dz) =
            (usize::from(x + 1 < nx), if y + 1 < ny { nx } else { 0 }, if z + 1 < nz { nx * ny } else { 0 });
        let base = x + nx * (y + ny * z);
        std::array::from_fn(|c| {
            let v = |i: usize| self.values[i][c];
            let along_x = |i: usize| v(i) + (v(i + dx) - v(i)) * f.x;
            let along_y = |i: usize| {
                let a = along_x(i);
                a + (along_x(i + dy) - a) * f.y
            };
            let a = along_y(base);
            a + (along_y(base + dz) - a) * f.z
        })
    }

    /// Where a point of the unit cube lies, in samples; beyond the outermost ones for some lattices.
    #[must_use]
    pub fn index_from_unit(&self, unit: Vec3) -> Vec3 {
        unit * self.scale + self.offset
    }

    /// One sample.
    #[must_use]
    #[inline]
    pub fn sample(&self, [x, y, z]: [usize; 3]) -> [f32; C] {
        self.values[x + self.size[0] * (y + self.size[1] * z)]
    }

    /// The largest value per channel; it bounds the interpolated field.
    #[must_use]
    pub fn max(&self) -> [f32; C] {
        self.max
    }

    /// The mean value per channel.
    #[must_use]
    pub fn mean(&self) -> [f32; C] {
        self.mean
    }

    /// Samples per axis, x, y, z.
    #[must_use]
    pub fn size(&self) -> [usize; 3] {
        self.size
    }

    /// Bytes that the values take.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.values.len() * size_of::<[f32; C]>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp(lattice: Lattice) -> Grid<1> {
        let values = (0..2 * 3 * 4).map(|i| [i as f32]).collect();
        Grid::new([2, 3, 4], values, lattice).expect("the sizes agree")
    }

    #[test]
    fn samples_stand_where_the_lattice_says() {
        let cell = ramp(Lattice::CellCentred);
        let vertex = ramp(Lattice::VertexCentred);
        let mut i = 0.0;
        for z in 0..4u8 {
            for y in 0..3u8 {
                for x in 0..2u8 {
                    let p = Vec3::new(x.into(), y.into(), z.into());
                    let n = Vec3::new(2.0, 3.0, 4.0);
                    assert!((cell.at((p + 0.5) / n)[0] - i).abs() < 1e-4);
                    assert!((vertex.at(p / (n - 1.0))[0] - i).abs() < 1e-4);
                    i += 1.0;
                }
            }
        }
    }

    #[test]
    fn values_are_linear_between_and_held_at_the_border() {
        let cell = ramp(Lattice::CellCentred);
        assert!((cell.at(Vec3::new(0.5, 0.5, 0.5))[0] - 11.5).abs() < 1e-5);
        assert_eq!(cell.at(Vec3::ZERO)[0], 0.0);
        assert_eq!(cell.at(Vec3::ONE)[0], 23.0);
        assert_eq!(cell.max(), [23.0]);
    }

    #[test]
    fn sizes_that_do_not_fit_are_refused() {
        assert!(Grid::<1>::new([2, 2, 2], vec![[0.0]; 7], Lattice::CellCentred).is_none());
        assert!(Grid::<1>::new([0, 2, 2], vec![], Lattice::CellCentred).is_none());
        assert!(Grid::<1>::new([usize::MAX, 2, 2], vec![], Lattice::CellCentred).is_none());
    }
}
