//! Assignment of session views to views of the document, by comparison of documents.

use crate::model::Stats;
use crate::model::{Work, work_after};
use majorant_core::compare::curve::Checkpoints;
use majorant_core::film::Snapshot;
use majorant_core::scene::{MediumDoc, SceneDoc};
use majorant_core::session::{Job, Probe, Role, Session, Status, ViewId, ViewState};
use std::sync::Arc;

/// A view of the document and its state in the session.
pub struct Slot {
    /// Id in the session.
    pub id: ViewId,
    /// Last submitted document, before file names were resolved.
    submitted: Option<SceneDoc>,
    /// Last submitted document, with resolved file names.
    pub rendered: Arc<SceneDoc>,
    /// State in the session at the last update.
    pub state: ViewState,
    /// Document of `state.scene` and `state.notices`.
    built: Option<Arc<SceneDoc>>,
    /// Relative error of a snapshot.
    measured: Option<(Arc<Snapshot>, f64)>,
    /// Rates and estimates derived from the state.
    pub stats: Stats,
    /// Early snapshots, for error curves.
    pub checkpoints: Checkpoints,
}

impl Slot {
    /// Creates an empty view that is paused if the session's other views are `paused`.
    pub fn paused(id: ViewId, session: &Session, paused: bool) -> Self {
        session.set_paused(id, paused);
        Self::new(id, session)
    }

    /// Creates an empty view.
    pub fn new(id: ViewId, session: &Session) -> Self {
        Self {
            id,
            submitted: None,
            rendered: Arc::new(SceneDoc::default()),
            state: session.state(id),
            built: None,
            measured: None,
            stats: Stats::default(),
            checkpoints: Checkpoints::default(),
        }
    }

    /// Work needed to show the document `wanted`.
    fn work(&self, wanted: &SceneDoc) -> Work {
        self.submitted.as_ref().map_or(Work::Render, |before| work_after(before, wanted))
    }

    /// Submits the changes to the session.
    pub fn submit(
        &mut self,
        wanted: &SceneDoc,
        resolved: impl Fn(&SceneDoc) -> SceneDoc,
        role: Role,
        session: &Session,
    ) {
        match self.work(wanted) {
            // The image is unchanged; display settings and names may differ.
            Work::None => self.rendered = Arc::new(resolved(wanted)),
            Work::Limits => {
                self.rendered = Arc::new(resolved(wanted));
                session.set_limits(self.id, wanted.render.limits());
            }
            Work::Render => {
                self.rendered = Arc::new(resolved(wanted));
                let preview = role == Role::View;
                session.submit(self.id, Job { doc: Arc::clone(&self.rendered), preview, role });
            }
        }
        self.submitted = Some(wanted.clone());
        // The state of the previous submission must not be attributed to this one.
        self.update(session);
    }

    /// Newest snapshot of the last submission; `None` if only an older submission has one.
    #[must_use]
    pub fn picture(&self) -> Option<&Arc<Snapshot>> {
        self.state.snapshot.as_ref().filter(|s| s.generation == self.state.generation)
    }

    /// Tracer of single paths of the current submission; `None` until its scene is built.
    #[must_use]
    pub fn probe(&self) -> Option<&Probe> {
        self.state.probe.as_ref().filter(|_| self.state.built == self.state.generation)
    }

    /// Whether rendering has not finished or failed; a paused view is unfinished.
    #[must_use]
    pub fn is_unfinished(&self) -> bool {
        matches!(self.state.status, Status::Building | Status::Rendering | Status::Paused)
    }

    /// Restarts the view at the next submission, even if nothing changed.
    pub fn forget(&mut self) {
        self.submitted = None;
    }

    /// Updates state, statistics and checkpoints from the session.
    pub fn update(&mut self, session: &Session) {
        self.state = session.state(self.id);
        if self.state.built == self.state.generation {
            self.built = Some(Arc::clone(&self.rendered));
        } else if self.built.as_ref().is_none_or(|built| !same_files(built, &self.rendered)) {
            (self.state.scene, self.state.notices) = (None, Vec::new());
        }
        let Some(render) = self.submitted.as_ref().map(|doc| &doc.render) else {
            self.stats = Stats::default();
            return;
        };
        let snapshot = self.picture().cloned();
        // Takes milliseconds: computed once per snapshot, and only if the error is a limit.
        let error =
            snapshot.as_ref().filter(|_| render.relative_error.is_some()).map(|s| match &self.measured {
                Some((of, error)) if Arc::ptr_eq(of, s) => (Arc::clone(s), *error),
                _ => (Arc::clone(s), s.relative_error()),
            });
        self.stats = Stats::new(&self.state, render, error.as_ref().map(|(_, error)| *error));
        self.measured = error;
        if let Some(snapshot) = snapshot {
            self.checkpoints.observe(&snapshot);
        }
    }
}

