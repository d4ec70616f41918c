//! Samples in memory: bricks of 8³, with all empty bricks shared.
//!
//! ```text
//!   brick = index[x/8, y/8, z/8]   value = values[512 · brick + x%8 + 8 (y%8) + 64 (z%8)]
//! ```
//!
//! Brick 0 is zero, so that look-ups need no special case. Bricks have no halo: two thirds of all cells lie
//! within one brick, and the memory is that of the voxels. Bricks are aligned with a file's own blocks of 8³.

use super::Precision;
use super::bricks::{BRICK, BRICK_EDGE, Bricks, local};
use super::pages::Pages;
use half::f16;
use half::slice::HalfFloatSliceExt;
use rayon::prelude::*;

/// Samples over a box, at some precision.
#[derive(Clone, Debug)]
pub(super) struct Store<const C: usize> {
    /// Bricks per axis.
    bricks: [usize; 3],
    /// Offset of the box within its first brick, added to the coordinates of a sample.
    phase: [usize; 3],
    index: Vec<u32>,
    /// Whether a row of bricks along x has any brick other than brick 0.
    occupied: Vec<bool>,
    values: Values<C>,
}

#[derive(Clone, Debug)]
enum Values<const C: usize> {
    F32(Pages<[f32; C]>),
    F16(Pages<[f16; C]>),
    /// Multiples of a step per channel.
    U8(Pages<[u8; C]>, [f32; C]),
}

/// Positions in the values of the eight samples around a cell.
#[derive(Clone, Copy)]
struct Corners([usize; 8]);

impl<const C: usize> Store<C> {
    /// Stores bricks at some precision.
    pub fn new(bricks: Bricks<C>, precision: Precision) -> Self {
        let Bricks { phase, counts, index, values, .. } = bricks;
        let occupied = index.chunks_exact(counts[0]).map(|row| row.iter().any(|brick| *brick != 0)).collect();
        Self { bricks: counts, phase, index, occupied, values: Values::at(values, precision) }
    }

    /// Value of one sample.
    #[inline]
    pub fn sample(&self, at: [usize; 3]) -> [f32; C] {
        self.value(self.place(at))
    }

    /// Value at a position in the values of all bricks.
    #[inline]
    pub fn value(&self, place: usize) -> [f32; C] {
        match &self.values {
            Values::F32(values) => values[place],
            Values::F16(values) => values[place].map(f16::to_f32),
            Values::U8(values, step) => std::array::from_fn(|c| f32::from(values[place][c]) * step[c]),
        }
    }

    /// Values of samples `at` and `next` along every axis, x fastest.
    #[inline]
    pub fn corners(&self, at: [usize; 3], next: [usize; 3]) -> [[f32; C]; 8] {
        let places = self.corner_places(at, next);
        match &self.values {
            Values::F32(values) => places.0.map(|i| values[i]),
            Values::F16(values) => {
                let mut found = [[0.0; C]; 8];
                for c in 0..C {
                    // Eight at a time: a single instruction on processors that have it.
                    let halves = places.0.map(|i| values[i][c]);
                    let mut singles = [0.0f32; 8];
                    halves.convert_to_f32_slice(&mut singles);
                    for (to, single) in found.iter_mut().zip(singles) {
                        to[c] = single;
                    }
                }
                found
            }
            Values::U8(values, step) => {
                places.0.map(|i| std::array::from_fn(|c| f32::from(values[i][c]) * step[c]))
            }
        }
    }

    #[inline]
    fn corner_places(&self, at: [usize; 3], next: [usize; 3]) -> Corners {
        let [a, b]: [[usize; 3]; 2] = [at, next].map(|p| std::array::from_fn(|i| p[i] + self.phase[i]));
        let within = (0..3).all(|axis| a[axis] / BRICK_EDGE == b[axis] / BRICK_EDGE);
        if within {
            let base = self.place(at);
            let step: [usize; 3] = std::array::from_fn(|i| (b[i] - a[i]) << (3 * i));
            return Corners(std::array::from_fn(|corner| {
                base + (0..3).map(|i| if corner >> i & 1 == 1 { step[i] } else { 0 }).sum::<usize>()
            }));
        }
        Corners(std::array::from_fn(|corner| {
            self.place(std::array::from_fn(|i| if corner >> i & 1 == 1 { next[i] } else { at[i] }))
        }))
    }

    #[inline]
    fn place(&self, at: [usize; 3]) -> usize {
        let [x, y, z] = std::array::from_fn(|i| at[i] + self.phase[i]);
        let [nx, ny, _] = self.bricks;
        let brick = x / BRICK_EDGE + nx * (y / BRICK_EDGE + ny * (z / BRICK_EDGE));
        self.index[brick] as usize * BRICK + local([x, y, z])
    }

    /// Replaces `row` by the samples (0..count, y, z). Returns false, with an empty row, if they are all
    /// background.
    pub fn row(&self, [y, z]: [usize; 2], count: usize, row: &mut Vec<[f32; C]>) -> bool {
        row.clear();
        let [nx, ny, _] = self.bricks;
        let bricks = (y + self.phase[1]) / BRICK_EDGE + ny * ((z + self.phase[2]) / BRICK_EDGE);
        if !self.occupied[bricks] {
            return false;
        }
        let first = nx * bricks;
        let within = local([0, y + self.phase[1], z + self.phase[2]]);
        row.extend((self.phase[0]..self.phase[0] + count).map(|x| {
            let brick = self.index[first + x / BRICK_EDGE] as usize;
            self.value(brick * BRICK + x % BRICK_EDGE + within)
        }));
        true
    }

    /// Memory of values and index in bytes.
    pub fn bytes(&self) -> usize {
        let values = match &self.values {
            Values::F32(values) => size_of_val(&values[..]),
            Values::F16(values) => size_of_val(&values[..]),
            Values::U8(values, _) => size_of_val(&values[..]),
        };
        values + size_of_val(&self.index[..]) + size_of_val(&self.occupied[..])
    }
}

impl<const C: usize> Values<C> {
    fn at(values: Vec<[f32; C]>, precision: Precision) -> Self {
        match precision {
            Precision::F32 => Self::F32(values.into()),
            Precision::F16 => {
                let halves: Vec<_> = values.into_par_iter().map(|v| v.map(f16::from_f32)).collect();
                Self::F16(halves.into())
            }
            Precision::U8 => {
                let largest = values
                    .par_iter()
                    .fold(|| [0.0f32; C], |max, v| std::array::from_fn(|c| max[c].max(v[c])))
                    .reduce(|| [0.0; C], |a, b| std::array::from_fn(|c| a[c].max(b[c])));
                let step = largest.map(|max| if max > 0.0 { max / 255.0 } else { 1.0 });
                let code = |v: [f32; C]| std::array::from_fn(|c| (v[c] / step[c]).round() as u8);
                Self::U8(values.into_par_iter().map(code).collect::<Vec<_>>().into(), step)
            }
        }
    }
}
