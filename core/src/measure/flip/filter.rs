//! Separable filters along rows and columns; border pixels are repeated beyond the border.

use super::kernel::Kernel;

/// Number of pixels that are summed at once, in registers.
const BLOCK: usize = 32;

/// A row of pixels, with the end pixels repeated beyond both ends.
pub(super) struct PaddedRow {
    values: Vec<f32>,
    margin: usize,
    width: usize,
}

impl PaddedRow {
    /// Creates a row of `width` pixels, for kernels up to a radius of `margin`.
    pub(super) fn new(width: usize, margin: usize) -> Self {
        Self { values: vec![0.0; width + 2 * margin], margin, width }
    }

    /// Sets the pixels, of which there is at least one.
    pub(super) fn set(&mut self, pixel: impl Fn(usize) -> f32) {
        let Self { values, margin, width } = self;
        let last = *margin + *width - 1;
        for (x, v) in values[*margin..=last].iter_mut().enumerate() {
            *v = pixel(x);
        }
        let (first, end) = (values[*margin], values[last]);
        values[..*margin].fill(first);
        values[last + 1..].fill(end);
    }

    /// out(x) = Σ_k w_k · row(x + k).
    pub(super) fn convolve(&self, kernel: &Kernel, out: &mut [f32]) {
        let from = self.margin - kernel.radius();
        weighted(out, kernel, |k| &self.values[from + k..]);
    }
}

/// out(x) = Σ_k w_k · row_k(x), where `row` returns the row for each tap.
pub(super) fn weighted<'a>(out: &mut [f32], kernel: &Kernel, row: impl Fn(usize) -> &'a [f32]) {
    let width = out.len();
    let taps: Vec<(f32, &[f32])> =
        kernel.weights.iter().enumerate().map(|(k, w)| (*w, &row(k)[..width])).collect();
    let (blocks, rest) = out.as_chunks_mut::<BLOCK>();
    let done = blocks.len() * BLOCK;
    for (b, block) in blocks.iter_mut().enumerate() {
        let mut sums = [0.0; BLOCK];
        for (w, source) in &taps {
            // A length known at compile time keeps the sums in registers.
            let Some(source) = source[b * BLOCK..].first_chunk::<BLOCK>() else { continue };
            for i in 0..BLOCK {
                sums[i] += w * source[i];
            }
        }
        *block = sums;
    }
    for (x, out) in rest.iter_mut().enumerate() {
        *out = taps.iter().map(|(w, source)| w * source[done + x]).sum();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_convolved_as_by_definition() {
        let kernel = Kernel { weights: vec![0.1, -0.3, 0.5, 0.7, 0.2] };
        for width in [1usize, 2, 31, 32, 33, 80] {
            let pixel = |x: usize| (x * x % 7) as f32;
            let mut row = PaddedRow::new(width, 4);
            row.set(pixel);
            let mut out = vec![0.0; width];
            row.convolve(&kernel, &mut out);
            for (x, found) in out.iter().enumerate() {
                let at = |k: usize| pixel((x + k).saturating_sub(2).min(width - 1));
                let expected: f32 = kernel.weights.iter().enumerate().map(|(k, w)| w * at(k)).sum();
                assert!((found - expected).abs() < 1e-5, "{x} of {width}: {found}, {expected}");
            }
        }
    }
}
