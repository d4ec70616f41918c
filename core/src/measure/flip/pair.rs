//! Filtering of two images for FLIP.

use rayon::prelude::*;

use super::super::Picture;
use super::super::picture::is_finite;
use super::colour::{ColourDifference, comparison};
use super::csf;
use super::feature::{self, Features, difference};
use super::filter::{PaddedRow, weighted};
use super::kernel::Kernel;

/// Planes after filtering along x: Y, Cx, Cz twice, and edges, points and blur of Y.
const PLANES: usize = 7;
/// Planes after filtering along y: Y, Cx, Cz twice, edges along x and y, points along x and y.
const FILTERED: usize = 8;

/// Image and reference, with filters and buffers.
pub(super) struct Pair<'a> {
    pixels: [&'a [[f32; 3]]; 2],
    width: usize,
    height: usize,
    colour: [Kernel; 4],
    feature: [Kernel; 3],
    difference: ColourDifference,
    /// Images filtered along x, row by row, and plane by plane within a row.
    rows: [Vec<f32>; 2],
}

impl<'a> Pair<'a> {
    /// Creates a pair from two images of the same size.
    pub(super) fn new(picture: &Picture<'a>, reference: &Picture<'a>) -> Self {
        let (width, height) = (picture.width, picture.height);
        let rows = [(); 2].map(|()| vec![0.0; PLANES * picture.pixels.len()]);
        Self {
            pixels: [picture.pixels, reference.pixels],
            width,
            height,
            colour: csf::kernels(),
            feature: feature::kernels(),
            difference: ColourDifference::new(),
            rows,
        }
    }

    /// Raises every value of a map to at least the LDR-FLIP of the images as `shown` on a display (linear, 0
    /// to 1).
    pub(super) fn raise(&mut self, map: &mut [f32], shown: impl Fn([f32; 3]) -> [f32; 3] + Sync) {
        // Chunks of zero width are invalid.
        if self.width == 0 {
            return;
        }
        let mut rows = std::mem::take(&mut self.rows);
        for (i, rows) in rows.iter_mut().enumerate() {
            rows.par_chunks_mut(PLANES * self.width).enumerate().for_each_init(
                || self.padded(),
                |padded, (y, planes)| self.along_x(i, y, &shown, padded, planes),
            );
        }
        map.par_chunks_mut(self.width).enumerate().for_each_init(
            || [(); 2].map(|()| vec![0.0; FILTERED * self.width]),
            |filtered, (y, map)| {
                for (filtered, rows) in filtered.iter_mut().zip(&rows) {
                    self.along_y(y, rows, filtered);
                }
                for (x, largest) in map.iter_mut().enumerate() {
                    *largest = largest.max(self.error(filtered, x));
                }
            },
        );
        self.rows = rows;
    }

    fn padded(&self) -> [PaddedRow; 4] {
        let margin = self.colour.iter().chain(&self.feature).map(Kernel::radius).max().unwrap_or(0);
        [(); 4].map(|()| PaddedRow::new(self.width, margin))
    }

    /// Converts row `y` of image `i` to YCxCz and filters it along x.
    fn along_x(
        &self,
        i: usize,
        y: usize,
        shown: &impl Fn([f32; 3]) -> [f32; 3],
        padded: &mut [PaddedRow; 4],
        planes: &mut [f32],
    ) {
        let row: Vec<[f32; 3]> = (y * self.width..(y + 1) * self.width)
            .map(|at| {
                let finite = self.pixels.iter().all(|pixels| is_finite(pixels[at]));
                comparison(shown(if finite { self.pixels[i][at] } else { [0.0; 3] }))
            })
            .collect();
        let [lightness, red_green, blue_yellow, grey] = padded;
        lightness.set(|x| row[x][0]);
        red_green.set(|x| row[x][1]);
        blue_yellow.set(|x| row[x][2]);
        grey.set(|x| row[x][0] * (1.0 / 116.0) + 16.0 / 116.0);
        let [k_lightness, k_red_green, k_first, k_second] = &self.colour;
        let [k_blur, k_edge, k_point] = &self.feature;
        let passes = [
            (&*lightness, k_lightness),
            (red_green, k_red_green),
            (blue_yellow, k_first),
            (blue_yellow, k_second),
            (grey, k_edge),
            (grey, k_point),
            (grey, k_blur),
        ];
        for ((source, kernel), plane) in passes.into_iter().zip(planes.chunks_mut(self.width)) {
            source.convolve(kernel, plane);
        }
    }

    /// Filters row `y` along y.
    fn along_y(&self, y: usize, rows: &[f32], filtered: &mut [f32]) {
        let [lightness, red_green, first, second] = &self.colour;
        let [blur, edge, point] = &self.feature;
        let passes = [
            (0, lightness),
            (1, red_green),
            (2, first),
            (3, second),
            (4, blur),
            (6, edge),
            (5, blur),
            (6, point),
        ];
        for ((plane, kernel), out) in passes.into_iter().zip(filtered.chunks_mut(self.width)) {
            weighted(out, kernel, |k| {
                let row = (y + k).saturating_sub(kernel.radius()).min(self.height - 1);
                let start = (row * PLANES + plane) * self.width;
                &rows[start..start + self.width]
            });
        }
    }

    /// ΔE = ΔE_c^(1 − ΔE_f) of a pixel (Andersson et al. 2020, equation 7).
    fn error(&self, filtered: &[Vec<f32>; 2], x: usize) -> f32 {
        let colour_of = |i: usize| {
            let of = |plane: usize| filtered[i][plane * self.width + x];
            [of(0), of(1), of(2) + of(3)]
        };
        let features_of = |i: usize| {
            let of = |plane: usize| filtered[i][plane * self.width + x];
            Features { edge: [of(4), of(5)], point: [of(6), of(7)] }
        };
        let colour = self.difference.of(colour_of(0), colour_of(1));
        let features = difference(features_of(0), features_of(1));
        colour.powf(1.0 - features)
    }
}
