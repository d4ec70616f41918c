//! Contributions to an image by technique, scattering order, number of null collisions or hero.
//!
//! The paths of the film are traced again, each in the scene that it was traced in, and their contributions
//! are sorted into layers. Non-finite samples are rejected, as on the film, so the layers sum to the image up
//! to rounding. With X_k the contribution of layer k to a sample X, the share of the variance due to the
//! layer is Cov(X_k, X) / Var(X); the shares sum to one.

use crate::estimator::{Kernel, PathEstimate, PathIndex, Settings};
use crate::scene::Scene;
use crate::spectrum::Carried;
use crate::transport::{CancelToken, Event, Note, Observer, PathContext, Technique};
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Arc;

/// Property by which contributions are separated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Split {
    /// Sampling technique.
    #[default]
    Technique,
    /// Number of scattering events and reflections.
    Order,
    /// Number of null collisions on the path.
    Nulls,
    /// Hero component of the path.
    Hero,
}

/// Number of wavelength bins, and their range; wavelengths outside are in the first or last bin.
const HERO_BINS: usize = 8;
const HERO_NM: Range<f32> = 400.0..720.0;
/// Orders below this have separate layers.
const ORDERS: usize = 8;

impl Split {
    /// All splits, in display order.
    pub const ALL: [Self; 4] = [Self::Technique, Self::Order, Self::Nulls, Self::Hero];

    /// Stable id for the command line.
    #[must_use]
    pub fn id(self) -> &'static str {
        match self {
            Self::Technique => "technique",
            Self::Order => "order",
            Self::Nulls => "nulls",
            Self::Hero => "hero",
        }
    }

    /// Display name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Technique => "technique",
            Self::Order => "scattering order",
            Self::Nulls => "null collisions",
            Self::Hero => "hero",
        }
    }

    /// Names of all layers, including those that are empty in an image.
    #[must_use]
    pub fn layers(self) -> Vec<String> {
        match self {
            Self::Technique => Technique::ALL.iter().map(|t| t.name().to_owned()).collect(),
            Self::Order => (0..ORDERS).map(|k| k.to_string()).chain([format!("{ORDERS} and more")]).collect(),
            Self::Nulls => {
                ["0", "1", "2", "3–4", "5–8", "9–16", "17–32", "33 and more"].map(Into::into).into()
            }
            Self::Hero => {
                let width = (HERO_NM.end - HERO_NM.start) / HERO_BINS as f32;
                let bin = |i: usize| HERO_NM.start + width * i as f32;
                let nm = (0..HERO_BINS).map(|i| format!("{:.0}–{:.0} nm", bin(i), bin(i + 1)));
                nm.chain(["red", "green", "blue", "achromatic"].map(Into::into)).collect()
            }
        }
    }
}

/// Sorts the contributions of one path into layers.
struct Sorter {
    split: Split,
    hero: usize,
    order: usize,
    nulls: u32,
    /// Null collisions of the current connection or separate walk, if there is one.
    aside: Option<u32>,
    /// Whether the connection or walk samples its events; a connection treats all collisions as null.
    draws: bool,
    equiangular: bool,
    layers: Vec<DVec3>,
}

impl Sorter {
    fn new(split: Split) -> Self {
        let layers = vec![DVec3::ZERO; split.layers().len()];
        Self { split, hero: 0, order: 0, nulls: 0, aside: None, draws: false, equiangular: false, layers }
    }

    /// Resets the state for a new path.
    fn clear(&mut self) {
        (self.order, self.nulls, self.aside, self.equiangular) = (0, 0, None, false);
        self.layers.fill(DVec3::ZERO);
    }

    fn is_null(&mut self) {
        *self.aside.as_mut().unwrap_or(&mut self.nulls) += 1;
    }

    fn layer(&self, technique: Technique) -> usize {
        match self.split {
            Split::Technique => technique as usize,
            Split::Order => (self.order + usize::from(technique == Technique::Equiangular)).min(ORDERS),
            Split::Nulls => match self.nulls + self.aside.unwrap_or(0) {
                n @ 0..=2 => n as usize,
                n @ 3..=32 => (n - 1).ilog2() as usize + 2,
                _ => 7,
            },
            Split::Hero => self.hero,
        }
    }
}

impl Observer for Sorter {
    fn note(&mut self, note: &Note) {
        match note {
            Note::Camera { carried, .. } => {
                self.hero = match carried {
                    Carried::Wavelengths(nm, _) => {
                        let share = (nm[0] - HERO_NM.start) / (HERO_NM.end - HERO_NM.start);
                        (share * HERO_BINS as f32).clamp(0.0, HERO_BINS as f32 - 1.0) as usize
                    }
                    Carried::Channels(channels, _) => HERO_BINS + channels[0] as usize,
                    Carried::Grey => HERO_BINS + 3,
                };
            }
            Note::Collision(..) if self.aside.is_some() && !self.draws => self.is_null(),
            Note::Drawn { event: Event::Null, .. } | Note::DrawnForAll { event: Event::Null, .. } => {
                self.is_null();
            }
            Note::Vertex(_) => self.order += 1,
            Note::Connect { .. } if !self.equiangular => (self.aside, self.draws) = (Some(0), false),
            Note::EquiangularVertex => (self.equiangular, self.aside, self.draws) = (true, Some(0), false),
            Note::LightWalk => (self.aside, self.draws) = (Some(0), true),
            Note::Connected { arrives: false } if !self.equiangular => self.aside = None,
            Note::LightWalkEnds => self.aside = None,
            Note::EquiangularVertexEnds => (self.equiangular, self.aside) = (false, None),
            Note::Contribution { technique, film, .. } => {
                let layer = self.layer(*technique);
                self.layers[layer] += film.as_dvec3();
                if *technique == Technique::Connection {
                    self.aside = None;
                }
            }
            _ => {}
        }
    }
}

