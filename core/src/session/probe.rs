//! Replay of individual paths of a view; random numbers are a function of (seed, pixel, sample).

use crate::estimator::{Entry, Kernel, PathEstimate, PathIndex, Settings};
use crate::inspect::{Evidence, Recording, Split, Strategies, StrategyPlan, scene_of};
use crate::medium::Violations;
use crate::scene::Scene;
use crate::transport::CancelToken;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// Scene, kernel and settings with which the paths of one submission are traced; cheap to clone.
#[derive(Clone)]
pub struct Probe {
    pub(super) scene: Arc<Scene>,
    /// Scenes of earlier samples with lower majorants, each with the sample number before which it applies.
    pub(super) before: Vec<(u64, Arc<Scene>)>,
    pub(super) kernel: Kernel,
    pub(super) settings: Settings,
    /// Majorant violations found by the paths of the film; paths traced separately record their own.
    found: Vec<Arc<Violations>>,
}

impl fmt::Debug for Probe {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("Probe").field("settings", &self.settings).finish_non_exhaustive()
    }
}

/// The records of violations of all media of a scene.
fn violations_of(scene: &Scene) -> Vec<Arc<Violations>> {
    scene.media.iter().map(|medium| Arc::clone(&medium.placed.violations)).collect()
}

/// Approximate maximum number of pixels that are analysed as evidence, and of samples over all of them. This
/// determines fractions to one or two per cent.
const EVIDENCE_PIXELS: u64 = 20_000;
const EVIDENCE_SAMPLES: u64 = 160_000;

/// Estimate of one sample of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelSample {
    /// Linear sRGB.
    pub rgb: [f32; 3],
    /// Evaluations of the medium's coefficients.
    pub lookups: u64,
}

impl Probe {
    /// Creates a probe of a scene with the kernel of an estimator.
    #[must_use]
    pub fn new(scene: Arc<Scene>, kernel: Kernel, settings: Settings) -> Self {
        let found = violations_of(&scene);
        Self { scene, before: Vec::new(), kernel, settings, found }
    }

    /// Returns the same probe with a separate record of exceeded majorants, so that replayed paths do not
    /// raise the majorants of the film.
    #[must_use]
    pub fn aside(&self) -> Self {
        let scene = &self.scene;
        let scene = if scene.is_watched() { Arc::new(scene.without_violations()) } else { Arc::clone(scene) };
        Self { scene, ..self.clone() }
    }

    /// Probe for a film without samples: no violation has been found.
    pub(super) fn afresh(&self) -> Self {
        let aside = self.aside();
        Self { found: violations_of(&aside.scene), ..aside }
    }

    /// Violations of a medium's newest majorant by the paths of the film; `None` if the document's medium
    /// with this index is not part of the scene.
    #[must_use]
    pub fn violations(&self, medium: usize) -> Option<&Violations> {
        let slot = self.scene.media.iter().position(|m| m.index == medium)?;
        self.found.get(slot).map(|violations| &**violations)
    }

    /// Number of times that the majorants were raised. Samples added after the next raise use higher
    /// majorants.
    #[must_use]
    pub fn raises(&self) -> usize {
        self.before.len()
    }

    /// Samples from the `spp`-th on until the majorants may be raised. Raises occur after 1, 2, 4, 8, …
    /// samples per pixel, so that the majorants of a sample do not depend on time.
    pub(super) fn until_raise(&self, spp: u64) -> u64 {
        if !self.scene.is_progressive() {
            return u64::MAX;
        }
        spp.saturating_add(1).checked_next_power_of_two().map_or(u64::MAX, |next| next - spp)
    }

    /// Raises exceeded majorants for all samples from `sample` on. Returns false if no raise is due, or no
    /// majorant was exceeded.
    pub(super) fn raise_majorants(&mut self, sample: u64) -> bool {
        let Some(raised) = sample.is_power_of_two().then(|| self.scene.raised()).flatten() else {
            return false;
        };
        self.found = violations_of(&raised);
        self.before.push((sample, std::mem::replace(&mut self.scene, Arc::new(raised))));
        true
    }

    /// Scene in which new paths are traced.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Traces the path of sample number `sample` of a pixel, exactly as the film has received it.
    pub fn path(&self, x: u32, y: u32, sample: u64, cancel: CancelToken<'_>) -> PathEstimate {
        (self.kernel)(self.scene_of(sample), &self.settings, PathIndex { x, y, sample }, cancel.into())
    }

    /// Traces the same path and records every step.
    #[must_use]
    pub fn record(&self, at: PathIndex, cancel: CancelToken<'_>) -> Recording {
        Recording::new(self.scene_of(at.sample), self.kernel, &self.settings, at, cancel)
    }

    /// Renders the first samples of every pixel, split into contributions. Returns `None` if it was
    /// cancelled.
    #[must_use]
    pub fn strategies(
        &self,
        split: Split,
        samples: Range<u64>,
        cancel: CancelToken<'_>,
    ) -> Option<Strategies> {
        Strategies::render(&self.plan(samples), split, cancel)
    }

    /// Analyses the noise of the image or of a box of pixels by the contributions to its samples. Returns
    /// `None` if there is no noise, or it was cancelled.
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

    /// Returns a probe of the same scene and random numbers with another estimator.
    #[must_use]
    pub fn under(&self, entry: &Entry) -> Self {
        Self { kernel: entry.kernel, ..self.clone() }
    }

    /// Scene in which a sample was traced.
    fn scene_of(&self, sample: u64) -> &Scene {
        scene_of(&self.scene, &self.before, sample)
    }

    /// Samples of a pixel, by number. Empty if the pixel is outside the film or the work was cancelled.
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
