//! Maps: one scalar per pixel of a view.

mod range;

pub use range::{Range, Scale};

use super::estimate::Estimate;
use crate::measure::Region;
use rayon::prelude::*;

/// Definition of a map.
#[derive(Clone, Copy, Debug)]
pub struct Map {
    /// Id in file names and on the command line.
    pub id: &'static str,
    /// Display name.
    pub name: &'static str,
    /// Definition of the value in one line. A is the view, R its reference, V a variance of the mean.
    pub formula: &'static str,
    /// Mapping from values to colours.
    pub scale: Scale,
    /// Whether it needs a reference.
    pub needs_reference: bool,
    /// Edge of the blocks of pixels that are averaged before evaluation; 1 for single pixels.
    pub block: usize,
    value: fn(&Pixel) -> f32,
}

/// Statistics of one pixel of a view and of its reference.
#[derive(Default)]
struct Pixel {
    mean: [f32; 3],
    variance: [f32; 3],
    grey_variance: f32,
    samples: f32,
    lookups: f32,
    reference: [f32; 3],
    reference_grey_variance: f32,
}

/// Relative rounding error of single precision in a mean.
const ROUNDING: f32 = 5e-5;

/// ε of relative errors; prevents dark pixels from dominating.
const EPSILON: f32 = 0.01;

impl Pixel {
    fn differences(&self) -> [f32; 3] {
        std::array::from_fn(|c| self.mean[c] - self.reference[c])
    }
}

fn z(p: &Pixel) -> f32 {
    let difference = average(p.differences());
    // Rounding error of single precision, present even without noise.
    let rounding = ROUNDING * average(p.mean).abs().max(average(p.reference).abs());
    let error = (p.grey_variance + p.reference_grey_variance + rounding * rounding).sqrt();
    if difference == 0.0 { 0.0 } else { difference / error }
}

fn average(values: [f32; 3]) -> f32 {
    values.iter().sum::<f32>() / 3.0
}

/// All maps, in display order.
pub static MAPS: &[Map] = &[
    Map {
        id: "error",
        name: "Error ±",
        formula: "mean over channels of A − R: red where the view is too bright, blue where it is too dark",
        scale: Scale::Diverging,
        needs_reference: true,
        block: 1,
        value: |p| average(p.differences()),
    },
    Map {
        id: "absolute",
        name: "Absolute error",
        formula: "mean over channels of |A − R|",
        scale: Scale::Linear,
        needs_reference: true,
        block: 1,
        value: |p| average(p.differences().map(f32::abs)),
    },
    Map {
        id: "relative",
        name: "Relative error",
        formula: "mean over channels of |A − R| / (|R| + 0.01)",
        scale: Scale::Linear,
        needs_reference: true,
        block: 1,
        value: |p| {
            let d = p.differences();
            average(std::array::from_fn(|c| d[c].abs() / (p.reference[c].abs() + EPSILON)))
        },
    },
    Map {
        id: "squared",
        name: "Squared error",
        formula: "mean over channels of (A − R)², by decades",
        scale: Scale::Logarithmic,
        needs_reference: true,
        block: 1,
        value: |p| average(p.differences().map(|d| d * d)),
    },
    Map {
        id: "z",
        name: "z: bias",
        formula: "(A − R) / √(V_A + V_R) in grey: noise has standard deviation 1, a bias has one colour. Another unbiased view can serve as the reference. With few samples, skewed noise tends to blue; blocks are then more reliable, and the verdict accounts for it",
        scale: Scale::Fixed(4.0),
        needs_reference: true,
        block: 1,
        value: z,
    },
    Map {
        id: "z-blocks",
        name: "z of blocks",
        formula: "z of means over blocks of 8 × 8 pixels: the z of a bias is eight times as large",
        scale: Scale::Fixed(4.0),
        needs_reference: true,
        block: 8,
        value: z,
    },
    Map {
        id: "variance",
        name: "Variance",
        formula: "variance of a single sample, mean over channels, by decades: a property of the estimator, independent of the number of samples",
        scale: Scale::Logarithmic,
        needs_reference: false,
        block: 1,
        value: |p| average(p.variance) * p.samples,
    },
    Map {
        id: "standard-error",
        name: "Standard error",
        formula: "√V_A, root mean square over channels, by decades",
        scale: Scale::Logarithmic,
        needs_reference: false,
        block: 1,
        value: |p| average(p.variance).sqrt(),
    },
    Map {
        id: "samples",
        name: "Samples",
        formula: "samples in the mean; non-finite samples are excluded",
        scale: Scale::Linear,
        needs_reference: false,
        block: 1,
        value: |p| p.samples,
    },
    Map {
        id: "lookups",
        name: "Look-ups",
        formula: "evaluations of the medium's coefficients per path",
        scale: Scale::Linear,
        needs_reference: false,
        block: 1,
        value: |p| p.lookups / p.samples,
    },
];

