//! Independent repeats of a render, reduced to means over blocks of pixels.

use super::stats::mean_and_error;
use crate::estimator::{Kernel, PathIndex, Settings};
use crate::film::NonFinite;
use crate::math::SamplerKind;
use crate::scene::Scene;
use crate::transport::CancelToken;
use rayon::prelude::*;

/// Number of independent repeats of every render.
pub const BATCHES: usize = 128;

/// Degrees of freedom of the standard error of a batch mean.
pub const DOF: f64 = (BATCHES - 1) as f64;

/// Division of an image into blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Number of blocks in a row.
    pub columns: u32,
    /// Number of blocks in a column.
    pub rows: u32,
}

impl Layout {
    /// The image as one block.
    pub const WHOLE: Self = Self { columns: 1, rows: 1 };

    /// Total number of blocks.
    #[must_use]
    pub fn blocks(&self) -> usize {
        self.columns as usize * self.rows as usize
    }

    /// Number of comparisons of an image: every block and channel, and the overall mean.
    #[must_use]
    pub fn comparisons(&self) -> usize {
        3 * self.blocks() + 1
    }

    /// Index of the block that contains a pixel of an image of `size`.
    fn block(&self, (x, y): (u32, u32), size: (u32, u32)) -> usize {
        let (column, row) = (x * self.columns / size.0, y * self.rows / size.1);
        row as usize * self.columns as usize + column as usize
    }
}

/// Parameters of a render that is repeated [`BATCHES`] times.
#[derive(Clone, Copy)]
pub struct Plan<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Kernel of the estimator.
    pub kernel: Kernel,
    /// Settings of the estimator, seed included.
    pub settings: &'a Settings,
    /// Blocks of the image.
    pub layout: Layout,
    /// Sample number at which the first batch begins.
    pub first_sample: u64,
    /// Samples per pixel of every batch.
    pub spp: u64,
}

/// Batch means of every block and channel of an image, and of the whole image.
#[derive(Clone, Debug)]
pub struct Batches {
    /// One series of [`BATCHES`] means per block and channel (block by block from the top left, with channels
    /// innermost), followed by the mean over all blocks and channels.
    pub series: Vec<Vec<f64>>,
    /// Samples per pixel of every batch.
    pub spp: u64,
    /// Paths traced.
    pub paths: u64,
    /// Look-ups of the medium.
    pub lookups: u64,
    /// Look-ups at which the extinction exceeded the majorant.
    pub exceeded: u64,
    /// First non-finite sample, if any; such samples are excluded.
    pub non_finite: Option<NonFinite>,
}

impl Batches {
    /// Renders the batches; `None` if cancelled.
    #[must_use]
    pub fn render(plan: &Plan<'_>, cancel: CancelToken<'_>) -> Option<Self> {
        let batches: Option<Vec<Batch>> =
            (0..BATCHES as u64).into_par_iter().map(|b| batch(plan, b, cancel)).collect();
        let batches = batches?;
        let count = plan.layout.comparisons();
        Some(Self {
            series: (0..count).map(|i| batches.iter().map(|b| b.means[i]).collect()).collect(),
            spp: plan.spp,
            paths: batches.iter().map(|b| b.paths).sum(),
            lookups: batches.iter().map(|b| b.lookups).sum(),
            exceeded: batches.iter().map(|b| b.exceeded).sum(),
            non_finite: batches.iter().find_map(|b| b.non_finite),
        })
    }

    /// Merges further samples into the batches.
    #[must_use]
    pub fn merged(mut self, more: &Self) -> Self {
        let share = more.spp as f64 / (self.spp + more.spp) as f64;
        for (mean, further) in self.series.iter_mut().flatten().zip(more.series.iter().flatten()) {
            *mean += (further - *mean) * share;
        }
        self.spp += more.spp;
        self.paths += more.paths;
        self.lookups += more.lookups;
        self.exceeded += more.exceeded;
        self.non_finite = self.non_finite.or(more.non_finite);
        self
    }

    /// Number of paths that contribute to a series.
    #[must_use]
    pub fn paths_of(&self, series: usize) -> u64 {
        let blocks = (self.series.len() / 3).max(1) as u64;
        if series + 1 == self.series.len() { self.paths } else { self.paths / blocks }
    }

    /// Mean over all blocks and channels, with its standard error.
    #[must_use]
    pub fn whole(&self) -> (f64, f64) {
        self.series.last().map_or((f64::NAN, f64::NAN), |s| mean_and_error(s))
    }
}

struct Batch {
    means: Vec<f64>,
    paths: u64,
    lookups: u64,
    exceeded: u64,
    non_finite: Option<NonFinite>,
}

fn batch(plan: &Plan<'_>, index: u64, cancel: CancelToken<'_>) -> Option<Batch> {
    let size = (plan.scene.width, plan.scene.height);
    let mut sums = vec![[0.0f64; 3]; plan.layout.blocks()];
    let mut counts = vec![0u64; plan.layout.blocks()];
    let mut done = Batch { means: Vec::new(), paths: 0, lookups: 0, exceeded: 0, non_finite: None };
    let first = plan.first_sample + index * plan.spp;
    // Samples of one low-discrepancy sequence are correlated, but batches must be independent.
    let mut settings = *plan.settings;
    if settings.sampler != SamplerKind::Independent {
        settings.seed = settings.seed.wrapping_add((index + 1) << 32);
    }
    for y in 0..size.1 {
        for x in 0..size.0 {
            let block = plan.layout.block((x, y), size);
            for sample in first..first + plan.spp {
                let estimate =
                    (plan.kernel)(plan.scene, &settings, PathIndex { x, y, sample }, cancel.into());
                done.paths += 1;
                done.lookups += estimate.lookups;
                done.exceeded += estimate.exceeded;
                if !estimate.rgb.is_finite() {
                    done.non_finite.get_or_insert(NonFinite { x, y, sample });
                    continue;
                }
                counts[block] += 1;
                for (sum, value) in sums[block].iter_mut().zip(estimate.rgb.to_array()) {
                    *sum += f64::from(value);
                }
            }
            // The estimate of a cancelled path is meaningless.
            if !cancel.is_active() {
                return None;
            }
        }
    }
    let blocks = sums.iter().zip(&counts);
    done.means = blocks.flat_map(|(sum, n)| sum.map(|s| s / (*n).max(1) as f64)).collect();
    let total: f64 = sums.iter().flatten().sum();
    done.means.push(total / (3 * counts.iter().sum::<u64>().max(1)) as f64);
    Some(done)
}
