//! Statistical test of whether two images estimate the same expectation, from their noise alone.
//!
//! The region is divided into blocks. The mean of each block is compared per channel, and the mean of the
//! whole region in grey and per channel, by
//!
//! ```text
//!   z = (A − B) / √(Var A + Var B)
//! ```
//!
//! with Student's t and the degrees of freedom that follow from the errors of the variances
//! (Welch–Satterthwaite, ν = 2 V²/Var V). The smallest of n probabilities is corrected by Šidák,
//! p = 1 − (1 − p_min)ⁿ. Where rare bright paths dominate, the observed scatter does not reveal how many were
//! missed. A region with a skewed mean is therefore not tested, and a region is divided only into as many
//! blocks as would each have low skewness if the rare paths were spread evenly, since a block without such a
//! path underestimates its noise.

use super::estimate::{Estimate, RegionNoise};
use crate::check::stats::two_sided_p;
use crate::measure::Region;
use serde::Serialize;
use std::fmt;

/// Probability of a false alarm per comparison. Repeated tests of a live view multiply it by a small factor.
pub const ALPHA: f64 = 1e-5;

/// Largest skewness of a mean for which the t-test is reliable: at 0.1 the far tail is already several times
/// heavier than stated, and single channels are more skewed than their grey.
const LARGEST_SKEWNESS: f64 = 0.02;

/// Relative detectable bias beyond which a region is too noisy for a verdict.
const TOO_NOISY: f64 = 0.25;

/// Relative rounding error of single precision in a mean.
const ROUNDING: f64 = 5e-5;

/// Maximum number of blocks in a row and in a column.
const BLOCKS: usize = 8;
/// Minimum edge of a block in pixels.
const SMALLEST_BLOCK: usize = 8;

/// Result of the comparison of two images.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Every difference is within statistical error.
    Agrees,
    /// At least one difference is significant.
    Differs,
    /// Too noisy for a verdict: a bias of a quarter could be hidden, or rare bright paths dominate.
    Undecided,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Agrees => "agrees",
            Self::Differs => "biased",
            Self::Undecided => "undecided",
        })
    }
}

/// The block with the most significant difference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// Pixels of the block.
    pub region: Region,
    /// Relative difference, (A − B)/B, in the most significant channel.
    pub difference: f64,
    /// Standard error of `difference`.
    pub error: f64,
    /// z of the difference.
    pub z: f64,
}

/// Result of the comparison of A with B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// The verdict.
    pub verdict: Verdict,
    /// Relative difference of the means over the region, (A − B)/B.
    pub difference: f64,
    /// Standard error of `difference`.
    pub error: f64,
    /// z of the means over the region.
    pub z: f64,
    /// Probability that some block differs as much by chance, corrected for the number of blocks.
    pub p: f64,
    /// The block with the most significant difference, if any was tested.
    pub worst: Option<Worst>,
    /// Pixels that are excluded because of a non-finite value.
    pub excluded: u64,
}

/// Compares A with B over a region. Returns `None` if they differ in size or the region contains no pixel.
#[must_use]
pub fn agreement(a: &Estimate<'_>, b: &Estimate<'_>, region: Region) -> Option<Agreement> {
    let (width, height) = (a.picture.width, a.picture.height);
    let region = region.clipped(width, height);
    if (width, height) != (b.picture.width, b.picture.height) || region.is_empty() {
        return None;
    }
    // Both means are over the same pixels: those with finite values in both images.
    let usable = |e: &Estimate<'_>, i: usize| {
        let finite = |values: &[[f32; 3]]| values.get(i).is_some_and(|v| v.iter().all(|x| x.is_finite()));
        finite(e.picture.pixels) && e.standard_error.is_none_or(finite)
    };
    let counts = |i: usize| usable(a, i) && usable(b, i);
    let sums = |region: Region| (RegionNoise::of(a, region, counts), RegionNoise::of(b, region, counts));
    let whole = sums(region);
    let all = ((region.x1 - region.x0) * (region.y1 - region.y0)) as u64;
    let excluded = all - whole.0.pixels;

    let mut tests = comparisons(&whole, region, true);
    let blocks: Vec<Comparison> = divide(region, most_blocks(&whole))
        .flat_map(|block| comparisons(&sums(block), block, false))
        .collect();
    tests.extend(blocks);
    let in_total =
        Comparison::new(whole.0.grey(), whole.1.grey(), whole.0.grey_variance + whole.1.grey_variance);
    let detectable = 6.0 * in_total.error / whole.1.grey().abs();
    let judged = !tests.is_empty() && known(&whole.0) && known(&whole.1);
    let worst = tests.iter().min_by(|x, y| x.p.total_cmp(&y.p));
    let p = worst.map_or(f64::NAN, |w| -(tests.len() as f64 * (-w.p).ln_1p()).exp_m1());
    let verdict = match judged {
        false => Verdict::Undecided,
        true if p < ALPHA => Verdict::Differs,
        // Agreement requires enough power to have detected a difference; a difference does not.
        true if detectable > TOO_NOISY => Verdict::Undecided,
        true => Verdict::Agrees,
    };
    Some(Agreement {
        verdict,
        difference: in_total.difference / whole.1.grey(),
        error: in_total.error / whole.1.grey().abs(),
        z: in_total.z(),
        p,
        worst: worst.map(|w| Worst {
            region: w.region,
            difference: w.difference / w.expected,
            error: w.error / w.expected.abs(),
            z: w.z(),
        }),
        excluded,
    })
}

