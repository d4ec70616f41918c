//! Complete run of a comparison without a window.
//!
//! ```text
//!   SceneDoc with views ──► Session (fair turns, reference in the background) ──► Experiment
//! ```
//!
//! A rendered reference does not affect the cost of the views: CPU seconds are counted per view.

use super::curve::Checkpoints;
use super::experiment::{Experiment, View, label};
use super::fitness::{unfit_document, unfit_picture};
use super::open::{ReferenceError, open};
use super::reference::Reference;
use crate::estimator;
use crate::film::Snapshot;
use crate::io::Library;
use crate::scene::{Limits, ReferenceDoc, SceneDoc};
use crate::session::{Ending, Job, Role, Session, Status, ViewId, ViewState};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, sync_channel};

/// Minimum samples per pixel for a noise estimate.
pub const LEAST_SAMPLES: u64 = 3;

/// Reason why a comparison failed.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The document is invalid.
    #[error("{0}")]
    Invalid(crate::scene::Problem),
    /// A view has no limit.
    #[error("view {label} would never end: limit its samples or its CPU seconds")]
    Endless {
        /// Label of the view.
        label: String,
    },
    /// The rendered reference has no limit.
    #[error("the reference would never end: give `compare.reference` a limit, `spp` or `relative_error`")]
    EndlessReference,
    /// The rendered reference would be biased, or its noise would be unknown.
    #[error("the reference by {estimator} cannot be used: {reason}. Choose another estimator for it")]
    UnfitReference {
        /// Estimator id.
        estimator: String,
        /// Reason why it is unsuitable.
        reason: &'static str,
    },
    /// A view could not be rendered.
    #[error("view {label} ({estimator}): {message}")]
    Failed {
        /// Label of the view, or `reference`.
        label: String,
        /// Estimator id.
        estimator: String,
        /// Cause and remedy.
        message: String,
    },
    /// The reference cannot be used.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// The operating system refused a thread.
    #[error("no thread could be started: {0}. Close other programs, or try again.")]
    Thread(std::io::Error),
    /// The session ended unexpectedly.
    #[error("the renderer stopped unexpectedly: try again")]
    Stopped,
}

/// Progress of a comparison.
#[derive(Clone, Debug)]
pub struct Progress {
    /// Fraction of the total work, from 0 to 1.
    pub fraction: f64,
    /// Samples per pixel of every view, in order, followed by those of a rendered reference.
    pub spp: Vec<u64>,
}

/// A finished comparison.
#[derive(Clone, Debug)]
pub struct Finished {
    /// Views with their final images and checkpoints, and the reference.
    pub experiment: Experiment,
    /// Notices, such as repaired files and unverified references.
    pub notes: Vec<String>,
}

