//! State of the comparison between frames.

mod pictures;

pub use pictures::UploadedImage;

use super::analysis::{Analysis, AnalysisWorker, KEPT, PickedPixel, Question};
use super::provenance::Provenance;
use super::reference::{ReferenceRenders, ReferenceState};
use super::slot::{Slot, assign};
use crate::model::{Arrangement, Layer, WindowDoc};
use crate::view::image_view::ImageView;
use crate::view::tone_mapper::{Order, OrderedView, PictureId, ViewImage};
use egui::Context;
use majorant_core::compare::maps;
use majorant_core::compare::{Experiment, Reference, View, label};
use majorant_core::film::Snapshot;
use majorant_core::scene::{ReferenceDoc, SceneDoc, ViewDoc};
use majorant_core::session::{Role, Session, ViewId};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Action of a left drag on an image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Orbits the camera.
    #[default]
    Camera,
    /// Draws the box to which statistics are restricted.
    Region,
}

/// Views of the document with their textures and statistics.
pub struct Wall {
    slots: Vec<Slot>,
    next_id: u32,
    /// Last submitted document.
    doc: Arc<SceneDoc>,
    /// Whether the next submission restarts all views.
    forgotten: bool,
    selected: usize,
    reference: ReferenceRenders,
    analysis_worker: AnalysisWorker,
    newest: Arc<Analysis>,
    /// Numbers of `newest` that are valid for the images shown.
    analysis: Arc<Analysis>,
    /// Whether views and reference are paused.
    paused: bool,
    /// Inputs of the last requested analysis.
    asked: Option<Asked>,
    uploaded: BTreeMap<PictureId, UploadedImage>,
    zoom: ImageView,
    own_zoom: BTreeMap<PictureId, ImageView>,
    /// Position of the divider, as a fraction of the width.
    pub split: f32,
    /// Index of the image shown one at a time.
    pub flipped: usize,
    /// Action of a left drag.
    pub tool: Tool,
    /// Picked pixel, column and row.
    pub picked: Option<[usize; 2]>,
    /// Depth of the majorant slice drawn over the views, from 0 to 1; `None` for no slice.
    pub majorant_slice: Option<f32>,
    /// Index of the medium whose cells the slice shows.
    pub medium: usize,
}

/// Inputs of an analysis.
struct Asked {
    doc: Arc<SceneDoc>,
    snapshots: Vec<Arc<Snapshot>>,
    reference: Option<Arc<Reference>>,
    picked: Option<[usize; 2]>,
}

impl Asked {
    fn is_like(&self, other: &Self) -> bool {
        let place = |all: &[Arc<Snapshot>]| all.iter().map(Arc::as_ptr).collect::<Vec<_>>();
        Arc::ptr_eq(&self.doc, &other.doc)
            && place(&self.snapshots) == place(&other.snapshots)
            && self.reference.as_ref().map(Arc::as_ptr) == other.reference.as_ref().map(Arc::as_ptr)
            && self.picked == other.picked
    }
}

impl Wall {
    /// Creates an empty comparison; `repaint` requests a repaint of the window.
    ///
    /// # Errors
    /// Failure of the operating system to start a thread.
    pub fn new(repaint: impl Fn() + Send + Sync + 'static) -> std::io::Result<Self> {
        Ok(Self {
            slots: Vec::new(),
            next_id: 0,
            doc: Arc::default(),
            forgotten: true,
            selected: 0,
            reference: ReferenceRenders::default(),
            analysis_worker: AnalysisWorker::new(repaint)?,
            newest: Arc::default(),
            analysis: Arc::default(),
            paused: false,
            asked: None,
            uploaded: BTreeMap::new(),
            zoom: ImageView::FIT,
            own_zoom: BTreeMap::new(),
            split: 0.5,
            flipped: 0,
            tool: Tool::Camera,
            picked: None,
            majorant_slice: None,
            medium: 0,
        })
    }

    /// Updates session and slots for a document. Returns a reference file that has to be read.
    pub fn submit(
        &mut self,
        doc: &SceneDoc,
        base: &Path,
        resolved: impl Fn(&SceneDoc) -> SceneDoc,
        session: &Session,
    ) -> Option<PathBuf> {
        if *self.doc == *doc && !self.forgotten {
            return None;
        }
        (self.doc, self.forgotten) = (Arc::new(doc.clone()), false);
        let wanted = doc.view_docs();
        let (next_id, paused) = (&mut self.next_id, self.paused);
        let (slots, left) = assign(std::mem::take(&mut self.slots), &wanted, || {
            *next_id += 1;
            Slot::paused(ViewId(*next_id), session, paused)
        });
        self.slots = slots;
        self.rehang();
        for gone in left {
            session.remove(gone.id);
        }
        session.set_fairness(doc.compare.fairness);
        for (slot, wanted) in self.slots.iter_mut().zip(&wanted) {
            slot.submit(wanted, &resolved, Role::View, session);
        }
        self.selected = self.selected.min(self.slots.len().saturating_sub(1));
        let file = self.reference.submit(doc, base, resolved, (session, self.paused));
        self.refresh(session);
        file
    }

