//! Edits of a comparison, as pure functions of the document.

use super::window::{Arrangement, Layer, Pair, WindowDoc};
use majorant_core::scene::{
    Fairness, Fault, MAX_VIEWS, MeasureId, ReferenceDoc, SceneDoc, ViewOverrides, WhenExceeded,
};

/// Edit of a comparison. Views count from 0.
#[derive(Clone, Debug, PartialEq)]
pub enum WallEdit {
    /// Sets the number of views. New views take estimators that are not shown yet; the last views are
    /// removed.
    Count(usize),
    /// Adds a copy of this view.
    Duplicate(usize),
    /// Adds a view with the method of this document.
    AddView(Box<SceneDoc>),
    /// Adds two correct views to compare this one with: its settings without faults, by Uni+NEE MIS and by
    /// NEE.
    CompareWithCorrect(usize),
    /// Removes this view, unless it is the only one.
    Remove(usize),
    /// Swaps two views.
    Swap(usize, usize),
    /// Sets the arrangement of the views.
    Arrange(Arrangement),
    /// Sets the two views of a wipe or a difference.
    Pair(Pair),
    /// Sets the displayed layer, by its id.
    Layer(String),
    /// Sets the quantity that all views receive equally.
    Fairness(Fairness),
    /// Sets the reference of the errors.
    Reference(ReferenceDoc),
    /// Sets the view that speed-ups are relative to.
    Baseline(usize),
    /// Sets the error measure, by its id.
    Measure(String),
    /// Sets the region for statistics: x0, y0, x1, y1 in pixels, half open.
    Region(Option<[u32; 4]>),
    /// Sets whether a view has a separate camera.
    OwnCamera(usize, bool),
    /// Sets whether a view has separate display settings.
    OwnDisplay(usize, bool),
    /// Sets whether every view has a separate zoom.
    OwnZoom(bool),
}

/// Returns the document after an edit; an invalid edit changes nothing.
#[must_use]
pub fn edited(doc: &SceneDoc, edit: &WallEdit) -> SceneDoc {
    let mut doc = doc.clone();
    let count = doc.view_count();
    match edit {
        WallEdit::Count(wanted) => {
            let wanted = (*wanted).clamp(1, MAX_VIEWS);
            while doc.view_count() < wanted {
                let next = next_view(&doc);
                doc.compare.views.push(next);
            }
            doc.compare.views.truncate(wanted - 1);
        }
        WallEdit::AddView(method) if count < MAX_VIEWS => {
            if let Some(next) = method.view_overrides(0) {
                let seed = doc.free_seed();
                doc.compare.views.push(ViewOverrides { seed, ..next });
            }
        }
        WallEdit::CompareWithCorrect(view) => {
            let Some(mut right) = doc.view_overrides(*view) else { return doc };
            let usual = SceneDoc::default();
            right.estimator.fault = Fault::None;
            right.estimator.transmittance.clone_from(&usual.estimator.transmittance);
            (right.majorant.factor, right.majorant.when_exceeded) = (1.0, WhenExceeded::Weighted);
            for id in ["uni-nee-mis", "nee"].into_iter().take(MAX_VIEWS - count) {
                let mut next = ViewOverrides { seed: doc.free_seed(), ..right.clone() };
                id.clone_into(&mut next.estimator.id);
                doc.compare.views.push(next);
            }
            WindowDoc::edit(&mut doc, |w| (w.arrangement, w.pair) = (Arrangement::Grid, Pair(*view, count)));
        }
        WallEdit::Duplicate(view) if count < MAX_VIEWS => {
            if let Some(copy) = doc.view_overrides(*view) {
                let seed = doc.free_seed();
                doc.compare.views.insert(*view, ViewOverrides { seed, ..copy });
                follow(&mut doc, |at| if at > *view { at + 1 } else { at });
            }
        }
        WallEdit::Remove(view) if count > 1 && *view < count => remove(&mut doc, *view),
        WallEdit::Swap(a, b) if a != b && *a < count && *b < count => swap(&mut doc, *a, *b),
        WallEdit::Duplicate(_) | WallEdit::AddView(_) | WallEdit::Remove(_) | WallEdit::Swap(..) => {}
        WallEdit::Arrange(arrangement) => WindowDoc::edit(&mut doc, |w| w.arrangement = *arrangement),
        WallEdit::Pair(pair) => WindowDoc::edit(&mut doc, |w| w.pair = *pair),
        WallEdit::Layer(id) => WindowDoc::edit(&mut doc, |w| w.layer = Layer(id.clone())),
        WallEdit::Fairness(fairness) => doc.compare.fairness = *fairness,
        WallEdit::Reference(reference) => doc.compare.reference = reference.clone(),
        WallEdit::Baseline(view) => doc.compare.baseline = *view,
        WallEdit::Measure(id) => doc.compare.measure = MeasureId(id.clone()),
        WallEdit::Region(region) => doc.compare.region = *region,
        WallEdit::OwnZoom(own) => WindowDoc::edit(&mut doc, |w| w.own_zoom = *own),
        WallEdit::OwnCamera(view, own) => {
            let camera = own.then(|| doc.camera.clone());
            if let Some(view_overrides) = view.checked_sub(1).and_then(|i| doc.compare.views.get_mut(i)) {
                view_overrides.camera = camera;
            }
        }
        WallEdit::OwnDisplay(view, own) => {
            let display = own.then(|| doc.view.clone());
            if let Some(view_overrides) = view.checked_sub(1).and_then(|i| doc.compare.views.get_mut(i)) {
                view_overrides.view = display;
            }
        }
    }
    keep_in_range(&mut doc);
    doc
}