/// Selection of the paths that are sorted.
#[derive(Clone, Copy)]
pub struct StrategyPlan<'a> {
    /// The frozen scene.
    pub scene: &'a Scene,
    /// Scenes of earlier samples, with lower majorants, each with the index after its last sample.
    pub earlier: &'a [(u64, Arc<Scene>)],
    /// Kernel of the estimator.
    pub kernel: Kernel,
    /// Settings of the paths.
    pub settings: &'a Settings,
    /// Left, top, right and bottom of the traced pixels; right and bottom are exclusive.
    pub window: [u32; 4],
    /// Distance between traced columns and rows of the window; 1 for all pixels.
    pub stride: u32,
    /// First sample of every pixel, and the one after the last.
    pub samples: (u64, u64),
}

impl<'a> StrategyPlan<'a> {
    /// A plan for all pixels of an image.
    #[must_use]
    pub fn whole(scene: &'a Scene, kernel: Kernel, settings: &'a Settings, samples: (u64, u64)) -> Self {
        let window = [0, 0, scene.width, scene.height];
        Self { scene, earlier: &[], kernel, settings, window, stride: 1, samples }
    }

    /// Traces the path of one sample, identical to the film's.
    pub(super) fn trace(&self, at: PathIndex, context: PathContext<'_>) -> PathEstimate {
        (self.kernel)(scene_of(self.scene, self.earlier, at.sample), self.settings, at, context)
    }

    /// Numbers of traced columns and rows.
    pub(super) fn size(&self) -> (usize, usize) {
        let [left, top, right, bottom] = self.window;
        let pixels = |from: u32, to: u32| to.saturating_sub(from).div_ceil(self.stride.max(1)) as usize;
        (pixels(left, right), pixels(top, bottom))
    }

    /// Pixel of a traced column and row.
    pub(super) fn pixel(&self, column: usize, row: usize) -> [u32; 2] {
        let [left, top, ..] = self.window;
        let stride = self.stride.max(1);
        [left + column as u32 * stride, top + row as u32 * stride]
    }

    /// Number of samples per pixel.
    pub(super) fn spp(&self) -> usize {
        self.samples.1.saturating_sub(self.samples.0) as usize
    }
}

/// Scene in which a sample is traced: the newest, or the first earlier one that ends after the sample.
pub(crate) fn scene_of<'a>(newest: &'a Scene, earlier: &'a [(u64, Arc<Scene>)], sample: u64) -> &'a Scene {
    earlier.iter().find(|(end, _)| sample < *end).map_or(newest, |(_, scene)| scene)
}

/// Name of the layer with the largest contribution of one path.
pub(super) fn main_layer(plan: &StrategyPlan<'_>, at: PathIndex, split: Split) -> String {
    let mut sorter = Sorter::new(split);
    plan.trace(at, PathContext::observed(CancelToken::NEVER, &mut sorter));
    let grey = sorter.layers.iter().map(|layer| layer.element_sum());
    let largest = grey.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
    largest.and_then(|(i, _)| split.layers().into_iter().nth(i)).unwrap_or_default()
}

/// Contributions of one layer to an image.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Display name.
    pub name: String,
    /// Mean linear sRGB over the finite samples, row by row from the top; NaN without finite samples, as on
    /// the film.
    pub mean: Vec<[f32; 3]>,
    /// Cov(X_k, X) of one sample, summed over channels, per pixel; zero below two samples.
    pub covariance: Vec<f32>,
}

impl Layer {
    /// Mean over the image.
    #[must_use]
    pub fn whole(&self) -> [f64; 3] {
        let sum = self.mean.iter().fold(DVec3::ZERO, |sum, p| sum + Vec3::from_array(*p).as_dvec3());
        (sum / self.mean.len().max(1) as f64).to_array()
    }
}

/// Image separated into layers.
#[derive(Clone, Debug, PartialEq)]
pub struct Strategies {
    /// Property by which contributions are separated.
    pub split: Split,
    /// Width in pixels.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
    /// Samples per pixel, including non-finite ones.
    pub spp: u64,
    /// Layers that are not black everywhere.
    pub layers: Vec<Layer>,
}

/// Sums over the finite samples of a pixel: of every layer, and of its product with the total, summed over
/// channels.
struct Sums {
    count: u64,
    layers: Vec<DVec3>,
    products: Vec<f64>,
}