/// Renders every view of a document to its limit ([`SceneDoc::view_docs`]) and the reference to its own,
/// according to [`crate::scene::CompareDoc::fairness`]. Views that end with fewer than [`LEAST_SAMPLES`]
/// samples are extended to that number.
///
/// # Errors
/// When the document is invalid, a view cannot be rendered, or the reference is missing or shows a different
/// image.
pub fn run(
    doc: &SceneDoc,
    mut library: Library,
    mut progress: impl FnMut(&Progress),
) -> Result<Finished, RunError> {
    if let Some(problem) = estimator::validate(doc).into_iter().next() {
        return Err(RunError::Invalid(problem));
    }
    let docs: Vec<Arc<SceneDoc>> = doc.view_docs().into_iter().map(Arc::new).collect();
    if let Some(view) = docs.iter().position(|d| d.render.limits().are_none()) {
        return Err(RunError::Endless { label: label(view) });
    }
    let mut notes = Vec::new();
    let mut reference = match &doc.compare.reference {
        ReferenceDoc::File { file } => Some(open(file, doc, &mut library, &mut notes)?),
        _ => None,
    };
    let background = background(doc)?;

    let mut running = Running::start(doc, docs, background, library)?;
    let ended = running.wait(&mut progress)?;
    for state in &ended {
        let said = state.ending.and_then(Ending::warning).map(str::to_owned);
        let said = state.notices.iter().cloned().chain(said);
        notes.extend(said.filter(|n| !notes.contains(n)).collect::<Vec<_>>());
    }
    let snapshots: Vec<Arc<Snapshot>> = ended.into_iter().filter_map(|s| s.snapshot).collect();
    let views = running.ranked_views.iter().zip(&running.checkpoints).zip(&snapshots).enumerate();
    let views: Vec<(usize, View)> = views
        .map(|(i, ((doc, checkpoints), snapshot))| {
            let (doc, snapshot) = (Arc::clone(doc), Arc::clone(snapshot));
            (i, View { label: label(i), doc, snapshot, checkpoints: Arc::new(checkpoints.clone()) })
        })
        .collect();
    if let (Some(doc), Some(snapshot)) = (&running.background, snapshots.last()) {
        let name = estimator::find(&doc.estimator.id).map_or("", |e| e.name);
        let origin = format!("{name}, {} samples per pixel", snapshot.spp);
        reference = Some(Reference::of(snapshot, origin).with_seed(doc.render.seed));
    }
    if let ReferenceDoc::View { view } = doc.compare.reference {
        let promoted = views.get(view).map(|(_, v)| v);
        if let Some((v, why)) = promoted.and_then(|v| Some((v, unfit_picture(&v.doc, &v.snapshot)?))) {
            notes.push(format!(
                "view {} is the reference, but {why}: the bias of the other views is not tested",
                v.label
            ));
        }
        reference = promoted.map(|v| Reference::of(&v.snapshot, format!("view {}", v.label)));
    }
    let experiment = Experiment { doc: Arc::new(doc.clone()), views, reference: reference.map(Arc::new) };
    Ok(Finished { experiment, notes })
}

/// Document of a reference that has to be rendered, if there is one, after validation.
fn background(doc: &SceneDoc) -> Result<Option<Arc<SceneDoc>>, RunError> {
    let Some(reference) = reference_doc(doc) else { return Ok(None) };
    if reference.render.limits().are_none() {
        return Err(RunError::EndlessReference);
    }
    if let Some(reason) = unfit_document(&reference) {
        return Err(RunError::UnfitReference { estimator: reference.estimator.id, reason });
    }
    Ok(Some(Arc::new(reference)))
}

/// Document of a reference that has to be rendered, if there is one. Its seed differs from those of all
/// views, since correlated noise would look like agreement.
#[must_use]
pub fn reference_doc(doc: &SceneDoc) -> Option<SceneDoc> {
    let mut reference = doc.reference_doc()?;
    let taken =
        |seed: u64| (0..doc.view_count()).any(|v| doc.view_overrides(v).is_some_and(|c| c.seed == seed));
    while taken(reference.render.seed) {
        reference.render.seed += 1;
    }
    Some(reference)
}

/// A session that renders the views of a comparison.
struct Running {
    ranked_views: Vec<Arc<SceneDoc>>,
    background: Option<Arc<SceneDoc>>,
    checkpoints: Vec<Checkpoints>,
    /// Dropped before the session, whose `wake` would otherwise block forever.
    woken: Receiver<()>,
    session: Session,
}

impl Running {
    fn start(
        doc: &SceneDoc,
        ranked_views: Vec<Arc<SceneDoc>>,
        background: Option<Arc<SceneDoc>>,
        library: Library,
    ) -> Result<Self, RunError> {
        let (wake, woken) = sync_channel::<()>(0);
        // Two rendezvous per wake-up: the session continues only after its state has been read, so that every
        // image is seen and equal runs have equal checkpoints.
        let session = Session::new(library, move || {
            let _ = wake.send(()).and_then(|()| wake.send(()));
        })
        .map_err(RunError::Thread)?;
        session.set_fairness(doc.compare.fairness);
        let checkpoints = vec![Checkpoints::default(); ranked_views.len()];
        let running = Self { ranked_views, background, checkpoints, woken, session };
        for (id, (doc, role)) in running.jobs().enumerate() {
            let job = Job { doc: Arc::clone(doc), preview: false, role };
            running.session.submit(ViewId(id as u32), job);
        }
        Ok(running)
    }

    /// All jobs, views first.
    fn jobs(&self) -> impl Iterator<Item = (&Arc<SceneDoc>, Role)> {
        let views = self.ranked_views.iter().map(|doc| (doc, Role::View));
        views.chain(self.background.iter().map(|doc| (doc, Role::Background)))
    }

