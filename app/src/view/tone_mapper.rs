//! Tone mapping of images and colour mapping of maps, on a worker thread.
//!
//! The session calls [`Waker::wake`] when a view has a new image. The worker then tone-maps the images that
//! the window shows, at most thirty times a second and within its share of a core, and requests a repaint.

use crate::background::{Background, Inbox, Reply};
use crate::model::{Pair, WindowDoc};
use egui::{Color32, ColorImage};
use majorant_core::compare::maps::{Map, Range};
use majorant_core::compare::{Estimate, Experiment, Reference, View, label};
use majorant_core::film::{Snapshot, display::DisplayTransform};
use majorant_core::scene::{SceneDoc, ViewDoc};
use majorant_core::session::ViewId;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Minimum interval between two updates.
const SHORTEST: Duration = Duration::from_millis(33);
/// Reciprocal of the share of a core that tone mapping may take, so that rendering keeps the rest.
const SHARE: u32 = 6;

/// Identifies an image of the comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PictureId {
    /// A view of the document, from 0.
    View(usize),
    /// The reference of the errors.
    Reference,
    /// The difference of two views.
    Difference,
}

/// A view of the document and its counterpart in the session.
#[derive(Clone)]
pub struct OrderedView {
    /// Index in the document, from 0.
    pub number: usize,
    /// Id in the session.
    pub id: ViewId,
    /// The scene that it renders.
    pub doc: Arc<SceneDoc>,
}

/// Images that the window shows, with everything that they depend on.
#[derive(Clone, Default)]
pub struct Order {
    /// The scene with its comparison.
    pub doc: Arc<SceneDoc>,
    /// The views of the comparison.
    pub views: Vec<OrderedView>,
    /// The reference of the errors.
    pub reference: Option<Arc<Reference>>,
    /// Tone-mapped images, each with its display settings.
    pub pictures: Vec<(PictureId, ViewDoc)>,
    /// A map, and the views and differences for which it is shown.
    pub maps: Option<(&'static Map, Vec<PictureId>)>,
}

impl Order {
    /// Id in the session of the view with an index in the document.
    fn id(&self, number: usize) -> Option<ViewId> {
        self.views.iter().find(|v| v.number == number).map(|v| v.id)
    }

    /// Whether both orders give the same images. Documents and references are compared by address.
    fn is_like(&self, other: &Self) -> bool {
        let views =
            |o: &Self| o.views.iter().map(|v| (v.number, v.id, Arc::as_ptr(&v.doc))).collect::<Vec<_>>();
        let maps = |o: &Self| o.maps.as_ref().map(|(map, pictures_shown)| (map.id, pictures_shown.clone()));
        Arc::ptr_eq(&self.doc, &other.doc)
            && views(self) == views(other)
            && self.reference.as_ref().map(Arc::as_ptr) == other.reference.as_ref().map(Arc::as_ptr)
            && self.pictures == other.pictures
            && maps(self) == maps(other)
    }
}

/// An image ready for upload as a texture.
#[derive(Clone, Debug)]
pub struct ViewImage {
    /// Display pixels.
    pub image: ColorImage,
    /// Snapshot of the view from which it was made; `None` for the reference.
    pub snapshot: Option<Arc<Snapshot>>,
    /// Id in the session of the view that it shows.
    pub id: Option<ViewId>,
    /// The reference that it shows.
    pub reference: Option<Arc<Reference>>,
    /// Values of the map that it shows.
    pub map: Option<Arc<MapImage>>,
}

/// Values and colour scale of a map.
#[derive(Clone, Debug)]
pub struct MapImage {
    /// The map.
    pub map: &'static Map,
    /// Description of the reference; empty if the map needs none.
    pub against: String,
    /// Values, one per pixel.
    pub values: Vec<f32>,
    /// Range of values of the colour scale.
    pub range: Range,
}

type Done = BTreeMap<PictureId, Option<ViewImage>>;

/// Handle that wakes the tone mapper; cheap to clone.
#[derive(Clone, Default)]
pub struct Waker(Inbox<(), Done>);

impl Waker {
    /// Requests an update of the images.
    pub fn wake(&self) {
        self.0.replace(());
    }
}

/// Returns the newest snapshot of a view.
pub type Poll = Box<dyn Fn(ViewId) -> Option<Arc<Snapshot>> + Send + Sync>;

/// Requested images, and the minimum interval between updates.
#[derive(Default)]
struct Wanted {
    order: Order,
    interval: Duration,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // Every change leaves the value consistent, so a poisoned lock can be used.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Worker that tone-maps images and colours maps.
pub struct ToneMapper {
    wanted: Arc<Mutex<Wanted>>,
    worker: Background<(), Done>,
}

impl ToneMapper {
    /// Starts the thread. `repaint` requests a repaint of the window.
    ///
    /// # Errors
    /// Failure of the operating system to start a thread.
    pub fn new(
        waker: Waker,
        poll: Poll,
        repaint: impl Fn() + Send + Sync + 'static,
    ) -> std::io::Result<Self> {
        let wanted = Arc::new(Mutex::new(Wanted::default()));
        let (theirs, rests) = (Arc::clone(&wanted), Arc::clone(&wanted));
        let cache = Mutex::new(Cache::default());
        let work = move |(): (), reply: &Reply<'_, (), Done>| {
            let order = lock(&theirs).order.clone();
            let done = lock(&cache).pictures_of(&order, &poll);
            reply.merge(done, |mut older, newer| {
                older.extend(newer);
                older
            });
        };
        let rest = move |took: Duration| (took * SHARE).max(lock(&rests).interval).max(SHORTEST);
        let mut worker = Background::new("tone-mapper", work).with_inbox(waker.0).resting(rest);
        worker.set_wake(repaint);
        worker.start()?;
        Ok(Self { wanted, worker })
    }