/// Creates a further view with a new seed and the first unused estimator, or else that of view A.
fn next_view(doc: &SceneDoc) -> ViewOverrides {
    let taken: Vec<String> =
        (0..doc.view_count()).filter_map(|v| doc.view_overrides(v)).map(|c| c.estimator.id).collect();
    let mut next = doc.view_overrides(0).unwrap_or_default();
    let free = majorant_core::estimator::REGISTRY.iter().find(|e| !taken.iter().any(|id| id == e.id));
    if let Some(entry) = free {
        entry.id.clone_into(&mut next.estimator.id);
    }
    next.seed = doc.free_seed();
    next
}

/// Makes the settings of a contender those of view A.
fn become_first(doc: &mut SceneDoc, first: ViewOverrides) {
    doc.set_majorants(&first);
    doc.estimator = first.estimator;
    doc.render.seed = first.seed;
    if let Some(camera) = first.camera {
        doc.camera = camera;
    }
    if let Some(view) = first.view {
        doc.view = view;
    }
}

fn remove(doc: &mut SceneDoc, view: usize) {
    if view == 0 {
        let first = doc.compare.views.remove(0);
        become_first(doc, first);
    } else {
        doc.compare.views.remove(view - 1);
    }
    if doc.compare.reference == (ReferenceDoc::View { view }) {
        doc.compare.reference = ReferenceDoc::None;
    }
    follow(doc, |at| if at > view { at - 1 } else { at });
}

/// Maps all references to views to their new indices.
fn follow(doc: &mut SceneDoc, moved: impl Fn(usize) -> usize) {
    if let ReferenceDoc::View { view } = &mut doc.compare.reference {
        *view = moved(*view);
    }
    doc.compare.baseline = moved(doc.compare.baseline);
    WindowDoc::edit(doc, |w| w.pair = Pair(moved(w.pair.0), moved(w.pair.1)));
}