/// Map with the given id.
#[must_use]
pub fn find(id: &str) -> Option<&'static Map> {
    MAPS.iter().find(|m| m.id == id)
}

impl Map {
    /// Whether the map shows differences in units of their noise, for which another noisy image can serve as
    /// the reference. The other maps with a reference show errors.
    #[must_use]
    pub fn is_test(&self) -> bool {
        matches!(self.scale, Scale::Fixed(_))
    }

    /// Values of a view, row by row; NaN where undefined. Empty if the map needs a reference and there is
    /// none of the same size.
    #[must_use]
    pub fn values(&self, view: &Estimate<'_>, reference: Option<&Estimate<'_>>) -> Vec<f32> {
        let size = |e: &Estimate<'_>| (e.picture.width, e.picture.height);
        let reference = reference.filter(|r| size(r) == size(view));
        if self.needs_reference && reference.is_none() {
            return Vec::new();
        }
        if self.block > 1 {
            return self.of_blocks(view, reference);
        }
        (0..view.picture.pixels.len())
            .into_par_iter()
            .with_min_len(4096)
            .map(|i| (self.value)(&pixel(view, reference, i)))
            .collect()
    }

    /// Evaluates the map on the mean of every block and assigns the value to its pixels.
    fn of_blocks(&self, view: &Estimate<'_>, reference: Option<&Estimate<'_>>) -> Vec<f32> {
        let (width, height) = (view.picture.width, view.picture.height);
        let mut values = vec![f32::NAN; width * height];
        for y0 in (0..height).step_by(self.block) {
            for x0 in (0..width).step_by(self.block) {
                let block = Region { x0, y0, x1: x0 + self.block, y1: y0 + self.block };
                let inside: Vec<usize> = block.indices(width, height).collect();
                let value = (self.value)(&mean(inside.iter().map(|i| pixel(view, reference, *i))));
                for i in inside {
                    values[i] = value;
                }
            }
        }
        values
    }
}

/// Mean of independent pixels as one pixel; non-finite pixels are excluded.
fn mean(pixels: impl Iterator<Item = Pixel>) -> Pixel {
    let mut sum = Pixel::default();
    let mut n = 0.0;
    for p in pixels.filter(|p| p.mean.iter().chain(&p.variance).chain(&p.reference).all(|x| x.is_finite())) {
        n += 1.0;
        for c in 0..3 {
            sum.mean[c] += p.mean[c];
            sum.variance[c] += p.variance[c];
            sum.reference[c] += p.reference[c];
        }
        sum.grey_variance += p.grey_variance;
        sum.reference_grey_variance += p.reference_grey_variance;
        sum.samples += p.samples;
        sum.lookups += p.lookups;
    }
    Pixel {
        mean: sum.mean.map(|x| x / n),
        variance: sum.variance.map(|x| x / (n * n)),
        reference: sum.reference.map(|x| x / n),
        grey_variance: sum.grey_variance / (n * n),
        reference_grey_variance: sum.reference_grey_variance / (n * n),
        samples: sum.samples,
        lookups: sum.lookups,
    }
}

