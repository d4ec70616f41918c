//! Statistics of the comparison, computed on a worker thread so that no frame waits for them.

use super::provenance::Provenance;
use crate::background::{Background, Reply};
use crate::model::{Pair, WindowDoc};
use majorant_core::compare::curve::{Point, PowerLaw};
use majorant_core::compare::{
    Agreement, Comparison, Estimate, Experiment, Reference, Standing, View, agreement,
};
use majorant_core::measure::{self, Measure, Region};

use majorant_core::session::{PixelSample, Probe};
use majorant_core::transport::CancelToken;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Minimum interval between two analyses.
const SHORTEST: Duration = Duration::from_millis(250);
/// Reciprocal of the share of a core that analyses may take, so that rendering keeps the rest.
const SHARE: u32 = 5;
/// Samples of the picked pixel that are retraced, per view and analysis.
const TRACED: u64 = 2048;
/// Maximum number of samples of a pixel that are kept, per view.
pub(super) const KEPT: u64 = 100_000;

/// Input of an analysis.
#[derive(Clone)]
pub struct Question {
    /// Provenance of the result.
    pub of: Provenance,
    /// The views with their snapshots.
    pub experiment: Experiment,
    /// Pixel whose samples are retraced.
    pub pixel: Option<PickedPixel>,
}

/// A pixel whose samples are retraced.
#[derive(Clone)]
pub struct PickedPixel {
    /// Column and row.
    pub at: [usize; 2],
    /// Tracers of the pixel's paths, with the index of their view.
    pub probes: Vec<(usize, Probe)>,
}

/// Error curve of a view.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Index of the view, from 0.
    pub view: usize,
    /// Points, by increasing sample count.
    pub points: Vec<Point>,
}

/// Samples of a pixel in a view.
#[derive(Clone, Debug)]
pub struct PixelSamples {
    /// Index of the view, from 0.
    pub view: usize,
    /// Samples, by index.
    pub samples: Arc<Vec<PixelSample>>,
}

/// Result of an analysis.
#[derive(Clone, Default)]
pub struct Analysis {
    /// Provenance of the numbers.
    pub of: Provenance,
    /// One row per view that has a snapshot.
    pub standings: Vec<Standing>,
    /// Error measure of `curves`.
    pub measure: Option<&'static Measure>,
    /// Error curves.
    pub curves: Vec<Curve>,
    /// Agreement of the two views of the pair.
    pub pair: Option<(Pair, Agreement)>,
    /// Samples of the picked pixel.
    pub pixel: Option<([usize; 2], Vec<PixelSamples>)>,
    /// Duration of the analysis, in seconds.
    pub seconds: f64,
}

impl Analysis {
    /// Row of the view with a label.
    #[must_use]
    pub fn standing(&self, label: &str) -> Option<&Standing> {
        self.standings.iter().find(|s| s.label == label)
    }
}

/// Worker that analyses the newest question.
pub struct AnalysisWorker(Background<Question, Arc<Analysis>>);

impl AnalysisWorker {
    /// Starts the thread; `repaint` requests a repaint of the window.
    ///
    /// # Errors
    /// Failure of the operating system to start a thread.
    pub fn new(repaint: impl Fn() + Send + Sync + 'static) -> std::io::Result<Self> {
        let memory = Mutex::new(Memory::default());
        let work = move |question: Question, reply: &Reply<'_, Question, Arc<Analysis>>| {
            let started = Instant::now();
            let mut memory = memory.lock().unwrap_or_else(PoisonError::into_inner);
            let mut analysis = memory.analyse(&question, reply.cancel());
            analysis.seconds = started.elapsed().as_secs_f64();
            reply.merge(Arc::new(analysis), |_, newer| newer);
        };
        let mut worker = Background::new("analysis", work).resting(|took| (took * SHARE).max(SHORTEST));
        worker.set_wake(repaint);
        worker.start()?;
        Ok(Self(worker))
    }

    /// Submits a question, which replaces any that is still waiting.
    pub fn ask(&self, question: Question) {
        self.0.inbox().replace(question);
    }

    /// Takes the newest analysis finished since the last call.
    pub fn take(&mut self) -> Option<Arc<Analysis>> {
        self.0.poll().pop()
    }
}

/// Results that are reused by the next analysis.
#[derive(Default)]
struct Memory {
    /// Curve points of each view, with their dependencies other than the checkpoint.
    curves: BTreeMap<usize, (CurveKey, Vec<Point>)>,
    /// The pixel of `traced`.
    pixel: Option<[usize; 2]>,
    /// Samples of the pixel, by view.
    traced: BTreeMap<usize, Traced>,
}

/// First samples of a pixel in one submission.
#[derive(Default)]
struct Traced {
    generation: u64,
    samples: Arc<Vec<PixelSample>>,
}

/// Dependencies of the existing points of a curve.
#[derive(Clone)]
struct CurveKey {
    generation: u64,
    measure: &'static str,
    region: Option<Region>,
    reference: Option<Arc<Reference>>,
}

