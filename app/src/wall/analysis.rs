//! Computes the comparison's numbers on a thread of its own, so that no frame waits for them.

use super::provenance::Provenance;
use majorant_core::compare::curve::{Point, PowerLaw};
use majorant_core::compare::{
    Agreement, Estimate, Experiment, Opponent, Reference, Standing, View, agreement,
};
use majorant_core::measure::{self, Measure, Region};
use majorant_core::scene::Pair;
use majorant_core::session::{PixelSample, Probe};
use majorant_core::transport::CancelToken;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
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

#[derive(Default)]
struct Inbox {
    question: Option<Question>,
    closed: bool,
    done: Option<Arc<Analysis>>,
}

/// The thread that analyses. Dropping it stops and joins it.
pub struct AnalysisWorker {
    desk: Arc<(Mutex<Inbox>, Condvar)>,
    /// 0 while its paths are wanted: a single one may take for ever.
    closed: Arc<AtomicU64>,
    thread: Option<JoinHandle<()>>,
}

fn lock(desk: &(Mutex<Inbox>, Condvar)) -> MutexGuard<'_, Inbox> {
    // Every change leaves the desk consistent, so a poisoned lock is still good.
    desk.0.lock().unwrap_or_else(PoisonError::into_inner)
}

impl AnalysisWorker {
    /// Starts the thread; `repaint` wakes the window.
    ///
    /// # Errors
    /// When the operating system refuses a thread.
    pub fn new(repaint: impl Fn() + Send + 'static) -> std::io::Result<Self> {
        let desk = Arc::new((Mutex::new(Inbox::default()), Condvar::new()));
        let closed = Arc::new(AtomicU64::new(0));
        let (theirs, flag) = (Arc::clone(&desk), Arc::clone(&closed));
        let thread = std::thread::Builder::new()
            .name("majorant-analyst".into())
            .spawn(move || run(&theirs, CancelToken::new(&flag, 0), &repaint))?;
        Ok(Self { desk, closed, thread: Some(thread) })
    }

    /// Asks; the newest question counts.
    pub fn ask(&self, question: Question) {
        lock(&self.desk).question = Some(question);
        self.desk.1.notify_one();
    }

    /// The newest answer, if there is one that was not taken yet.
    #[must_use]
    pub fn take(&self) -> Option<Arc<Analysis>> {
        lock(&self.desk).done.take()
    }
}

impl Drop for AnalysisWorker {
    fn drop(&mut self) {
        self.closed.store(1, Ordering::Release);
        lock(&self.desk).closed = true;
        self.desk.1.notify_one();
        if let Some(thread) = self.thread.take() {
            // An analyst that panicked leaves its last numbers; there is nothing to add here.
            let _ = thread.join();
        }
    }
}

fn run(desk: &(Mutex<Inbox>, Condvar), cancel: CancelToken<'_>, repaint: &dyn Fn()) {
    let mut memory = Memory::default();
    let mut rested = Instant::now();
    loop {
        let mut at = lock(desk);
        let question = loop {
            if at.closed {
                return;
            }
            let left = rested.saturating_duration_since(Instant::now());
            if !left.is_zero() {
                at = desk.1.wait_timeout(at, left).unwrap_or_else(PoisonError::into_inner).0;
                continue;
            }
            match at.question.take() {
                Some(question) => break question,
                None => at = desk.1.wait(at).unwrap_or_else(PoisonError::into_inner),
            }
        };
        drop(at);
        let started = Instant::now();
        let mut analysis = memory.analyse(&question, cancel);
        analysis.seconds = started.elapsed().as_secs_f64();
        lock(desk).done = Some(Arc::new(analysis));
        rested = started + (started.elapsed() * SHARE).max(SHORTEST);
        repaint();
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
            pair: pair(experiment, compare.pair),
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
