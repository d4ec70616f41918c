//! Any path of a view, traced again: random numbers are a function of (seed, pixel, sample).

use crate::estimator::{Entry, Kernel, PathEstimate, PathIndex, Settings};
use crate::inspect::{Evidence, Recording, Split, Strategies, StrategyPlan, scene_of};
use crate::medium::Violations;
use crate::scene::Scene;
use crate::transport::CancelToken;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// Everything that the paths of one submission are traced with; cheap to clone.
#[derive(Clone)]
pub struct Probe {
    pub(super) scene: Arc<Scene>,
    /// Scenes of earlier samples, whose majorants were lower, with the sample that each ends before.
    pub(super) before: Vec<(u64, Arc<Scene>)>,
    pub(super) kernel: Kernel,
    pub(super) settings: Settings,
    /// What the film's paths have found of the scene's majorants; paths that are traced aside have findings of their own.
    found: Arc<Violations>,
}

impl fmt::Debug for Probe {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("Probe").field("settings", &self.settings).finish_non_exhaustive()
    }
}

/// At most about so many pixels are taken apart as evidence, with about so many samples of all of them together: that
/// tells shares to a per cent or two.
const EVIDENCE_PIXELS: u64 = 20_000;
const EVIDENCE_SAMPLES: u64 = 160_000;

/// One sample of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelSample {
    /// Linear sRGB.
    pub rgb: [f32; 3],
    /// Evaluations of the medium's coefficients.
    pub lookups: u64,
}

impl Probe {
    /// Paths of a scene by an estimator's kernel.
    #[must_use]
    pub fn new(scene: Arc<Scene>, kernel: Kernel, settings: Settings) -> Self {
        let found = Arc::clone(&scene.violations);
        Self { scene, before: Vec::new(), kernel, settings, found }
    }

    /// The same probe with findings of its own about exceeded majorants, so that replayed paths do not raise the majorants
    /// of the film.
    #[must_use]
    pub fn aside(&self) -> Self {
        let scene = &self.scene;
        let scene = if scene.medium.is_watched() { Arc::new(scene.unwatched()) } else { Arc::clone(scene) };
        Self { scene, ..self.clone() }
    }

    /// Paths of a film that has had no samples yet: nothing was found of the majorants.
    pub(super) fn afresh(&self) -> Self {
        let aside = self.aside();
        Self { found: Arc::clone(&aside.scene.violations), ..aside }
    }

    /// Where the film's paths have found the newest majorants to be exceeded.
    #[must_use]
    pub fn violations(&self) -> &Violations {
        &self.found
    }

    /// How often the majorants were raised: samples that the film does not have yet are traced otherwise after the next time.
    #[must_use]
    pub fn raises(&self) -> usize {
        self.before.len()
    }

    /// Samples from the `spp`-th on until the majorants may be raised: after 1, 2, 4, 8, … of every pixel, so that what is
    /// traced with which majorants does not depend on time.
    pub(super) fn until_raise(&self, spp: u64) -> u64 {
        if !self.scene.medium.is_progressive() {
            return u64::MAX;
        }
        spp.saturating_add(1).checked_next_power_of_two().map_or(u64::MAX, |next| next - spp)
    }

    /// Raises the majorants, where they were found to be exceeded, for all samples from `sample` on; false if it is not
    /// time, or there is nothing to raise.
    pub(super) fn raise_majorants(&mut self, sample: u64) -> bool {
        let Some(raised) = sample.is_power_of_two().then(|| self.scene.raised()).flatten() else {
            return false;
        };
        self.found = Arc::clone(&raised.violations);
        self.before.push((sample, std::mem::replace(&mut self.scene, Arc::new(raised))));
        true
    }

    /// The scene that paths are traced in.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The path of sample number `sample` of a pixel, exactly as the film has received it.
    pub fn path(&self, x: u32, y: u32, sample: u64, cancel: CancelToken<'_>) -> PathEstimate {
        (self.kernel)(self.scene_of(sample), &self.settings, PathIndex { x, y, sample }, cancel.into())
    }

    /// The same path with every step that it takes.
    #[must_use]
    pub fn record(&self, at: PathIndex, cancel: CancelToken<'_>) -> Recording {
        Recording::new(self.scene_of(at.sample), self.kernel, &self.settings, at, cancel)
    }

    /// The image of the first samples of every pixel, taken apart; `None` if it was called off.
    #[must_use]
    pub fn strategies(
        &self,
        split: Split,
        samples: Range<u64>,
        cancel: CancelToken<'_>,
    ) -> Option<Strategies> {
        Strategies::render(&self.plan(samples), split, cancel)
    }

    /// Why a box of pixels is noisy, or the whole image, by samples that are taken apart; `None` if there is no noise, or
    /// it was called off.
    #[must_use]
    pub fn evidence(
        &self,
        region: Option<[u32; 4]>,
        chroma: Option<f64>,
        cancel: CancelToken<'_>,
    ) -> Option<Evidence> {
        let mut plan = self.plan(0..0);
        let [left, top, right, bottom] = region.unwrap_or(plan.window);
        plan.window = [left, top, right.min(self.scene.width), bottom.min(self.scene.height)];
        let pixels = |stride: u32| {
            let [left, top, right, bottom] = plan.window;
            let steps = |from: u32, to: u32| u64::from(to.saturating_sub(from).div_ceil(stride));
            steps(left, right) * steps(top, bottom)
        };
        plan.stride = pixels(1).div_ceil(EVIDENCE_PIXELS).isqrt().max(1) as u32;
        plan.samples = (0, (EVIDENCE_SAMPLES / pixels(plan.stride).max(1)).clamp(8, 512));
        Evidence::measure(&plan, chroma, cancel)
    }

    fn plan(&self, samples: Range<u64>) -> StrategyPlan<'_> {
        let samples = (samples.start, samples.end);
        StrategyPlan {
            earlier: &self.before,
            ..StrategyPlan::whole(&self.scene, self.kernel, &self.settings, samples)
        }
    }

    /// The same scene and random numbers under another estimator.
    #[must_use]
    pub fn under(&self, entry: &Entry) -> Self {
        Self { kernel: entry.kernel, ..self.clone() }
    }

    /// The scene that a sample was traced in.
    fn scene_of(&self, sample: u64) -> &Scene {
        scene_of(&self.scene, &self.before, sample)
    }

    /// Samples of a pixel, by their numbers; none if the pixel is outside of the film or the work is not
    /// wanted any more.
    #[must_use]
    pub fn samples(
        &self,
        (x, y): (u32, u32),
        which: Range<u64>,
        cancel: CancelToken<'_>,
    ) -> Vec<PixelSample> {
        let mut samples = Vec::new();
        if x >= self.scene.width || y >= self.scene.height {
            return samples;
        }
        for sample in which {
            let path = self.path(x, y, sample, cancel);
            if !cancel.is_active() {
                return Vec::new();
            }
            samples.push(PixelSample { rgb: path.rgb.to_array(), lookups: path.lookups });
        }
        samples
    }
}