    /// Whether rendering is paused.
    #[must_use]
    pub fn is_paused(&self) -> bool {
        self.paused
    }

    /// Whether any view or the reference is unfinished.
    #[must_use]
    pub fn is_unfinished(&self) -> bool {
        self.slots.iter().chain(self.reference.rendered()).any(Slot::is_unfinished)
    }

    /// Pauses or resumes all views and the reference, including those added later.
    pub fn set_paused(&mut self, paused: bool, session: &Session) {
        self.paused = paused;
        for id in self.ids() {
            session.set_paused(id, paused);
        }
    }

    /// Resets the views for another scene: all restart at the next submission.
    pub fn forget(&mut self) {
        self.forgotten = true;
        self.slots.iter_mut().for_each(Slot::forget);
        self.reference.forget();
        (self.zoom, self.picked, self.tool) = (ImageView::FIT, None, Tool::Camera);
        self.own_zoom.clear();
        self.selected = 0;
    }

    /// Updates the state from the session, the worker threads and newly tone-mapped `images`.
    pub fn update(
        &mut self,
        ctx: &Context,
        session: &Session,
        images: BTreeMap<PictureId, Option<ViewImage>>,
    ) {
        for slot in &mut self.slots {
            slot.update(session);
        }
        for (picture, image) in images {
            match image {
                Some(image) => self.upload(ctx, picture, image),
                None => drop(self.uploaded.remove(&picture)),
            }
        }
        let pictures_shown = self.pictures_shown();
        self.uploaded.retain(|picture, _| pictures_shown.contains(picture));
        if let Some(analysis) = self.analysis_worker.take() {
            self.newest = analysis;
        }
        self.refresh(session);
        self.ask();
    }

    /// Identifier of the image of view A.
    fn target(&self) -> Option<String> {
        let current = self.slots.first().and_then(Slot::picture).map(|snapshot| snapshot.target.clone());
        current.filter(|t| !t.is_empty())
    }

    /// Requests an analysis if its inputs have changed.
    fn ask(&mut self) {
        // The pixel may have been picked on an older, larger image.
        let film = [self.doc.film.width as usize, self.doc.film.height as usize];
        self.picked = self.picked.filter(|[x, y]| *x < film[0] && *y < film[1]);
        let experiment = self.experiment();
        let asking = Asked {
            doc: Arc::clone(&self.doc),
            snapshots: experiment.views.iter().map(|(_, v)| Arc::clone(&v.snapshot)).collect(),
            reference: experiment.reference.clone(),
            picked: self.picked,
        };
        let traced = self.pixel_samples_missing();
        if self.asked.as_ref().is_some_and(|known| known.is_like(&asking)) && !traced {
            return;
        }
        self.asked = Some(asking);
        let probes = || {
            let probe = |(i, s): (usize, &Slot)| Some((i, s.probe()?.clone()));
            self.slots.iter().enumerate().filter_map(probe).collect()
        };
        let pixel = self.picked.map(|at| PickedPixel { at, probes: probes() });
        let of = Provenance {
            views: self.slots.iter().map(|slot| Some(slot.state.generation)).collect(),
            ..self.provenance()
        };
        self.analysis_worker.ask(Question { of, experiment, pixel });
    }

    /// Whether the newest analysis has not yet traced all samples of the picked pixel.
    fn pixel_samples_missing(&self) -> bool {
        let Some((at, samples)) = &self.newest.pixel else { return false };
        self.picked == Some(*at)
            && samples.iter().any(|s| {
                let spp = self.slots.get(s.view).map_or(0, |slot| slot.stats.spp as usize);
                s.samples.len() < spp.min(KEPT as usize)
            })
    }

    /// The comparison with its current snapshots.
    #[must_use]
    pub fn experiment(&self) -> Experiment {
        let view = |(i, slot): (usize, &Slot)| {
            let snapshot = slot.picture().filter(|s| s.coarse.is_none())?.clone();
            let checkpoints = Arc::new(slot.checkpoints.clone());
            Some((i, View { label: label(i), doc: Arc::clone(&slot.rendered), snapshot, checkpoints }))
        };
        Experiment {
            doc: Arc::clone(&self.doc),
            views: self.slots.iter().enumerate().filter_map(view).collect(),
            reference: self.reference.picture().cloned(),
        }
    }

