//! What the wall holds between frames.

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

/// What a drag on a picture does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Turns the camera.
    #[default]
    Camera,
    /// Draws the box that numbers are about.
    Region,
}

/// The views, the pictures of them that hang, and the numbers about them.
pub struct Wall {
    slots: Vec<Slot>,
    next_id: u32,
    /// The document that the slots were last brought in line with.
    doc: Arc<SceneDoc>,
    /// Whether everything has to start over.
    forgotten: bool,
    selected: usize,
    reference: ReferenceRenders,
    analysis_worker: AnalysisWorker,
    newest: Arc<Analysis>,
    /// The part of it that describes what is shown.
    analysis: Arc<Analysis>,
    /// Whether nothing is rendered until it is told to go on: views and reference alike.
    paused: bool,
    /// What the analyst was last asked about.
    asked: Option<Asked>,
    uploaded: BTreeMap<PictureId, UploadedImage>,
    zoom: ImageView,
    own_zoom: BTreeMap<PictureId, ImageView>,
    /// Where the divider of a wipe stands, as a share of the width.
    pub split: f32,
    /// Which sight a flip shows.
    pub flipped: usize,
    /// What a drag does.
    pub tool: Tool,
    /// The pixel whose samples are shown.
    pub picked: Option<[usize; 2]>,
    /// The slice of majorants that is drawn over views, if any.
    pub majorant_slice: Option<f32>,
}