    /// Replaces the requested images; a changed request is processed at once.
    pub fn order(&self, order: Order) {
        let mut wanted = lock(&self.wanted);
        if !wanted.order.is_like(&order) {
            wanted.order = order;
            self.worker.inbox().replace(());
        }
    }

    /// Sets the minimum interval between updates.
    pub fn set_interval(&self, interval: Duration) {
        lock(&self.wanted).interval = interval;
    }

    /// Takes the images finished since the last call; `None` for an image that no longer has content.
    pub fn take(&mut self) -> BTreeMap<PictureId, Option<ViewImage>> {
        self.worker.poll().pop().unwrap_or_default()
    }
}

/// Sources of the last images, so that unchanged images are not tone-mapped again.
#[derive(Default)]
struct Cache {
    pictures: BTreeMap<PictureId, (Source, ViewDoc)>,
    maps: Option<(Vec<Source>, Order)>,
}

/// Source of an image, kept alive so that its address is not reused: sources are compared by address.
#[derive(Clone)]
enum Source {
    View(Arc<Snapshot>),
    Reference(Arc<Reference>),
}

impl PartialEq for Source {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::View(a), Self::View(b)) => Arc::ptr_eq(a, b),
            (Self::Reference(a), Self::Reference(b)) => Arc::ptr_eq(a, b),
            _ => false,
        }
    }
}

impl Cache {
    fn pictures_of(&mut self, order: &Order, poll: &Poll) -> BTreeMap<PictureId, Option<ViewImage>> {
        let views = order.views.iter().filter_map(|view| {
            let snapshot = poll(view.id)?;
            let label = label(view.number);
            let doc = Arc::clone(&view.doc);
            Some((view.number, View { label, doc, snapshot, checkpoints: Arc::default() }))
        });
        let experiment = Experiment {
            doc: Arc::clone(&order.doc),
            views: views.collect(),
            reference: order.reference.clone(),
        };
        let pictures = self.pictures(order, &experiment).into_iter();
        let mut done: BTreeMap<PictureId, Option<ViewImage>> =
            pictures.map(|(picture, p)| (picture, Some(p))).collect();
        done.extend(self.maps(order, &experiment));
        done
    }

    fn pictures(&mut self, order: &Order, experiment: &Experiment) -> BTreeMap<PictureId, ViewImage> {
        let mut done = BTreeMap::new();
        self.pictures.retain(|picture, _| order.pictures.iter().any(|(s, _)| s == picture));
        for (picture, display) in &order.pictures {
            let (key, size, pixels, snapshot) = match picture {
                PictureId::View(number) => {
                    let Some((_, view)) = experiment.views.iter().find(|(n, _)| n == number) else {
                        continue;
                    };
                    let s = &view.snapshot;
                    (Source::View(Arc::clone(s)), [s.width, s.height], s.mean.as_slice(), Some(Arc::clone(s)))
                }
                PictureId::Reference => {
                    let Some(r) = &experiment.reference else { continue };
                    (Source::Reference(Arc::clone(r)), [r.width, r.height], r.mean(), None)
                }
                PictureId::Difference => continue,
            };
            if self.pictures.get(picture).is_some_and(|(k, d)| *k == key && d == display) {
                continue;
            }
            self.pictures.insert(*picture, (key, display.clone()));
            let id = match picture {
                PictureId::View(number) => order.id(*number),
                PictureId::Reference | PictureId::Difference => None,
            };
            let reference = experiment.reference.clone().filter(|_| *picture == PictureId::Reference);
            let image = tone_mapped(size, pixels, display);
            done.insert(*picture, ViewImage { image, snapshot, id, reference, map: None });
        }
        done
    }