fn pixel(view: &Estimate<'_>, reference: Option<&Estimate<'_>>, i: usize) -> Pixel {
    const UNKNOWN: [f32; 3] = [f32::NAN; 3];
    let mean = |e: &Estimate<'_>| e.picture.pixels.get(i).copied().unwrap_or(UNKNOWN);
    let variance = |e: &Estimate<'_>| match e.standard_error {
        Some(errors) => errors.get(i).map_or(UNKNOWN, |e| e.map(|e| e * e)),
        None => [0.0; 3],
    };
    let grey_variance = |e: &Estimate<'_>| {
        let chroma = e.noise.and_then(|n| n.get(i)).map_or(0.0, |n| n.chroma_variance);
        let grey = average(variance(e)) - chroma;
        // `max` would turn NaN, below two samples, into zero noise.
        if grey.is_nan() { grey } else { grey.max(0.0) }
    };
    let noise = view.noise.and_then(|n| n.get(i));
    Pixel {
        mean: mean(view),
        variance: variance(view),
        grey_variance: grey_variance(view),
        samples: noise.map_or(f32::NAN, |n| n.samples as f32),
        lookups: noise.map_or(f32::NAN, |n| n.lookups),
        reference: reference.map_or(UNKNOWN, mean),
        reference_grey_variance: reference.map_or(0.0, grey_variance),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Noise;
    use crate::measure::Picture;

    #[test]
    fn maps_show_what_their_formulas_say() {
        let noise = [Noise {
            chroma_variance: 0.02,
            third_moment: 0.0,
            variance_error: 0.0,
            samples: 4,
            lookups: 12.0,
        }];
        let view = Estimate {
            picture: Picture { width: 1, height: 1, pixels: &[[1.0, 2.0, 4.5]] },
            standard_error: Some(&[[0.3, 0.3, 0.3]]),
            noise: Some(&noise),
        };
        let reference = Estimate {
            picture: Picture { width: 1, height: 1, pixels: &[[2.0, 2.0, 2.0]] },
            standard_error: None,
            noise: None,
        };
        let value = |id: &str| find(id).unwrap().values(&view, Some(&reference))[0];
        let near = |id: &str, expected: f32| {
            assert!((value(id) - expected).abs() < 1e-4, "{id}: {} {expected}", value(id));
        };
        near("error", 0.5);
        near("absolute", 3.5 / 3.0);
        near("relative", 3.5 / 3.0 / 2.01);
        near("squared", 7.25 / 3.0);
        near("variance", 0.36);
        near("standard-error", 0.3);
        near("samples", 4.0);
        near("lookups", 3.0);
        near("z", 0.5 / 0.07f32.sqrt());
        // A single pixel is a block of its own.
        near("z-blocks", 0.5 / 0.07f32.sqrt());
        for map in MAPS {
            assert_eq!(map.values(&view, None).is_empty(), map.needs_reference, "{}", map.id);
        }
    }

    #[test]
    fn a_blocks_mean_is_known_better_than_its_pixels() {
        let size = 10;
        let pixels = vec![[1.1; 3]; size * size];
        let errors = vec![[0.5; 3]; size * size];
        let picture = Picture { width: size, height: size, pixels: &pixels };
        let view = Estimate { picture, standard_error: Some(&errors), noise: None };
        let exact = vec![[1.0; 3]; size * size];
        let reference = Picture { pixels: &exact, ..picture };
        let reference = Estimate { picture: reference, standard_error: None, noise: None };
        let values = find("z-blocks").unwrap().values(&view, Some(&reference));
        // 8 × 8 pixels, and 2 × 2 in the corner.
        assert!((values[0] - 0.2 * 8.0).abs() < 1e-3 && (values[99] - 0.2 * 2.0).abs() < 1e-3, "{values:?}");
    }
}
