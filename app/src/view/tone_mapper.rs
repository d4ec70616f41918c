//! Develops pictures and maps on a thread of its own, so that no frame waits for it.
//!
//! The session rings a [`Waker`] when it has something new; the developer looks, at most thirty times a
//! second and never more often than it can afford, develops what the window has ordered and asks for a
//! repaint.

use egui::{Color32, ColorImage};
use majorant_core::compare::maps::{Map, Range};
use majorant_core::compare::{Estimate, Experiment, Reference, View, label};
use majorant_core::film::{Snapshot, display::DisplayTransform};
use majorant_core::scene::{Pair, SceneDoc, ViewDoc};
use majorant_core::session::ViewId;
use std::collections::BTreeMap;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Shortest time between two pictures.
const SHORTEST: Duration = Duration::from_millis(33);
/// Developing may take this share of a core, so that rendering keeps the rest.
const SHARE: u32 = 6;

/// What there is to be looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PictureId {
    /// A view of the document, from 0.
    View(usize),
    /// What errors are measured against.
    Reference,
    /// What two views differ by.
    Difference,
}

/// A view that the window shows.
#[derive(Clone)]
pub struct OrderedView {
    /// Its number in the document, from 0.
    pub number: usize,
    /// Its name in the session.
    pub id: ViewId,
    /// What it renders.
    pub doc: Arc<SceneDoc>,
}

/// What the window wants to show.
#[derive(Clone, Default)]
pub struct Order {
    /// The scene with its comparison.
    pub doc: Arc<SceneDoc>,
    /// Its views.
    pub views: Vec<OrderedView>,
    /// What errors are measured against.
    pub reference: Option<Arc<Reference>>,
    /// Pictures as they are, each with its display.
    pub pictures: Vec<(PictureId, ViewDoc)>,
    /// Or this map of these.
    pub maps: Option<(&'static Map, Vec<PictureId>)>,
}

impl Order {
    /// The session's view that has a number in the document.
    fn id(&self, number: usize) -> Option<ViewId> {
        self.views.iter().find(|v| v.number == number).map(|v| v.id)
    }

    /// Whether nothing has to be developed anew. Documents and references are told apart by where they lie.
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

/// A picture ready to be shown.
#[derive(Clone, Debug)]
pub struct ViewImage {
    /// The pixels.
    pub image: ColorImage,
    /// The view's numbers that it was made from; absent for the reference.
    pub snapshot: Option<Arc<Snapshot>>,
    /// The session's view, if it is one's.
    pub id: Option<ViewId>,
    /// The reference that it was made from, if it is one.
    pub reference: Option<Arc<Reference>>,
    /// What it shows, if it is a map: the map's id, values and range.
    pub map: Option<Arc<MapImage>>,
}

/// The numbers behind a map.
#[derive(Clone, Debug)]
pub struct MapImage {
    /// Which map.
    pub map: &'static Map,
    /// What views are held against in it, in words; empty if it needs nothing.
    pub against: String,
    /// Its values.
    pub values: Vec<f32>,
    /// What its colours stand for.
    pub range: Range,
}

#[derive(Default)]
struct Inbox {
    woken: bool,
    closed: bool,
    order: Order,
    interval: Duration,
    done: BTreeMap<PictureId, Option<ViewImage>>,
}

/// Tells the window that there is something new; cheap to clone and to ring.
#[derive(Clone, Default)]
pub struct Waker {
    inbox: Arc<(Mutex<Inbox>, Condvar)>,
}

impl Waker {
    /// Rings.
    pub fn wake(&self) {
        self.change(|inbox| inbox.woken = true);
    }

    fn change(&self, change: impl FnOnce(&mut Inbox)) {
        change(&mut self.lock());
        self.inbox.1.notify_one();
    }