/// Number of blocks into which the noise of a region can be divided: the skewness of a mean increases with
/// the square root of this number.
fn most_blocks((a, b): &(RegionNoise, RegionNoise)) -> f64 {
    let skewness = a.skewness().abs().max(b.skewness().abs());
    (LARGEST_SKEWNESS / skewness).powi(2)
}

/// Divides a region into at most `most` blocks of about equal size; empty if one block would result.
fn divide(region: Region, most: f64) -> impl Iterator<Item = Region> {
    let (width, height) = (region.x1 - region.x0, region.y1 - region.y0);
    let most = (most.sqrt() as usize).clamp(1, BLOCKS);
    let count = |side: usize| (side / SMALLEST_BLOCK).clamp(1, most);
    let (columns, rows) = (count(width), count(height));
    (0..if columns * rows > 1 { columns * rows } else { 0 }).map(move |i| {
        let (column, row) = (i % columns, i / columns);
        Region {
            x0: region.x0 + column * width / columns,
            x1: region.x0 + (column + 1) * width / columns,
            y0: region.y0 + row * height / rows,
            y1: region.y0 + (row + 1) * height / rows,
        }
    })
}

/// Whether the noise of a mean is known: contributions were observed, and their distribution has no long
/// tail.
fn known(noise: &RegionNoise) -> bool {
    let seen = noise.average_variance() > 0.0 || noise.grey() != 0.0;
    seen && noise.skewness().abs() <= LARGEST_SKEWNESS
}

/// A difference of two means.
#[derive(Clone, Copy, Debug)]
struct Comparison {
    region: Region,
    difference: f64,
    expected: f64,
    error: f64,
    p: f64,
}

impl Comparison {
    fn new(a: f64, b: f64, variance: f64) -> Self {
        let rounding = ROUNDING * a.abs().max(b.abs());
        let error = (variance + rounding * rounding).sqrt();
        Self { region: Region::whole(0, 0), difference: a - b, expected: b, error, p: f64::NAN }
    }

    fn z(&self) -> f64 {
        if self.difference == 0.0 { 0.0 } else { self.difference / self.error.max(f64::MIN_POSITIVE) }
    }

    fn judged(mut self, region: Region, dof: f64) -> Self {
        (self.region, self.p) = (region, two_sided_p(self.z(), dof));
        self
    }
}

