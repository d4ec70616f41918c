//! Execution of cases: rendering to the requested power, then comparison.

use super::batches::{BATCHES, DOF, Plan};
use super::report::{Report, Row};
use super::stats::{critical_t, power_t};
use super::{Answer, Batches, Case, CheckError, compare};
use crate::estimator::{Entry, Settings};
use crate::scene::Scene;
use crate::transport::CancelToken;
use std::time::Instant;

/// Power and cost limits of a check.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Relative bias of an image mean that has to be detected with 95 % probability.
    pub detect: f64,
    /// Maximum number of paths of one estimator on one case.
    pub max_paths: u64,
    /// Maximum seconds of one estimator on one case. The number of samples then depends on the speed of the
    /// machine.
    pub seconds: Option<f64>,
}

impl Effort {
    /// Detects a bias of 3 %.
    pub const QUICK: Self = Self { detect: 0.03, max_paths: 6_000_000, seconds: None };
    /// Detects a bias of 1 %.
    pub const DEEP: Self = Self { detect: 0.01, max_paths: 400_000_000, seconds: None };

    /// Effort for a user's own scenes, whose cost is unknown: at most 45 seconds for `images` images, or ten
    /// minutes for a deep check.
    #[must_use]
    pub fn own_scenes(deep: bool, images: usize) -> Self {
        let (effort, seconds) = if deep { (Self::DEEP, 600.0) } else { (Self::QUICK, 45.0) };
        Self { seconds: Some(seconds / images.max(1) as f64), ..effort }
    }
}

/// Cases that are run as one family of comparisons.
#[derive(Clone, Debug)]
pub struct Check {
    /// Cases to run.
    pub cases: Vec<Case>,
    /// Power and cost limits.
    pub effort: Effort,
}

/// Progress of a check.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'a> {
    /// Completed images, one per case and estimator.
    pub done: usize,
    /// Total number of images.
    pub total: usize,
    /// Current case.
    pub scene: &'a str,
    /// Current estimator.
    pub estimator: &'static str,
    /// New rows of the table.
    pub rows: &'a [Row],
}

/// Paths of the pilot run that estimates the noise.
const PILOT_PATHS: u64 = 16_384;
/// Number of paths after which an image without a reliable noise estimate gets no further samples for it.
const BLIND_PATHS: u64 = 8_000_000;
/// Factor on the bias to be detected, since the noise is known only approximately.
const MARGIN: f64 = 0.95;

impl Check {
    /// Runs every case with every estimator that is unbiased on it. Returns `Ok(None)` if cancelled.
    ///
    /// # Errors
    /// When a scene cannot be built.
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
                let why =
                    case.registry.iter().find_map(|e| e.bias(&case.doc)).unwrap_or("the registry is empty");
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

    /// Renders as many samples as the power requires. After Stein (1945): a pilot run estimates the noise and
    /// from it the number of samples. They are drawn afresh, so that the pilot does not bias the result.
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

        // Without a known answer, the other estimators of the comparison are noisy as well.
        let others = (case.estimators().len() as f64 - 1.0).max(1.0);
        let share = if matches!(case.answer, Answer::Agreement) { 1.0 + 1.0 / others } else { 1.0 };
        let needed = |image: &Batches| {
            let (mean, error) = image.whole();
            let found = (critical + power_t(DOF)) * error / mean.abs().max(f64::MIN_POSITIVE);
            // More paths shorten a long tail.
            let blind = !image.series.last().is_some_and(|s| compare::noise_is_reliable(s));
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
            // The noise estimate improves with more samples; rare events may still increase it.
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

/// Independent random numbers for every case and estimator, whatever their positions in the registries, since
/// compared images must be independent. FNV-1a over both names.
fn seed(base: u64, case: &str, estimator: &str) -> u64 {
    let names = case.bytes().chain([0]).chain(estimator.bytes());
    names.fold(0xcbf2_9ce4_8422_2325 ^ base, |h, b| (h ^ u64::from(b)).wrapping_mul(0x0000_0100_0000_01b3))
}