    /// Waits until every view has ended and returns their states.
    fn wait(&mut self, progress: &mut impl FnMut(&Progress)) -> Result<Vec<ViewState>, RunError> {
        let mut extended = false;
        loop {
            self.woken.recv().map_err(|_| RunError::Stopped)?;
            let states: Vec<ViewState> =
                (0..self.jobs().count()).map(|id| self.session.state(ViewId(id as u32))).collect();
            let mut fractions = Vec::new();
            for (id, ((doc, _), state)) in self.jobs().zip(&states).enumerate() {
                if let Status::Failed(message) = &state.status {
                    let label = if id < self.ranked_views.len() { label(id) } else { "reference".into() };
                    let (estimator, message) = (doc.estimator.id.clone(), message.clone());
                    return Err(RunError::Failed { label, estimator, message });
                }
                fractions.push(fraction(&doc.render.limits(), state));
            }
            for (checkpoints, state) in self.checkpoints.iter_mut().zip(&states) {
                if let Some(snapshot) = &state.snapshot {
                    checkpoints.observe(snapshot);
                }
            }
            progress(&Progress {
                fraction: fractions.iter().sum::<f64>() / fractions.len().max(1) as f64,
                spp: states.iter().map(|s| s.snapshot.as_ref().map_or(0, |s| s.spp)).collect(),
            });
            if states.iter().all(|s| s.status == Status::Finished) {
                let short = |s: &ViewState| s.snapshot.as_ref().is_none_or(|s| s.spp < LEAST_SAMPLES);
                if extended || !states.iter().any(short) {
                    return Ok(states);
                }
                for id in (0..states.len()).filter(|id| short(&states[*id])) {
                    self.session.set_limits(ViewId(id as u32), Limits::samples(LEAST_SAMPLES));
                }
                extended = true;
            }
            self.woken.recv().map_err(|_| RunError::Stopped)?;
        }
    }
}