/// What numbers depend on.
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
    /// A wall with nothing on it.
    ///
    /// # Errors
    /// When the operating system refuses a thread.
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
        })
    }

    /// Brings session and slots in line with a document. Returns a reference that has to be read.
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
            slot.submit(wanted, &resolved, Role::Contender, session);
        }
        self.selected = self.selected.min(self.slots.len().saturating_sub(1));
        let file = self.reference.submit(doc, base, resolved, (session, self.paused));
        self.refresh(session);
        file
    }

    /// Whether nothing is rendered until it is told to go on.
    #[must_use]
    pub fn is_paused(&self) -> bool {
        self.paused
    }

    /// Whether any view or the reference has not come to its end.
    #[must_use]
    pub fn is_unfinished(&self) -> bool {
        self.slots.iter().chain(self.reference.rendered()).any(Slot::is_unfinished)
    }

    /// Pauses every view and the reference, those that are still to come as well, or lets all go on.
    pub fn set_paused(&mut self, paused: bool, session: &Session) {
        self.paused = paused;
        for id in self.ids() {
            session.set_paused(id, paused);
        }
    }

    /// Everything starts over at the next submission, as for another scene.
    pub fn forget(&mut self) {
        self.forgotten = true;
        self.slots.iter_mut().for_each(Slot::forget);
        self.reference.forget();
        (self.zoom, self.picked, self.tool) = (ImageView::FIT, None, Tool::Camera);
        self.own_zoom.clear();
        self.selected = 0;
    }

    /// Takes note of what session and threads have done; `prints` are new pictures.
    pub fn update(
        &mut self,
        ctx: &Context,
        session: &Session,
        prints: BTreeMap<PictureId, Option<ViewImage>>,
    ) {
        for slot in &mut self.slots {
            slot.update(session);
        }
        for (picture, print) in prints {
            match print {
                Some(print) => self.upload(ctx, picture, print),
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

    /// Names the image that view A shows.
    fn target(&self) -> Option<String> {
        let current = self.slots.first().and_then(Slot::picture).map(|snapshot| snapshot.target.clone());
        current.filter(|t| !t.is_empty())
    }

    /// Asks the analyst again if anything has changed that numbers depend on.
    fn ask(&mut self) {
        // A click may have met the old picture of a film that is smaller now.
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

    /// The comparison as it stands.
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

    /// Everything that the arrangement shows, in its order.
    #[must_use]
    pub fn pictures_shown(&self) -> Vec<PictureId> {
        if WindowDoc::of(&self.doc).arrangement == Arrangement::Difference && self.slots.len() > 1 {
            return vec![PictureId::Difference];
        }
        let mut pictures_shown: Vec<PictureId> = (0..self.slots.len()).map(PictureId::View).collect();
        // A view that is the reference is on the wall already. Others have their place before they have a picture.
        let own =
            matches!(self.doc.compare.reference, ReferenceDoc::Render { .. } | ReferenceDoc::File { .. });
        if own && self.map().is_none() {
            pictures_shown.push(PictureId::Reference);
        }
        pictures_shown
    }

    /// The map that is shown instead of the pictures.
    #[must_use]
    pub fn map(&self) -> Option<&'static maps::Map> {
        let window = WindowDoc::of(&self.doc);
        match (window.arrangement, window.layer.0.as_str()) {
            // A difference is a map of its own, signed unless another was chosen.
            (Arrangement::Difference, id) if id == Layer::PICTURE => maps::find("error"),
            (_, id) => maps::find(id),
        }
    }

    /// What the developer shall do.
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

    /// How a sight's radiance is shown.
    #[must_use]
    pub fn display(&self, picture: PictureId) -> ViewDoc {
        let own = match picture {
            PictureId::View(view) => self.doc.view_doc(view).map(|d| d.view),
            PictureId::Reference | PictureId::Difference => None,
        };
        own.unwrap_or_else(|| self.doc.view.clone())
    }

    /// The view that the method column edits.
    #[must_use]
    pub fn selected(&self) -> usize {
        self.selected
    }

    /// Chooses the view that the method column edits.
    pub fn select(&mut self, view: usize) {
        self.selected = view.min(self.slots.len().saturating_sub(1));
    }

    /// The views.
    #[must_use]
    pub fn slots(&self) -> &[Slot] {
        &self.slots
    }

    /// The slot that the method column edits.
    #[must_use]
    pub fn selected_slot(&self) -> Option<&Slot> {
        self.slots.get(self.selected)
    }

    /// The newest numbers, as far as they describe what is shown: see [`Provenance`].
    #[must_use]
    pub fn analysis(&self) -> &Arc<Analysis> {
        &self.analysis
    }

    /// A reference file is read again, whatever is known of it.
    pub fn reread_reference(&mut self) {
        self.reference.forget_file();
        self.forgotten = true;
    }

    /// The session's views, that of the reference too.
    #[must_use]
    pub fn ids(&self) -> Vec<ViewId> {
        self.slots.iter().map(|slot| slot.id).chain(self.reference.id()).collect()
    }

    /// The view of the session that renders the reference, if one does.
    #[must_use]
    pub fn rendered_reference(&self) -> Option<&Slot> {
        self.reference.rendered()
    }

    /// What there is to say about the reference.
    #[must_use]
    pub fn reference_state(&self) -> ReferenceState {
        self.reference.state(&self.doc, self.target().as_deref())
    }

    /// A reference was read, or not.
    pub fn finish_reading(&mut self, path: &Path, read: Result<Reference, String>) {
        self.reference.finish_reading(path, read);
    }

    /// Pan and zoom of a sight.
    #[must_use]
    pub fn zoom_of(&self, picture: PictureId) -> ImageView {
        match WindowDoc::of(&self.doc).own_zoom {
            true => self.own_zoom.get(&picture).copied().unwrap_or(self.zoom),
            false => self.zoom,
        }
    }

    /// Pans and zooms a sight, and with it all others unless each has a zoom of its own.
    pub fn set_zoom(&mut self, picture: PictureId, view: ImageView) {
        if WindowDoc::of(&self.doc).own_zoom {
            self.own_zoom.insert(picture, view);
        } else {
            self.zoom = view;
        }
    }

    /// Pans and zooms all.
    pub fn set_zoom_of_all(&mut self, view: ImageView) {
        self.zoom = view;
        self.own_zoom.clear();
    }
}