/// Whether scene information and notices of one document describe the other: they depend on the files read.
fn same_files(a: &SceneDoc, b: &SceneDoc) -> bool {
    let of_medium = |(a, b): (&MediumDoc, &MediumDoc)| {
        a.enabled == b.enabled && a.density == b.density && a.phase == b.phase
    };
    a.media.len() == b.media.len()
        && a.media.iter().zip(&b.media).all(of_medium)
        && a.lights.len() == b.lights.len()
}

/// Assigns slots to the documents `wanted`, so that only changed views are restarted when views are moved,
/// removed or copied. `fresh` creates an empty slot. Returns the assigned slots and the unused ones.
pub fn assign(
    old: Vec<Slot>,
    wanted: &[SceneDoc],
    mut fresh: impl FnMut() -> Slot,
) -> (Vec<Slot>, Vec<Slot>) {
    let mut old: Vec<Option<Slot>> = old.into_iter().map(Some).collect();
    let mut found: Vec<Option<Slot>> = wanted.iter().map(|_| None).collect();
    let fits =
        |slot: &Option<Slot>, doc: &SceneDoc| slot.as_ref().is_some_and(|s| s.work(doc) != Work::Render);
    // Unchanged positions first, then moved views, then any free slot.
    for (i, doc) in wanted.iter().enumerate() {
        if let Some(slot) = old.get_mut(i).filter(|slot| fits(slot, doc)) {
            found[i] = slot.take();
        }
    }
    for (i, doc) in wanted.iter().enumerate().filter(|(i, _)| found[*i].is_none()).collect::<Vec<_>>() {
        if let Some(slot) = old.iter_mut().find(|slot| fits(slot, doc)) {
            found[i] = slot.take();
        }
    }
    for (i, place) in found.iter_mut().enumerate() {
        if place.is_none() {
            let same = old.get_mut(i).and_then(Option::take);
            *place = same.or_else(|| old.iter_mut().find_map(Option::take)).or_else(|| Some(fresh()));
        }
    }
    (found.into_iter().flatten().collect(), old.into_iter().flatten().collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use majorant_core::io::Library;

    fn doc(seed: u64) -> SceneDoc {
        let mut doc = SceneDoc::default();
        (doc.film.width, doc.film.height) = (2, 2);
        doc.render.seed = seed;
        doc.render.spp = Some(1);
        doc
    }

    #[test]
    fn views_that_moved_go_on_and_only_what_changed_starts_over() {
        let session = Session::new(Library::default(), || {}).expect("threads");
        let mut next = 0;
        let mut assigned = |old: Vec<Slot>, seeds: &[u64]| {
            let wanted: Vec<SceneDoc> = seeds.iter().map(|s| doc(*s)).collect();
            let (mut slots, left) = assign(old, &wanted, || {
                next += 1;
                Slot::new(ViewId(next), &session)
            });
            for (slot, doc) in slots.iter_mut().zip(&wanted) {
                slot.submit(doc, SceneDoc::clone, Role::View, &session);
            }
            (slots, left)
        };
        let ids = |slots: &[Slot]| slots.iter().map(|s| s.id.0).collect::<Vec<_>>();
        let (slots, left) = assigned(Vec::new(), &[10, 11, 12]);
        assert_eq!((ids(&slots), ids(&left)), (vec![1, 2, 3], vec![]));
        // Swapped.
        let (slots, left) = assigned(slots, &[12, 11, 10]);
        assert_eq!((ids(&slots), ids(&left)), (vec![3, 2, 1], vec![]));
        // The first was removed.
        let (slots, left) = assigned(slots, &[11, 10]);
        assert_eq!((ids(&slots), ids(&left)), (vec![2, 1], vec![3]));
        // One was edited and one was added.
        let (slots, left) = assigned(slots, &[11, 13, 14]);
        assert_eq!((ids(&slots), ids(&left)), (vec![2, 1, 4], vec![]));
    }
}