    /// Every change leaves the desk consistent, so a poisoned lock is still good.
    fn lock(&self) -> MutexGuard<'_, Inbox> {
        self.inbox.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits for an order and at least until `rested`; `None` means close.
    fn wait(&self, rested: Instant) -> Option<Order> {
        let mut inbox = self.lock();
        loop {
            if inbox.closed {
                return None;
            }
            let left = rested.saturating_duration_since(Instant::now());
            inbox = match (inbox.woken, left.is_zero()) {
                (true, true) => break,
                (true, false) => {
                    self.inbox.1.wait_timeout(inbox, left).unwrap_or_else(PoisonError::into_inner).0
                }
                (false, _) => self.inbox.1.wait(inbox).unwrap_or_else(PoisonError::into_inner),
            };
        }
        inbox.woken = false;
        Some(inbox.order.clone())
    }
}

/// Finds the newest picture of a view.
pub type Poll = Box<dyn Fn(ViewId) -> Option<Arc<Snapshot>> + Send>;

/// The thread that develops. Dropping it stops and joins it.
pub struct ToneMapper {
    waker: Waker,
    thread: Option<JoinHandle<()>>,
}

impl ToneMapper {
    /// Starts the thread. `repaint` wakes the window.
    ///
    /// # Errors
    /// When the operating system refuses a thread.
    pub fn new(waker: Waker, poll: Poll, repaint: impl Fn() + Send + 'static) -> std::io::Result<Self> {
        let theirs = waker.clone();
        let thread = std::thread::Builder::new()
            .name("majorant-developer".into())
            .spawn(move || run(&theirs, &poll, &repaint))?;
        Ok(Self { waker, thread: Some(thread) })
    }

    /// Develops this from now on, and what is new in it at once.
    pub fn order(&self, order: Order) {
        if !self.waker.lock().order.is_like(&order) {
            self.waker.change(|inbox| {
                inbox.order = order;
                inbox.woken = true;
            });
        }
    }

    /// Shortest time between pictures that the window can afford.
    pub fn set_interval(&self, interval: Duration) {
        self.waker.lock().interval = interval;
    }

    /// The pictures that were not taken yet; none for what has nothing to show any more.
    #[must_use]
    pub fn take(&self) -> BTreeMap<PictureId, Option<ViewImage>> {
        std::mem::take(&mut self.waker.lock().done)
    }
}

impl Drop for ToneMapper {
    fn drop(&mut self) {
        self.waker.change(|inbox| inbox.closed = true);
        if let Some(thread) = self.thread.take() {
            // A developer that panicked leaves the last picture; there is nothing to add here.
            let _ = thread.join();
        }
    }
}

fn run(waker: &Waker, poll: &Poll, repaint: &dyn Fn()) {
    let mut rested = Instant::now();
    let mut darkroom = Darkroom::default();
    while let Some(order) = waker.wait(rested) {
        let started = Instant::now();
        let done = darkroom.develop(&order, poll);
        let interval = {
            let mut inbox = waker.lock();
            inbox.done.extend(done);
            inbox.interval
        };
        rested = started + (started.elapsed() * SHARE).max(interval).max(SHORTEST);
        repaint();
    }
}

/// What was developed last, so that nothing is developed twice.
#[derive(Default)]
struct Darkroom {
    pictures: BTreeMap<PictureId, (Negative, ViewDoc)>,
    maps: Option<(Vec<Negative>, Order)>,
}

/// What a picture was developed from. It is kept, so that nothing newer can lie at its place in memory.
#[derive(Clone)]
enum Negative {
    View(Arc<Snapshot>),
    Reference(Arc<Reference>),
}

impl PartialEq for Negative {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::View(a), Self::View(b)) => Arc::ptr_eq(a, b),
            (Self::Reference(a), Self::Reference(b)) => Arc::ptr_eq(a, b),
            _ => false,
        }
    }
}

