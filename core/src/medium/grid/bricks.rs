//! Samples in bricks, before they are stored: the common form of plain arrays and of a file's own blocks.

use rayon::prelude::*;

/// Edge length of a brick in samples.
pub const BRICK_EDGE: usize = 8;
pub(super) const BRICK: usize = BRICK_EDGE * BRICK_EDGE * BRICK_EDGE;

/// A box of samples in bricks of 8³. Places without a brick refer to brick 0, which is zero; a brick may be
/// referenced from several places.
#[derive(Clone, Debug)]
pub struct Bricks<const C: usize> {
    /// Size of the box in samples.
    pub(super) size: [usize; 3],
    /// Offset of the box within its first brick, added to the coordinates of a sample.
    pub(super) phase: [usize; 3],
    /// Bricks per axis.
    pub(super) counts: [usize; 3],
    /// Index of the brick at every place, x fastest.
    pub(super) index: Vec<u32>,
    /// Values of all bricks, one after the other, x fastest.
    pub(super) values: Vec<[f32; C]>,
}

impl<const C: usize> Bricks<C> {
    /// Creates a box of zeros that begins at `phase` within its first brick; `None` if it has no samples, or
    /// their number overflows.
    #[must_use]
    pub fn zero(size: [usize; 3], phase: [usize; 3]) -> Option<Self> {
        let phase = phase.map(|p| p % BRICK_EDGE);
        size[0].checked_mul(size[1])?.checked_mul(size[2]).filter(|n| *n > 0)?;
        let counts: [usize; 3] = std::array::from_fn(|a| (size[a] + phase[a]).div_ceil(BRICK_EDGE));
        let index = vec![0; counts.iter().product()];
        Some(Self { size, phase, counts, index, values: vec![[0.0; C]; BRICK] })
    }

    /// Creates bricks from an array of samples, x fastest, then y, then z; `None` if their number does not
    /// match or is zero.
    #[must_use]
    pub fn of_array(size: [usize; 3], samples: &[[f32; C]], phase: [usize; 3]) -> Option<Self> {
        if size[0].checked_mul(size[1])?.checked_mul(size[2])? != samples.len() {
            return None;
        }
        let mut bricks = Self::zero(size, phase)?;
        let (counts, phase) = (bricks.counts, bricks.phase);
        // Range of samples that a brick covers along an axis.
        let span = |brick: usize, axis: usize| {
            let at = [brick % counts[0], brick / counts[0] % counts[1], brick / counts[0] / counts[1]][axis];
            let first = (at * BRICK_EDGE).max(phase[axis]) - phase[axis];
            (first, ((at + 1) * BRICK_EDGE - phase[axis]).min(size[axis]))
        };
        let row = |y: usize, z: usize| size[0] * (y + size[1] * z);
        let is_zero = |brick: usize| {
            let ((x0, x1), (y0, y1), (z0, z1)) = (span(brick, 0), span(brick, 1), span(brick, 2));
            let is_zero = |row: &[[f32; C]]| row.iter().all(|v| *v == [0.0; C]);
            (z0..z1).all(|z| (y0..y1).all(|y| is_zero(&samples[row(y, z) + x0..row(y, z) + x1])))
        };
        let empty: Vec<bool> = (0..bricks.index.len()).into_par_iter().map(is_zero).collect();
        let kept: Vec<usize> = (0..empty.len()).filter(|brick| !empty[*brick]).collect();
        for (number, place) in (1..).zip(&kept) {
            bricks.index[*place] = number;
        }
        bricks.values.resize((kept.len() + 1) * BRICK, [0.0; C]);
        bricks.values[BRICK..].par_chunks_exact_mut(BRICK).zip(&kept).for_each(|(to, brick)| {
            let ((x0, x1), (y0, y1), (z0, z1)) = (span(*brick, 0), span(*brick, 1), span(*brick, 2));
            for z in z0..z1 {
                for y in y0..y1 {
                    let place = local([x0 + phase[0], y + phase[1], z + phase[2]]);
                    to[place..place + x1 - x0].copy_from_slice(&samples[row(y, z) + x0..row(y, z) + x1]);
                }
            }
        });
        Some(bricks)
    }

    /// Bricks per axis.
    #[must_use]
    pub fn counts(&self) -> [usize; 3] {
        self.counts
    }

    /// Appends bricks of 512 samples each, x fastest, and places them at `places`, in bricks from the corner.
    pub fn put_all(&mut self, places: &[[usize; 3]], samples: &[f32]) {
        let next = self.values.len() / BRICK;
        let samples = samples[..(places.len() * BRICK * C).min(samples.len())].par_chunks_exact(C);
        self.values.par_extend(samples.map(|sample| std::array::from_fn::<f32, C, _>(|c| sample[c])));
        for (number, at) in (next..self.values.len() / BRICK).zip(places) {
            self.put(*at, number as u32);
        }
    }

    /// Appends a brick of one value and returns its number for [`Self::put`].
    pub fn add_constant(&mut self, value: [f32; C]) -> u32 {
        if value == [0.0; C] {
            return 0;
        }
        self.values.resize(self.values.len() + BRICK, value);
        (self.values.len() / BRICK - 1) as u32
    }

    /// Places a brick; ignored outside the box.
    pub fn put(&mut self, [x, y, z]: [usize; 3], number: u32) {
        let [nx, ny, nz] = self.counts;
        if x < nx && y < ny && z < nz {
            self.index[x + nx * (y + ny * z)] = number;
        }
    }

    /// Number of places that refer to each brick.
    pub(super) fn uses(&self) -> Vec<u64> {
        let mut uses = vec![0; self.values.len() / BRICK];
        for brick in &self.index {
            uses[*brick as usize] += 1;
        }
        uses
    }
}

/// Offset of a sample within its brick.
#[inline]
pub(super) fn local([x, y, z]: [usize; 3]) -> usize {
    let inside = |i: usize| i % BRICK_EDGE;
    inside(x) + BRICK_EDGE * (inside(y) + BRICK_EDGE * inside(z))
}