    fn maps(&mut self, order: &Order, experiment: &Experiment) -> BTreeMap<PictureId, Option<ViewImage>> {
        let Some((map, pictures_shown)) = &order.maps else {
            self.maps = None;
            return BTreeMap::new();
        };
        let mut key: Vec<Source> =
            experiment.views.iter().map(|(_, v)| Source::View(Arc::clone(&v.snapshot))).collect();
        key.extend(experiment.reference.iter().cloned().map(Source::Reference));
        if self.maps.as_ref().is_some_and(|(k, o)| *k == key && o.is_like(order)) {
            return BTreeMap::new();
        }
        self.maps = Some((key, order.clone()));
        let values: Vec<_> =
            pictures_shown.iter().filter_map(|s| Some((*s, values(map, *s, experiment)?))).collect();
        let range = Range::of(map.scale, values.iter().map(|(_, (_, v))| v.as_slice()));
        let against = if map.needs_reference { against(experiment) } else { String::new() };
        let painted = |(picture, (snapshot, values)): (PictureId, (Arc<Snapshot>, Vec<f32>))| {
            let pixels = values.iter().map(|v| {
                let [r, g, b] = range.paint(*v);
                Color32::from_rgb(r, g, b)
            });
            let image = ColorImage::new([snapshot.width, snapshot.height], pixels.collect());
            let (id, against) = match picture {
                PictureId::View(number) => (order.id(number), against.clone()),
                // The caption of a difference names both views.
                PictureId::Reference | PictureId::Difference => (None, String::new()),
            };
            let map = Some(Arc::new(MapImage { map, against, values, range }));
            (picture, ViewImage { image, snapshot: Some(snapshot), id, reference: None, map })
        };
        // Images without current values are removed.
        let mut images: BTreeMap<PictureId, Option<ViewImage>> =
            pictures_shown.iter().map(|picture| (*picture, None)).collect();
        images.extend(values.into_iter().map(painted).map(|(picture, image)| (picture, Some(image))));
        images
    }
}

/// Description of the reference of an experiment.
fn against(experiment: &Experiment) -> String {
    experiment.reference.as_ref().map_or("the mean of the other unbiased views".into(), |r| r.origin.clone())
}

/// Values of a map for a view or a difference, with the snapshot to which they belong.
fn values(map: &Map, picture: PictureId, experiment: &Experiment) -> Option<(Arc<Snapshot>, Vec<f32>)> {
    let find = |number: usize| experiment.views.iter().find(|(n, _)| *n == number).map(|(_, v)| &v.snapshot);
    let (snapshot, values) = match picture {
        PictureId::View(number) => {
            let snapshot = find(number)?;
            let held = match (map.needs_reference, map.is_test()) {
                (false, _) => None,
                (true, true) => experiment.compared_with(number).1,
                (true, false) => experiment.measured_against(number),
            };
            (
                snapshot,
                map.values(&Estimate::of(snapshot)?, held.as_deref().map(Reference::estimate).as_ref()),
            )
        }
        PictureId::Difference => {
            let Pair(a, b) = WindowDoc::of(&experiment.doc).pair;
            let snapshot = find(a)?;
            (snapshot, map.values(&Estimate::of(snapshot)?, Some(&Estimate::of(find(b)?)?)))
        }
        PictureId::Reference => return None,
    };
    (values.len() == snapshot.mean.len()).then(|| (Arc::clone(snapshot), values))
}

/// Applies the display transform to every pixel of a linear image.
#[must_use]
pub fn tone_mapped(size: [usize; 2], mean: &[[f32; 3]], view: &ViewDoc) -> ColorImage {
    let transform = DisplayTransform::new(view);
    let colour = |mean: &[f32; 3]| {
        let [r, g, b] = transform.encode(*mean);
        Color32::from_rgb(r, g, b)
    };
    ColorImage::new(size, mean.iter().map(colour).collect())
}