impl Darkroom {
    fn develop(&mut self, order: &Order, poll: &Poll) -> BTreeMap<PictureId, Option<ViewImage>> {
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
                    (
                        Negative::View(Arc::clone(s)),
                        [s.width, s.height],
                        s.mean.as_slice(),
                        Some(Arc::clone(s)),
                    )
                }
                PictureId::Reference => {
                    let Some(r) = &experiment.reference else { continue };
                    (Negative::Reference(Arc::clone(r)), [r.width, r.height], r.mean(), None)
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
            let image = develop(size, pixels, display);
            done.insert(*picture, ViewImage { image, snapshot, id, reference, map: None });
        }
        done
    }

    fn maps(&mut self, order: &Order, experiment: &Experiment) -> BTreeMap<PictureId, Option<ViewImage>> {
        let Some((map, pictures_shown)) = &order.maps else {
            self.maps = None;
            return BTreeMap::new();
        };
        let mut key: Vec<Negative> =
            experiment.views.iter().map(|(_, v)| Negative::View(Arc::clone(&v.snapshot))).collect();
        key.extend(experiment.reference.iter().cloned().map(Negative::Reference));
        if self.maps.as_ref().is_some_and(|(k, o)| *k == key && o.is_like(order)) {
            return BTreeMap::new();
        }
        self.maps = Some((key, order.clone()));
        let values: Vec<_> =
            pictures_shown.iter().filter_map(|s| Some((*s, values(map, *s, experiment)?))).collect();
        let range = Range::of(map.scale, values.iter().map(|(_, (_, v))| v.as_slice()));
        let against = if map.needs_reference { against(experiment) } else { String::new() };
        let print = |(picture, (snapshot, values)): (PictureId, (Arc<Snapshot>, Vec<f32>))| {
            let pixels = values.iter().map(|v| {
                let [r, g, b] = range.paint(*v);
                Color32::from_rgb(r, g, b)
            });
            let image = ColorImage::new([snapshot.width, snapshot.height], pixels.collect());
            let (id, against) = match picture {
                PictureId::View(number) => (order.id(number), against.clone()),
                // A difference names its two views itself.
                PictureId::Reference | PictureId::Difference => (None, String::new()),
            };
            let map = Some(Arc::new(MapImage { map, against, values, range }));
            (picture, ViewImage { image, snapshot: Some(snapshot), id, reference: None, map })
        };
        // What has no values any more must not go on showing old ones.
        let mut prints: BTreeMap<PictureId, Option<ViewImage>> =
            pictures_shown.iter().map(|picture| (*picture, None)).collect();
        prints.extend(values.into_iter().map(print).map(|(picture, print)| (picture, Some(print))));
        prints
    }
}

/// What the views of an experiment are held against.
fn against(experiment: &Experiment) -> String {
    experiment.reference.as_ref().map_or("the mean of the other unbiased views".into(), |r| r.origin.clone())
}

/// A map's values for a view or a difference, with the picture that they belong to.
fn values(map: &Map, picture: PictureId, experiment: &Experiment) -> Option<(Arc<Snapshot>, Vec<f32>)> {
    let find = |number: usize| experiment.views.iter().find(|(n, _)| *n == number).map(|(_, v)| &v.snapshot);
    let (snapshot, values) = match picture {
        PictureId::View(number) => {
            let snapshot = find(number)?;
            let held = match (map.needs_reference, map.is_test()) {
                (false, _) => None,
                (true, true) => experiment.held_against(number).1,
                (true, false) => experiment.measured_against(number),
            };
            (
                snapshot,
                map.values(&Estimate::of(snapshot)?, held.as_deref().map(Reference::estimate).as_ref()),
            )
        }
        PictureId::Difference => {
            let Pair(a, b) = experiment.doc.compare.pair;
            let snapshot = find(a)?;
            (snapshot, map.values(&Estimate::of(snapshot)?, Some(&Estimate::of(find(b)?)?)))
        }
        PictureId::Reference => return None,
    };
    (values.len() == snapshot.mean.len()).then(|| (Arc::clone(snapshot), values))
}

/// Applies the display transform to every pixel.
#[must_use]
pub fn develop(size: [usize; 2], mean: &[[f32; 3]], view: &ViewDoc) -> ColorImage {
    let transform = DisplayTransform::new(view);
    let colour = |mean: &[f32; 3]| {
        let [r, g, b] = transform.encode(*mean);
        Color32::from_rgb(r, g, b)
    };
    ColorImage::new(size, mean.iter().map(colour).collect())
}
