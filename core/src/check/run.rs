//! Runs cases: as many samples as the power that was asked for needs, then the comparisons.

use super::batches::{BATCHES, DOF, Plan};
use super::report::{Report, Row};
use super::stats::{critical_t, power_t};
use super::{Answer, Batches, Case, CheckError, compare};
use crate::estimator::{Entry, Settings};
use crate::scene::Scene;
use crate::transport::CancelToken;
use std::time::Instant;

/// How hard to look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// The relative bias of an image's mean that has to be found with 95 % probability.
    pub detect: f64,
    /// The most paths of one estimator on one case.
    pub max_paths: u64,
    /// The most seconds of one estimator on one case; leaves the number of samples to the machine.
    pub seconds: Option<f64>,
}

impl Effort {
    /// Finds a bias of 3 %.
    pub const QUICK: Self = Self { detect: 0.03, max_paths: 6_000_000, seconds: None };
    /// Finds a bias of 1 %.
    pub const DEEP: Self = Self { detect: 0.01, max_paths: 400_000_000, seconds: None };

    /// For people's own scenes, whose cost nobody knows: at most 45 seconds for `images` images of them, or
    /// ten minutes for a deep look.
    #[must_use]
    pub fn own_scenes(deep: bool, images: usize) -> Self {
        let (effort, seconds) = if deep { (Self::DEEP, 600.0) } else { (Self::QUICK, 45.0) };
        Self { seconds: Some(seconds / images.max(1) as f64), ..effort }
    }
}

/// Cases to be run as one family of comparisons.
#[derive(Clone, Debug)]
pub struct Check {
    /// The cases.
    pub cases: Vec<Case>,
    /// How hard to look.
    pub effort: Effort,
}

/// How far a check has come.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'a> {
    /// Images made so far, one per case and estimator.
    pub done: usize,
    /// Images in all.
    pub total: usize,
    /// The case at hand.
    pub scene: &'a str,
    /// The estimator at hand.
    pub estimator: &'static str,
    /// Lines of the table that are new.
    pub rows: &'a [Row],
}

/// Paths of the first look at an estimator's noise.
const PILOT_PATHS: u64 = 16_384;
/// An image that still does not know its noise after as many paths will hardly ever.
const BLIND_PATHS: u64 = 8_000_000;
/// Aims this much below the bias that has to be found: the noise is known roughly only.
const MARGIN: f64 = 0.95;

impl Check {
    /// Runs every case under every estimator that is unbiased for it; `Ok(None)` if it was cancelled.
    ///
    /// # Errors
    /// When a scene cannot be frozen.
    pub fn run(
        &self,
        cancel: CancelToken<'_>,
        mut on_progress: impl FnMut(Progress<'_>),
    ) -> Result<Option<Report>, CheckError> {
        let began = Instant::now();
        let critical = critical_t(self.cases.iter().map(Case::comparisons).sum(), DOF);
        let total = self.cases.iter().map(|c| c.estimators().len()).sum();
        let mut report = Report::default();
        let mut done = 0;
        for case in &self.cases {
            let scene = case.scene()?;
            let estimators = case.estimators();
            if estimators.is_empty() {
                let why = case.registry.iter().find_map(|e| e.bias(&case.doc)).unwrap_or("there are none");
                report.notes.push(format!("{}: no estimator is unbiased for it: {why}.", case.name));
            }
            let mut images = Vec::new();
            for entry in &estimators {
                let progress = Progress { done, total, scene: &case.name, estimator: entry.id, rows: &[] };
                on_progress(progress);
                let Some(image) = self.measure(case, &scene, entry, critical, cancel) else {
                    return Ok(None);
                };
                done += 1;
                images.push((*entry, image));
                let rows = match (&case.answer, images.last()) {
                    (Answer::Known(values), Some((_, image))) => {
                        vec![compare::against_known(case, entry, image, values, critical)]
                    }
                    (Answer::Agreement, _) if images.len() == estimators.len() => {
                        compare::pairwise(case, &images, critical)
                    }
                    _ => Vec::new(),
                };
                on_progress(Progress { done, rows: &rows, ..progress });
                report.rows.extend(rows);
            }
        }
        report.seconds = began.elapsed().as_secs_f64();
        Ok(Some(report))
    }

    /// Renders as much as the power needs. After Stein (1945): a first look tells the noise and with it
    /// how many samples that is; they are drawn afresh, so that the look does not bias what it decides on.
    fn measure(
        &self,
        case: &Case,
        scene: &Scene,
        entry: &Entry,
        critical: f64,
        cancel: CancelToken<'_>,
    ) -> Option<Batches> {
        let settings = Settings::new(&case.doc.estimator, seed(case.doc.render.seed, &case.name, entry.id));
        let per_sample = u64::from(scene.width) * u64::from(scene.height) * BATCHES as u64;
        let pilot_spp = (PILOT_PATHS / per_sample).max(1);
        let plan = Plan {
            scene,
            kernel: entry.kernel,
            settings: &settings,
            layout: case.layout,
            first_sample: 0,
            spp: pilot_spp,
        };
        let began = Instant::now();
        let pilot = Batches::render(&plan, cancel)?;
        let per_spp = began.elapsed().as_secs_f64() / pilot_spp as f64;

        // Where nobody knows the answer, the others that it is held against have noise as well.
        let others = (case.estimators().len() as f64 - 1.0).max(1.0);
        let share = if matches!(case.answer, Answer::Agreement) { 1.0 + 1.0 / others } else { 1.0 };
        let needed = |image: &Batches| {
            let (mean, error) = image.whole();
            let found = (critical + power_t(DOF)) * error / mean.abs().max(f64::MIN_POSITIVE);
            // More paths make a long tail shorter.
            let blind = !image.series.last().is_some_and(|s| compare::knows_its_noise(s));
            let least = if blind { (4 * image.spp).min(BLIND_PATHS / per_sample) as f64 } else { 0.0 };
            (share * (found / (self.effort.detect * MARGIN)).powi(2) * image.spp as f64).ceil().max(least)
        };
        let affordable = self.effort.seconds.map_or(f64::INFINITY, |s| s / per_spp);
        let max_paths = self.effort.max_paths.min(case.budget.unwrap_or(u64::MAX));
        let most = affordable.min((max_paths / per_sample) as f64);
        let mut image: Option<Batches> = None;
        let mut first_sample = BATCHES as u64 * pilot_spp;
        loop {
            let have = image.as_ref().map_or(0, |i| i.spp);
            // The noise is known the better the more there is of it; rare events may still raise it.
            let wish = needed(image.as_ref().unwrap_or(&pilot)).min(most).max(1.0) as u64;
            match image.take() {
                Some(image) if wish <= have => return Some(image),
                before => {
                    let spp = wish - have;
                    let more = Batches::render(&Plan { first_sample, spp, ..plan }, cancel)?;
                    first_sample += BATCHES as u64 * spp;
                    image = Some(before.map_or(more.clone(), |b| b.merged(&more)));
                }
            }
        }
    }
}

/// Random numbers of its own for every case and estimator, whatever their places in the registries: images
/// that are compared must be independent. FNV-1a over both names.
fn seed(base: u64, case: &str, estimator: &str) -> u64 {
    let names = case.bytes().chain([0]).chain(estimator.bytes());
    names.fold(0xcbf2_9ce4_8422_2325 ^ base, |h, b| (h ^ u64::from(b)).wrapping_mul(0x0000_0100_0000_01b3))
}