/// Sorts the contributions of one path by several splits at once.
struct Sorters(Vec<Sorter>);

impl Observer for Sorters {
    fn note(&mut self, note: &Note) {
        self.0.iter_mut().for_each(|sorter| sorter.note(note));
    }
}

impl Strategies {
    /// Traces the samples of every pixel and sorts their contributions; `None` after cancellation.
    #[must_use]
    pub fn render(plan: &StrategyPlan<'_>, split: Split, cancel: CancelToken<'_>) -> Option<Self> {
        Self::render_all(plan, &[split], cancel)?.pop()
    }

    /// Sorts the contributions of the same paths by several splits.
    #[must_use]
    pub fn render_all(
        plan: &StrategyPlan<'_>,
        splits: &[Split],
        cancel: CancelToken<'_>,
    ) -> Option<Vec<Self>> {
        let (width, height) = plan.size();
        let rows: Option<Vec<Vec<Vec<Sums>>>> =
            (0..height).into_par_iter().map(|y| Self::row(plan, splits, y, cancel)).collect();
        let pixels: Vec<Vec<Sums>> = rows?.into_iter().flatten().collect();
        let (first, end) = plan.samples;
        let of = |(i, split): (usize, &Split)| {
            let sums = || pixels.iter().map(move |pixel| &pixel[i]);
            let layers = split.layers().into_iter().enumerate().map(|(k, name)| Layer {
                name,
                mean: sums().map(|p| p.mean(k)).collect(),
                covariance: sums().map(|p| p.covariance(k) as f32).collect(),
            });
            let seen = |layer: &Layer| layer.mean.iter().flatten().any(|x| x.is_finite() && *x != 0.0);
            let layers = layers.filter(seen).collect();
            Self { split: *split, width, height, spp: end.saturating_sub(first), layers }
        };
        Some(splits.iter().enumerate().map(of).collect())
    }

    /// Sums of a row, by pixel and split.
    fn row(
        plan: &StrategyPlan<'_>,
        splits: &[Split],
        row: usize,
        cancel: CancelToken<'_>,
    ) -> Option<Vec<Vec<Sums>>> {
        let mut sorters = Sorters(splits.iter().map(|split| Sorter::new(*split)).collect());
        let (width, _) = plan.size();
        let mut pixels = Vec::with_capacity(width);
        for column in 0..width {
            let [x, y] = plan.pixel(column, row);
            let mut sums: Vec<Sums> = sorters.0.iter().map(|sorter| Sums::new(sorter.layers.len())).collect();
            for sample in plan.samples.0..plan.samples.1 {
                sorters.0.iter_mut().for_each(Sorter::clear);
                let context = PathContext::observed(cancel, &mut sorters);
                let estimate = plan.trace(PathIndex { x, y, sample }, context);
                // Checked after each path: the estimate of a cancelled path must not be used.
                if !cancel.is_active() {
                    return None;
                }
                if estimate.rgb.is_finite() {
                    sums.iter_mut().zip(&sorters.0).for_each(|(sums, sorter)| sums.add(&sorter.layers));
                }
            }
            pixels.push(sums);
        }
        Some(pixels)
    }

    /// Share of each layer in the variance of one sample, over a subset of the pixels; the shares sum to one.
    /// `None` if the variance is zero.
    #[must_use]
    pub fn variance_shares(&self, pixels: impl Fn(usize, usize) -> bool) -> Option<Vec<f64>> {
        let inside = |i: usize| pixels(i % self.width, i / self.width);
        let sum = |layer: &Layer| {
            let of = layer.covariance.iter().enumerate().filter(|(i, _)| inside(*i));
            of.map(|(_, c)| f64::from(*c)).sum()
        };
        let sums: Vec<f64> = self.layers.iter().map(sum).collect();
        let total: f64 = sums.iter().sum();
        (total > 0.0).then(|| sums.iter().map(|s| s / total).collect())
    }
}

impl Sums {
    fn new(layers: usize) -> Self {
        Self { count: 0, layers: vec![DVec3::ZERO; layers], products: vec![0.0; layers] }
    }

    fn add(&mut self, layers: &[DVec3]) {
        self.count += 1;
        let all: DVec3 = layers.iter().sum();
        for ((sum, product), layer) in self.layers.iter_mut().zip(&mut self.products).zip(layers) {
            *sum += *layer;
            *product += layer.dot(all);
        }
    }

    fn mean(&self, k: usize) -> [f32; 3] {
        // NaN without samples: 0 / 0.
        (self.layers[k] / self.count as f64).as_vec3().to_array()
    }

    /// Cov(X_k, X) of one sample, summed over channels.
    fn covariance(&self, k: usize) -> f64 {
        if self.count < 2 {
            return 0.0;
        }
        let (n, all) = (self.count as f64, self.layers.iter().sum());
        (self.products[k] - self.layers[k].dot(all) / n) / (n - 1.0)
    }
}

#[cfg(test)]
#[path = "strategies_tests.rs"]
mod tests;