impl CurveKey {
    /// Whether the points of both are the same, which requires the same fixed reference.
    fn fits(&self, other: &Self) -> bool {
        let same = |(a, b): (&Arc<Reference>, &Arc<Reference>)| Arc::ptr_eq(a, b);
        (self.generation, self.measure, self.region) == (other.generation, other.measure, other.region)
            && self.reference.as_ref().zip(other.reference.as_ref()).is_some_and(same)
    }
}

impl Memory {
    fn analyse(&mut self, question: &Question, cancel: CancelToken<'_>) -> Analysis {
        let experiment = &question.experiment;
        let compare = &experiment.doc.compare;
        let chosen = measure::find(&compare.measure.0);
        let comparisons = experiment.comparisons();
        // The relative MSE is in every table, in addition to the chosen measure.
        let mut measures: Vec<&'static Measure> = measure::find("relmse").into_iter().collect();
        measures.extend(chosen.filter(|m| m.id != "relmse"));
        let standings = experiment.rank_against(measures, &comparisons);
        let measured = |v: &View| standings.iter().any(|s| s.label == v.label && !s.errors.is_empty());
        let measured: Vec<bool> = experiment.views.iter().map(|(_, v)| measured(v)).collect();
        Analysis {
            of: question.of.clone(),
            curves: chosen.map(|m| self.curves(experiment, m, &comparisons, &measured)).unwrap_or_default(),
            standings,
            measure: chosen,
            pair: pair(experiment, WindowDoc::of(&experiment.doc).pair),
            pixel: question.pixel.as_ref().map(|p| (p.at, self.samples(p, experiment, cancel))),
            seconds: 0.0,
        }
    }

    /// Error curves. With an unchanged reference, only new checkpoints are measured.
    fn curves(
        &mut self,
        experiment: &Experiment,
        chosen: &'static Measure,
        comparisons: &[Comparison<'_>],
        measured: &[bool],
    ) -> Vec<Curve> {
        let mut curves = Vec::new();
        for (((number, view), (_, held)), measured) in experiment.views.iter().zip(comparisons).zip(measured)
        {
            let Some(held) = held.as_ref().filter(|_| *measured) else { continue };
            let key = CurveKey {
                generation: view.checkpoints.generation(),
                measure: chosen.id,
                region: experiment.region(),
                reference: experiment.reference.clone(),
            };
            let known = self.curves.remove(number).filter(|(k, _)| k.fits(&key));
            let mut points = known.map(|(_, points)| points).unwrap_or_default();
            for checkpoint in view.checkpoints.kept().iter().skip(points.len()) {
                points.extend(checkpoint.point(chosen, held, experiment.region()));
            }
            self.curves.insert(*number, (key, points.clone()));
            curves.push(Curve { view: *number, points });
        }
        curves
    }

    /// Retraces the next samples of the pixel, at most [`TRACED`] per view.
    fn samples(
        &mut self,
        picked: &PickedPixel,
        experiment: &Experiment,
        cancel: CancelToken<'_>,
    ) -> Vec<PixelSamples> {
        if self.pixel != Some(picked.at) {
            (self.pixel, self.traced) = (Some(picked.at), BTreeMap::new());
        }
        let at = (picked.at[0] as u32, picked.at[1] as u32);
        let mut all = Vec::new();
        for (number, probe) in &picked.probes {
            let Some((_, view)) = experiment.views.iter().find(|(n, _)| n == number) else { continue };
            let traced = self.traced.entry(*number).or_default();
            if traced.generation != view.snapshot.generation {
                *traced = Traced { generation: view.snapshot.generation, samples: Arc::default() };
            }
            let first = traced.samples.len() as u64;
            let last = view.snapshot.spp.min(first + TRACED).min(KEPT);
            if first < last {
                let more = probe.samples(at, first..last, cancel);
                Arc::make_mut(&mut traced.samples).extend(more);
            }
            all.push(PixelSamples { view: *number, samples: Arc::clone(&traced.samples) });
        }
        all
    }
}

fn pair(experiment: &Experiment, pair: Pair) -> Option<(Pair, Agreement)> {
    let find = |number: usize| experiment.views.iter().find(|(n, _)| *n == number).map(|(_, v)| v);
    let (a, b) = (find(pair.0)?, find(pair.1)?);
    if a.doc.render.seed == b.doc.render.seed || a.snapshot.target != b.snapshot.target {
        return None;
    }
    let whole = Region::whole(a.snapshot.width, a.snapshot.height);
    let region = experiment.region().unwrap_or(whole);
    let found = agreement(&Estimate::of(&a.snapshot)?, &Estimate::of(&b.snapshot)?, region)?;
    Some((pair, found))
}

/// Fits a power law to the last two thirds of an error curve, or to all of it if it has at most six points.
#[must_use]
pub fn settled_law(points: &[Point], axis: majorant_core::compare::curve::Axis) -> Option<PowerLaw> {
    let from = if points.len() > 6 { points.len() / 3 } else { 0 };
    PowerLaw::fit(points.get(from..)?, axis)
}