fn swap(doc: &mut SceneDoc, a: usize, b: usize) {
    let (a, b) = (a.min(b), a.max(b));
    if a > 0 {
        doc.compare.views.swap(a - 1, b - 1);
    } else if let Some(first) = doc.view_overrides(0) {
        // A separate camera would become that of the scene: views are swapped, cameras are not.
        let second = std::mem::replace(&mut doc.compare.views[b - 1], first);
        let (camera, view) = (second.camera.clone(), second.view.clone());
        become_first(doc, ViewOverrides { camera: None, view: None, ..second });
        (doc.compare.views[b - 1].camera, doc.compare.views[b - 1].view) = (camera, view);
    }
}

/// Resets references to views that no longer exist.
fn keep_in_range(doc: &mut SceneDoc) {
    let count = doc.view_count();
    let compare = &mut doc.compare;
    compare.baseline = compare.baseline.min(count - 1);
    if matches!(compare.reference, ReferenceDoc::View { view } if view >= count) {
        compare.reference = ReferenceDoc::None;
    }
    WindowDoc::edit(doc, |w| {
        let Pair(a, b) = w.pair;
        if a >= count || b >= count || a == b {
            w.pair = Pair::default();
        }
        if count == 1 {
            w.arrangement = Arrangement::Grid;
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use majorant_core::estimator::validate;

    fn ids(doc: &SceneDoc) -> Vec<String> {
        (0..doc.view_count()).filter_map(|v| doc.view_overrides(v)).map(|c| c.estimator.id).collect()
    }

    fn after(doc: &SceneDoc, edits: &[WallEdit]) -> SceneDoc {
        let doc = edits.iter().fold(doc.clone(), |doc, edit| edited(&doc, edit));
        assert_eq!(validate(&doc), [], "{edits:?}");
        doc
    }

    #[test]
    fn new_views_show_what_is_not_shown_yet_with_seeds_of_their_own() {
        let doc = after(&SceneDoc::default(), &[WallEdit::Count(4)]);
        assert_eq!(ids(&doc), ["uni-nee-mis", "independent", "spectral-mis", "nee"]);
        let mut seeds: Vec<u64> = doc.view_docs().iter().map(|d| d.render.seed).collect();
        seeds.dedup();
        assert_eq!(seeds.len(), 4);
        assert_eq!(after(&doc, &[WallEdit::Count(1)]), SceneDoc::default());
        assert_eq!(after(&doc, &[WallEdit::Count(99)]).view_count(), MAX_VIEWS);
    }

    #[test]
    fn views_are_removed_swapped_and_copied_and_what_points_at_them_follows() {
        let doc = after(
            &SceneDoc::default(),
            &[
                WallEdit::Count(3),
                WallEdit::Baseline(2),
                WallEdit::Reference(ReferenceDoc::View { view: 2 }),
                WallEdit::Pair(Pair(1, 2)),
            ],
        );
        let removed = after(&doc, &[WallEdit::Remove(0)]);
        assert_eq!(ids(&removed), ["independent", "spectral-mis"]);
        assert_eq!((removed.compare.baseline, WindowDoc::of(&removed).pair), (1, Pair(0, 1)));
        assert_eq!(removed.compare.reference, ReferenceDoc::View { view: 1 });
        let gone = after(&doc, &[WallEdit::Remove(2)]);
        assert_eq!((gone.compare.baseline, &gone.compare.reference), (1, &ReferenceDoc::None));
        let swapped = after(&doc, &[WallEdit::Swap(0, 2)]);
        assert_eq!(ids(&swapped), ["spectral-mis", "independent", "uni-nee-mis"]);
        assert_eq!(after(&swapped, &[WallEdit::Swap(2, 0)]), doc);
        let copied = after(&doc, &[WallEdit::Duplicate(1)]);
        assert_eq!((copied.compare.baseline, WindowDoc::of(&copied).pair), (3, Pair(1, 3)));
        assert_eq!(ids(&copied), ["uni-nee-mis", "independent", "independent", "spectral-mis"]);
        assert_eq!(copied.view_doc(2).map(|d| d.render.seed), Some(3));
        let only = SceneDoc::default();
        assert_eq!(after(&only, &[WallEdit::Remove(0), WallEdit::Swap(0, 5)]), only);
    }
}