/// Comparisons of a block, or of the whole region; empty if the noise is not known.
fn comparisons((a, b): &(RegionNoise, RegionNoise), region: Region, grey: bool) -> Vec<Comparison> {
    if !known(a) || !known(b) {
        return Vec::new();
    }
    let variance = a.average_variance() + b.average_variance();
    let spread = a.variance_of_variance + b.variance_of_variance;
    // Beyond a million degrees of freedom Student's t is indistinguishable from a normal distribution.
    let dof = if spread > 0.0 { (2.0 * variance * variance / spread).clamp(1.0, 1e6) } else { 1e6 };
    let mut all: Vec<_> = (0..3)
        .map(|c| Comparison::new(a.mean[c], b.mean[c], a.variance[c] + b.variance[c]).judged(region, dof))
        .collect();
    if grey {
        let mean = Comparison::new(a.grey(), b.grey(), a.grey_variance + b.grey_variance);
        all.push(mean.judged(region, dof));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Film, Images};
    use crate::math::Sampler;
    use crate::measure::Picture;

    /// Images of exponential noise of mean 1, by seed, with `edit` applied to every sample.
    fn picture(seed: u64, size: usize, spp: u64, edit: impl Fn(usize, f32) -> f32) -> Images {
        let mut film = Film::new(size, size);
        for (i, pixel) in film.pixels.iter_mut().enumerate() {
            for s in 0..spp {
                let mut sampler = Sampler::new(seed, i as u64, s);
                pixel.add(std::array::from_fn(|_| edit(i, sampler.next_optical_depth())));
            }
        }
        Images::of(&film)
    }

    fn estimate(images: &Images, size: usize) -> Estimate<'_> {
        Estimate {
            picture: Picture { width: size, height: size, pixels: &images.mean },
            standard_error: Some(&images.standard_error),
            noise: Some(&images.noise),
        }
    }

    fn compare(a: &Images, b: &Images, size: usize) -> Agreement {
        agreement(&estimate(a, size), &estimate(b, size), Region::whole(size, size)).unwrap()
    }

    #[test]
    fn equals_are_not_flagged_and_their_p_is_uniform() {
        let size = 32;
        let p: Vec<f64> = (0..40)
            .map(|i| {
                compare(&picture(2 * i, size, 16, |_, x| x), &picture(2 * i + 1, size, 16, |_, x| x), size)
            })
            .map(|found| {
                assert_eq!(found.verdict, Verdict::Agrees, "{found:?}");
                found.p
            })
            .collect();
        // Šidák's p over 40 seeds: its mean is 1/2 ± 0.046, and the blocks of an image are slightly
        // dependent.
        let mean = p.iter().sum::<f64>() / p.len() as f64;
        assert!((0.3..0.7).contains(&mean), "{p:?}");
    }

    #[test]
    fn a_bias_is_found_with_its_size() {
        let size = 64;
        let brighter = picture(2, size, 64, |_, x| 1.02 * x);
        let found = compare(&brighter, &picture(1, size, 64, |_, x| x), size);
        assert_eq!(found.verdict, Verdict::Differs);
        assert!((found.difference - 0.02).abs() < 4.0 * found.error, "{found:?}");
        // A bias in one block that is compensated by the others.
        let place = |i: usize| (i % size < 8) && (i / size < 8);
        let moved = picture(3, size, 64, |i, x| if place(i) { 1.3 * x } else { 0.995_238 * x });
        let found = compare(&moved, &picture(1, size, 64, |_, x| x), size);
        assert_eq!(found.verdict, Verdict::Differs);
        assert_eq!(found.worst.unwrap().region, Region { x0: 0, y0: 0, x1: 8, y1: 8 });
        assert!(found.z.abs() < 4.0, "{found:?}");
    }

    /// Half of the light comes from rare paths; blocks without any of them underestimate noise and radiance.
    #[test]
    fn missed_rare_paths_are_not_taken_for_a_bias() {
        let size = 32;
        let rare = |share: f32| {
            move |_: usize, x: f32| if x > -share.ln() { 0.5 / share } else { 0.5 / (1.0 - share) }
        };
        for seed in 0..20 {
            let other = picture(1000 + seed, size, 64, |_, x| x);
            // 3 in a block of 8 × 8 pixels with 16 samples, so that many blocks have none.
            let found = compare(&picture(seed, size, 16, rare(3.0 / 1024.0)), &other, size);
            assert_ne!(found.verdict, Verdict::Differs, "{found:?}");
            // A hundred in each of the few blocks that are tested.
            let found = compare(&picture(seed, size, 16, rare(0.1)), &other, size);
            assert_eq!(found.verdict, Verdict::Agrees, "{found:?}");
        }
    }

    #[test]
    fn rare_fireflies_leave_it_undecided() {
        let size = 16;
        let rare = |_: usize, x: f32| if x > 8.0 { 3000.0 * x } else { 0.0 };
        let found = compare(&picture(5, size, 8, rare), &picture(6, size, 8, |_, x| x), size);
        assert_eq!(found.verdict, Verdict::Undecided, "{found:?}");
        let black = picture(5, size, 8, |_, _| 0.0);
        assert_eq!(compare(&black, &picture(6, size, 8, |_, x| x), size).verdict, Verdict::Undecided);
        // Two black images.
        assert_eq!(compare(&black, &black, size).verdict, Verdict::Undecided);
    }
}
