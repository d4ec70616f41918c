//! Distribution of the variance over samples, and the samples with the largest weights.
//!
//! The weight of a sample is its squared distance from the mean of its pixel, (x − x̄)², summed over
//! channels. The weights sum to n − 1 times the variance of one sample. If a thousandth of the samples holds
//! most of the variance, the image has fireflies, and more samples reduce the noise slowly.

use super::{Split, StrategyPlan, strategies::main_layer};
use crate::estimator::PathIndex;
use crate::transport::CancelToken;
use glam::DVec3;
use rayon::prelude::*;

/// Number of samples that are listed.
const NAMED: usize = 8;

/// A sample with a large weight.
#[derive(Clone, Debug, PartialEq)]
pub struct HeavySample {
    /// Index of the path.
    pub at: PathIndex,
    /// Share of the variance.
    pub share: f64,
    /// Sum of its channels over that of its pixel's mean; infinite if the mean is black.
    pub times_mean: f64,
    /// Technique of its largest contribution.
    pub technique: String,
    /// Scattering order of its largest contribution.
    pub order: String,
}

/// Weights of all samples of a region.
#[derive(Clone, Debug, PartialEq)]
pub struct Heaviest {
    /// Number of traced samples.
    pub samples: usize,
    /// Shares of the weights, in decreasing order; they sum to one.
    shares: Vec<f32>,
    /// The samples with the largest weights, in the same order.
    pub named: Vec<HeavySample>,
}

impl Heaviest {
    /// Traces the paths of a plan and computes their weights; `None` if the variance is zero, or after
    /// cancellation.
    #[must_use]
    pub fn measure(plan: &StrategyPlan<'_>, cancel: CancelToken<'_>) -> Option<Self> {
        let (width, height) = plan.size();
        let rows: Option<Vec<Vec<Weighed>>> = (0..height)
            .into_par_iter()
            .map(|row| {
                let mut weighed = Vec::with_capacity(width * plan.spp());
                for column in 0..width {
                    weigh(plan, plan.pixel(column, row), cancel, &mut weighed)?;
                }
                Some(weighed)
            })
            .collect();
        let mut all: Vec<Weighed> = rows?.into_iter().flatten().collect();
        // Sums are computed in the order of pixels, and the sort is stable, so the result does not depend on
        // threads.
        let total: f64 = all.iter().map(|w| f64::from(w.weight)).sum();
        all.sort_by(|a, b| b.weight.total_cmp(&a.weight));
        let named = all.iter().take(NAMED).filter(|w| w.weight > 0.0).map(|w| HeavySample {
            at: w.at,
            share: f64::from(w.weight) / total,
            times_mean: w.times_mean,
            technique: main_layer(plan, w.at, Split::Technique),
            order: main_layer(plan, w.at, Split::Order),
        });
        let named = named.collect();
        let shares = all.iter().map(|w| (f64::from(w.weight) / total) as f32).collect();
        (total > 0.0).then_some(Self { samples: all.len(), shares, named })
    }

    /// Share of the variance held by the heaviest `fraction` of the samples, at least one sample.
    #[must_use]
    pub fn held_by(&self, fraction: f64) -> f64 {
        let count = (fraction * self.samples as f64).round().max(1.0) as usize;
        self.shares.iter().take(count).map(|share| f64::from(*share)).sum()
    }
}

#[cfg(test)]
impl Heaviest {
    /// Samples of equal weight.
    pub(super) fn even(samples: usize) -> Self {
        Self { samples, shares: vec![1.0 / samples as f32; samples], named: Vec::new() }
    }

    /// One sample that has all the weight.
    pub(super) fn one(samples: usize, technique: &str, order: &str) -> Self {
        let at = PathIndex { x: 0, y: 0, sample: 0 };
        let [technique, order] = [technique, order].map(str::to_owned);
        let named = vec![HeavySample { at, share: 1.0, times_mean: f64::INFINITY, technique, order }];
        Self { samples, shares: vec![1.0], named }
    }
}

struct Weighed {
    at: PathIndex,
    weight: f32,
    times_mean: f64,
}

/// Computes the weights of the samples of one pixel.
fn weigh(
    plan: &StrategyPlan<'_>,
    [x, y]: [u32; 2],
    cancel: CancelToken<'_>,
    to: &mut Vec<Weighed>,
) -> Option<()> {
    let mut samples = Vec::with_capacity(plan.spp());
    for sample in plan.samples.0..plan.samples.1 {
        let at = PathIndex { x, y, sample };
        let estimate = plan.trace(at, cancel.into());
        if !cancel.is_active() {
            return None;
        }
        if estimate.rgb.is_finite() {
            samples.push((at, estimate.rgb.as_dvec3()));
        }
    }
    let mean = samples.iter().fold(DVec3::ZERO, |sum, (_, rgb)| sum + *rgb) / samples.len().max(1) as f64;
    to.extend(samples.into_iter().map(|(at, rgb)| Weighed {
        at,
        weight: (rgb - mean).length_squared() as f32,
        times_mean: rgb.element_sum() / mean.element_sum(),
    }));
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimator::{Settings, find};
    use crate::io::{Library, embedded, scene_file};
    use crate::scene::build;

    #[test]
    fn walks_that_meet_a_small_light_hold_the_noise_in_a_few_samples() {
        let scene = embedded::find("cloud-sidelit").unwrap();
        let keys = ["film.width=48".to_owned(), "film.height=36".to_owned()];
        let doc =
            scene_file::override_keys(&scene_file::parse(scene.toml, scene.name).unwrap(), &keys).unwrap();
        let scene = build(&doc, &mut Library::default()).unwrap();
        let settings = Settings::new(&doc.estimator, 1);
        let measured = |id: &str| {
            let kernel = find(id).unwrap().kernel;
            let plan = StrategyPlan::whole(&scene, kernel, &settings, (0, 16));
            Heaviest::measure(&plan, CancelToken::NEVER).unwrap()
        };
        let [walks, both] = ["spectral-mis", "uni-nee-mis"].map(measured);
        assert_eq!(walks.samples, 48 * 36 * 16);
        assert!((walks.held_by(1.0) - 1.0).abs() < 1e-4);
        let [of_walks, of_both] = [&walks, &both].map(|heaviest| heaviest.held_by(1e-3));
        assert!(of_walks > 0.8 && of_walks > of_both, "{of_walks} {of_both}");
        let first = &walks.named[0];
        assert_eq!((walks.named.len(), first.technique.as_str()), (NAMED, "unidirectional"));
        assert!(first.times_mean > 8.0 && first.share >= walks.named[1].share);
        // The weights of a pixel sum to the total variance of its layers.
        let kernel = find("uni-nee-mis").unwrap().kernel;
        let pixel = StrategyPlan {
            window: [24, 18, 25, 19],
            ..StrategyPlan::whole(&scene, kernel, &settings, (0, 16))
        };
        let mut weighed = Vec::new();
        weigh(&pixel, [24, 18], CancelToken::NEVER, &mut weighed).unwrap();
        let sum: f64 = weighed.iter().map(|w| f64::from(w.weight)).sum();
        let parts = crate::inspect::Strategies::render(&pixel, Split::Technique, CancelToken::NEVER).unwrap();
        let variance: f64 = parts.layers.iter().map(|layer| f64::from(layer.covariance[0])).sum();
        assert!((sum / 15.0 - variance).abs() < 1e-5 * variance, "{sum} {variance}");
        assert!(walks.named.iter().all(|heavy| (heavy.at.x < 48) && (heavy.at.y < 36)));
    }
}