/// Progress of a view towards the nearest of its limits.
fn fraction(limits: &Limits, state: &ViewState) -> f64 {
    let Some(snapshot) = &state.snapshot else { return 0.0 };
    if state.status == Status::Finished {
        return 1.0;
    }
    let of = |limit: Option<f32>, had: f64| limit.map_or(0.0, |limit| had / f64::from(limit));
    let by_samples = limits.spp.map_or(0.0, |spp| snapshot.spp as f64 / spp as f64);
    // Errors decrease with the square root of the samples.
    let by_error = limits.relative_error.map_or(0.0, |e| (f64::from(e) / snapshot.relative_error()).powi(2));
    let nearest = by_samples
        .max(of(limits.seconds, snapshot.seconds))
        .max(of(limits.cpu_seconds, snapshot.cpu_seconds))
        .max(by_error);
    nearest.clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::Verdict;
    use crate::compare::report::fixture;
    use crate::measure::MEASURES;
    use crate::scene::Fairness;

    #[test]
    fn unbiased_estimators_are_never_called_biased() {
        let mut decided = 0;
        for seed in 0..20 {
            let mut doc = fixture::doc("seeds");
            doc.compare.reference = ReferenceDoc::None;
            doc.compare.views.truncate(1);
            (doc.film.width, doc.film.height) = (32, 32);
            (doc.render.seed, doc.compare.views[0].seed) = (2 * seed, 2 * seed + 1);
            doc.render.spp = Some(24);
            let experiment = run(&doc, Library::default(), |_| {}).unwrap().experiment;
            for standing in experiment.rank(Vec::new()) {
                assert_ne!(standing.verdict(), Verdict::Differs, "seed {seed}: {standing:?}");
                decided += usize::from(standing.verdict() == Verdict::Agrees);
            }
        }
        assert!(decided >= 30, "{decided} of 40 are decided");
    }

    #[test]
    fn every_view_gets_its_samples_its_checkpoints_and_its_reference() {
        let mut last = 0.0;
        let finished = run(&fixture::doc("all"), Library::default(), |p| {
            assert!(p.spp.len() == 4 && (0.0..=1.0).contains(&p.fraction));
            last = p.fraction;
        });
        let experiment = finished.unwrap().experiment;
        assert_eq!(last, 1.0);
        assert_eq!(experiment.reference.as_ref().unwrap().estimate().noise.unwrap()[0].samples, 64);
        for (_, view) in &experiment.views {
            assert_eq!(view.snapshot.spp, 8);
            let spp: Vec<u64> = view.checkpoints.kept().iter().map(|c| c.spp).collect();
            assert!(spp.len() >= 3 && spp[0] == 1, "{spp:?}");
        }
        for standing in experiment.rank(MEASURES.iter().collect()) {
            assert_eq!(standing.efficiency, 1.0 / (standing.variance * standing.cpu_seconds));
            assert_eq!(standing.errors.len(), MEASURES.len());
        }
    }

    #[test]
    fn errors_need_a_reference_and_verdicts_do_not() {
        let mut doc = fixture::doc("none");
        for (reference, measured) in [(ReferenceDoc::None, false), (ReferenceDoc::Pooled, true)] {
            doc.compare.reference = reference;
            let experiment = run(&doc, Library::default(), |_| {}).unwrap().experiment;
            let standings = experiment.rank(MEASURES.iter().collect());
            assert!(standings.iter().all(|s| s.agreement.is_some()));
            assert_eq!(standings.iter().any(|s| !s.errors.is_empty()), measured);
            let curves = (0..3).filter(|view| !experiment.curve(*view, &MEASURES[0]).is_empty());
            assert_eq!(curves.count() > 0, measured);
        }
    }

    #[test]
    fn a_rendered_reference_has_random_numbers_that_no_view_has() {
        let mut doc = fixture::doc("seeds");
        let usual = reference_doc(&doc).unwrap().render.seed;
        assert_eq!(doc.reference_doc().unwrap().render.seed, usual);
        (doc.compare.views[0].seed, doc.compare.views[1].seed) = (usual, usual + 1);
        assert_eq!(reference_doc(&doc).unwrap().render.seed, usual + 2);
        doc.compare.reference = ReferenceDoc::None;
        assert_eq!(reference_doc(&doc), None);
    }

    #[test]
    fn a_view_can_be_the_reference_and_no_time_is_too_short() {
        let mut doc = fixture::doc("short");
        doc.compare.reference = ReferenceDoc::View { view: 1 };
        doc.compare.fairness = Fairness::Lookups;
        doc.render.set_limits(Limits { cpu_seconds: Some(1e-6), ..Limits::default() });
        let experiment = run(&doc, Library::default(), |_| {}).unwrap().experiment;
        let standings = experiment.rank(Vec::new());
        assert_eq!(standings.len(), 3);
        assert!(standings.iter().all(|s| s.spp == LEAST_SAMPLES));
        assert!(standings[1].agreement.is_none() && standings[0].agreement.is_some());
    }

    #[test]
    fn what_cannot_end_is_refused() {
        let refused = |edit: fn(&mut SceneDoc)| {
            let mut doc = fixture::doc("refused");
            edit(&mut doc);
            run(&doc, Library::default(), |_| {}).unwrap_err().to_string()
        };
        assert!(refused(|d| d.render.set_limits(Limits::default())).contains("view A"));
        assert!(refused(|d| d.compare.views[0].estimator.id = "magic".into()).contains("magic"));
        let endless = refused(|d| {
            d.compare.reference =
                ReferenceDoc::Render { estimator: "nee".into(), spp: None, relative_error: None };
        });
        assert!(endless.contains("compare.reference"), "{endless}");
        let glowing = refused(|d| {
            d.medium_mut().emission = Some(crate::scene::EmissionDoc::default());
            d.compare.reference = ReferenceDoc::Render {
                estimator: "mitsuba2-volpath".into(),
                spp: Some(8),
                relative_error: None,
            };
        });
        assert!(glowing.contains("mitsuba2-volpath") && glowing.contains("light from within"), "{glowing}");
        let file = "no-such-volume.vdb";
        let unread = refused(|d| {
            d.medium_mut().density = crate::scene::DensityDoc::Grid(crate::scene::GridRef {
                file: "no-such-volume.vdb".into(),
                grid: None,
            })
        });
        assert!(unread.contains("view A") && unread.contains(file), "{unread}");
    }
}
