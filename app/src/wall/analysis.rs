//! Computes the comparison's numbers on a thread of its own, so that no frame waits for them.

use super::provenance::Provenance;
use crate::background::{Background, Reply};
use crate::model::{Pair, WindowDoc};
use majorant_core::compare::curve::{Point, PowerLaw};
use majorant_core::compare::{
    Agreement, Estimate, Experiment, Opponent, Reference, Standing, View, agreement,
};
use majorant_core::measure::{self, Measure, Region};

use majorant_core::session::{PixelSample, Probe};
use majorant_core::transport::CancelToken;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Shortest time between two analyses.
const SHORTEST: Duration = Duration::from_millis(250);
/// Analysing may take this share of a core, so that rendering keeps the rest.
const SHARE: u32 = 5;
/// Samples of a pixel that are traced again, per view and analysis.
const TRACED: u64 = 2048;
/// The most samples of a pixel that are kept.
pub(super) const KEPT: u64 = 100_000;

/// What shall be analysed.
#[derive(Clone)]
pub struct Question {
    /// What the answer is of.
    pub of: Provenance,
    /// The views with their pictures.
    pub experiment: Experiment,
    /// A pixel whose samples are wanted.
    pub pixel: Option<PickedPixel>,
}

/// A pixel whose samples are wanted.
#[derive(Clone)]
pub struct PickedPixel {
    /// Column and row.
    pub at: [usize; 2],
    /// What traces its paths in every view, by the view's number.
    pub probes: Vec<(usize, Probe)>,
}

/// The error curve of a view.
#[derive(Clone, Debug)]
pub struct Curve {
    /// The view, from 0.
    pub view: usize,
    /// Its points.
    pub points: Vec<Point>,
}

/// The samples of a pixel in a view, in the order of their numbers.
#[derive(Clone, Debug)]
pub struct PixelSamples {
    /// The view, from 0.
    pub view: usize,
    /// The samples.
    pub samples: Arc<Vec<PixelSample>>,
}

/// What came of it.
#[derive(Clone, Default)]
pub struct Analysis {
    /// What it is of.
    pub of: Provenance,
    /// One line per view that has a picture.
    pub standings: Vec<Standing>,
    /// The measure of `curves`.
    pub measure: Option<&'static Measure>,
    /// Error curves.
    pub curves: Vec<Curve>,
    /// Whether the two views of the pair agree.
    pub pair: Option<(Pair, Agreement)>,
    /// The samples of the picked pixel.
    pub pixel: Option<([usize; 2], Vec<PixelSamples>)>,
    /// How long it took.
    pub seconds: f64,
}

impl Analysis {
    /// The line of a view.
    #[must_use]
    pub fn standing(&self, label: &str) -> Option<&Standing> {
        self.standings.iter().find(|s| s.label == label)
    }
}

/// The worker that analyses the newest question.
pub struct AnalysisWorker(Background<Question, Arc<Analysis>>);

impl AnalysisWorker {
    /// Starts the thread; `repaint` wakes the window.
    ///
    /// # Errors
    /// When the operating system refuses a thread.
    pub fn new(repaint: impl Fn() + Send + Sync + 'static) -> std::io::Result<Self> {
        let memory = Mutex::new(Memory::default());
        let work = move |question: Question, reply: &Reply<'_, Question, Arc<Analysis>>| {
            let started = Instant::now();
            let mut memory = memory.lock().unwrap_or_else(PoisonError::into_inner);
            let mut analysis = memory.analyse(&question, reply.cancel());
            analysis.seconds = started.elapsed().as_secs_f64();
            reply.merge(Arc::new(analysis), |_, newer| newer);
        };
        let mut worker = Background::new("analysis", work)
            .resting(|took| (took * (SHARE - 1)).max(SHORTEST.saturating_sub(took)));
        worker.set_wake(repaint);
        worker.start()?;
        Ok(Self(worker))
    }

    /// Asks; the newest question counts.
    pub fn ask(&self, question: Question) {
        self.0.inbox().replace(question);
    }

    /// The newest answer, if there is one that was not taken yet.
    pub fn take(&mut self) -> Option<Arc<Analysis>> {
        self.0.poll().pop()
    }
}

/// What is kept from one analysis to the next.
#[derive(Default)]
struct Memory {
    /// Points of curves, by view, with all that they depend on but the checkpoint.
    curves: BTreeMap<usize, (CurveKey, Vec<Point>)>,
    /// Which pixel `traced` belongs to.
    pixel: Option<[usize; 2]>,
    /// Samples of the pixel, by view.
    traced: BTreeMap<usize, Traced>,
}

/// The first samples of a pixel in one submission.
#[derive(Default)]
struct Traced {
    generation: u64,
    samples: Arc<Vec<PixelSample>>,
}

/// What the early points of a curve depend on.
#[derive(Clone)]
struct CurveKey {
    generation: u64,
    measure: &'static str,
    region: Option<Region>,
    reference: Option<Arc<Reference>>,
}

impl CurveKey {
    /// Whether points of the one are points of the other: only against a reference that stands.
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
        let opponents = experiment.opponents();
        // The relative error is in every table, whatever the curves show.
        let mut measures: Vec<&'static Measure> = measure::find("relmse").into_iter().collect();
        measures.extend(chosen.filter(|m| m.id != "relmse"));
        let standings = experiment.rank_against(measures, &opponents);
        let measured = |v: &View| standings.iter().any(|s| s.label == v.label && !s.errors.is_empty());
        let measured: Vec<bool> = experiment.views.iter().map(|(_, v)| measured(v)).collect();
        Analysis {
            of: question.of.clone(),
            curves: chosen.map(|m| self.curves(experiment, m, &opponents, &measured)).unwrap_or_default(),
            standings,
            measure: chosen,
            pair: pair(experiment, WindowDoc::of(&experiment.doc).pair),
            pixel: question.pixel.as_ref().map(|p| (p.at, self.samples(p, experiment, cancel))),
            seconds: 0.0,
        }
    }

    /// Points that stay are not measured again: against a reference that stands, only new checkpoints are.
    fn curves(
        &mut self,
        experiment: &Experiment,
        chosen: &'static Measure,
        opponents: &[Opponent<'_>],
        measured: &[bool],
    ) -> Vec<Curve> {
        let mut curves = Vec::new();
        for (((number, view), (_, held)), measured) in experiment.views.iter().zip(opponents).zip(measured) {
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

    /// Traces the pixel's samples again, some at a time.
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

/// The line through an error curve's later half, where it has settled.
#[must_use]
pub fn settled_law(points: &[Point], axis: majorant_core::compare::curve::Axis) -> Option<PowerLaw> {
    let from = if points.len() > 6 { points.len() / 3 } else { 0 };
    PowerLaw::fit(points.get(from..)?, axis)
}