    /// Images shown by the arrangement, in order.
    #[must_use]
    pub fn pictures_shown(&self) -> Vec<PictureId> {
        if WindowDoc::of(&self.doc).arrangement == Arrangement::Difference && self.slots.len() > 1 {
            return vec![PictureId::Difference];
        }
        let mut pictures_shown: Vec<PictureId> = (0..self.slots.len()).map(PictureId::View).collect();
        // A view that is the reference is shown already. Other references have a cell even without an image.
        let own =
            matches!(self.doc.compare.reference, ReferenceDoc::Render { .. } | ReferenceDoc::File { .. });
        if own && self.map().is_none() {
            pictures_shown.push(PictureId::Reference);
        }
        pictures_shown
    }

    /// Map shown instead of the images.
    #[must_use]
    pub fn map(&self) -> Option<&'static maps::Map> {
        let window = WindowDoc::of(&self.doc);
        match (window.arrangement, window.layer.0.as_str()) {
            // A difference is shown as the signed error map unless another map is chosen.
            (Arrangement::Difference, id) if id == Layer::PICTURE => maps::find("error"),
            (_, id) => maps::find(id),
        }
    }

    /// Request to the tone mapper.
    #[must_use]
    pub fn order(&self) -> Order {
        let ordered = |(number, slot): (usize, &Slot)| OrderedView {
            number,
            id: slot.id,
            doc: Arc::clone(&slot.rendered),
        };
        let pictures_shown = self.pictures_shown();
        let (pictures, maps) = match self.map() {
            Some(map) => (Vec::new(), Some((map, pictures_shown))),
            None => (pictures_shown.into_iter().map(|s| (s, self.display(s))).collect(), None),
        };
        Order {
            doc: Arc::clone(&self.doc),
            views: self.slots.iter().enumerate().map(ordered).collect(),
            reference: self.reference.picture().cloned(),
            pictures,
            maps,
        }
    }

    /// Display settings of an image.
    #[must_use]
    pub fn display(&self, picture: PictureId) -> ViewDoc {
        let own = match picture {
            PictureId::View(view) => self.doc.view_doc(view).map(|d| d.view),
            PictureId::Reference | PictureId::Difference => None,
        };
        own.unwrap_or_else(|| self.doc.view.clone())
    }

    /// Index of the view that the method column edits.
    #[must_use]
    pub fn selected(&self) -> usize {
        self.selected
    }

    /// Selects the view that the method column edits.
    pub fn select(&mut self, view: usize) {
        self.selected = view.min(self.slots.len().saturating_sub(1));
    }

    /// Slots of the views, in order of the document.
    #[must_use]
    pub fn slots(&self) -> &[Slot] {
        &self.slots
    }

    /// Slot of the selected view.
    #[must_use]
    pub fn selected_slot(&self) -> Option<&Slot> {
        self.slots.get(self.selected)
    }

    /// Newest statistics that are valid for the images shown, see [`Provenance`].
    #[must_use]
    pub fn analysis(&self) -> &Arc<Analysis> {
        &self.analysis
    }

    /// Reads the reference file again at the next submission.
    pub fn reread_reference(&mut self) {
        self.reference.forget_file();
        self.forgotten = true;
    }

    /// Session ids of all views and of the rendered reference.
    #[must_use]
    pub fn ids(&self) -> Vec<ViewId> {
        self.slots.iter().map(|slot| slot.id).chain(self.reference.id()).collect()
    }

    /// Slot of the rendered reference, if there is one.
    #[must_use]
    pub fn rendered_reference(&self) -> Option<&Slot> {
        self.reference.rendered()
    }

    /// Status of the reference.
    #[must_use]
    pub fn reference_state(&self) -> ReferenceState {
        self.reference.state(&self.doc, self.target().as_deref())
    }

    /// Stores the result of reading a reference file.
    pub fn finish_reading(&mut self, path: &Path, read: Result<Reference, String>) {
        self.reference.finish_reading(path, read);
    }

    /// Pan and zoom of an image.
    #[must_use]
    pub fn zoom_of(&self, picture: PictureId) -> ImageView {
        match WindowDoc::of(&self.doc).own_zoom {
            true => self.own_zoom.get(&picture).copied().unwrap_or(self.zoom),
            false => self.zoom,
        }
    }

    /// Sets pan and zoom of an image, or of all images unless each has its own.
    pub fn set_zoom(&mut self, picture: PictureId, view: ImageView) {
        if WindowDoc::of(&self.doc).own_zoom {
            self.own_zoom.insert(picture, view);
        } else {
            self.zoom = view;
        }
    }

    /// Sets pan and zoom of all images.
    pub fn set_zoom_of_all(&mut self, view: ImageView) {
        self.zoom = view;
        self.own_zoom.clear();
    }
}
