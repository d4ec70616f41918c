//! Develops snapshots into display pictures on a thread of its own, so that no frame waits for it.
//!
//! The session rings a [`Bell`] when it has something new; the developer looks, at most thirty times a
//! second and never more often than it can afford, applies the display transform and asks for a repaint.

use egui::{Color32, ColorImage};
use majorant_core::film::{Snapshot, display::DisplayTransform};
use majorant_core::scene::ViewDoc;
use majorant_core::session::ViewState;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Shortest time between two pictures.
const SHORTEST: Duration = Duration::from_millis(33);
/// Developing may take this share of a core, so that rendering keeps the rest.
const SHARE: u32 = 6;

/// A picture ready to be shown.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The pixels.
    pub image: ColorImage,
    /// What they were made from.
    pub snapshot: Arc<Snapshot>,
}

#[derive(Default)]
struct Desk {
    rung: bool,
    closed: bool,
    view: ViewDoc,
    interval: Duration,
    done: Option<Picture>,
}

/// Tells the developer that there is something new to see; cheap to clone and to ring.
#[derive(Clone, Default)]
pub struct Bell {
    desk: Arc<(Mutex<Desk>, Condvar)>,
}

impl Bell {
    /// Rings.
    pub fn ring(&self) {
        self.change(|desk| desk.rung = true);
    }

    fn change(&self, change: impl FnOnce(&mut Desk)) {
        change(&mut self.lock());
        self.desk.1.notify_one();
    }

    /// Every change leaves the desk consistent, so a poisoned lock is still good.
    fn lock(&self) -> MutexGuard<'_, Desk> {
        self.desk.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits for a ring and at least until `rested`; `None` means close.
    fn wait(&self, rested: Instant) -> Option<ViewDoc> {
        let mut desk = self.lock();
        loop {
            if desk.closed {
                return None;
            }
            let left = rested.saturating_duration_since(Instant::now());
            desk = match (desk.rung, left.is_zero()) {
                (true, true) => break,
                (true, false) => {
                    self.desk.1.wait_timeout(desk, left).unwrap_or_else(PoisonError::into_inner).0
                }
                (false, _) => self.desk.1.wait(desk).unwrap_or_else(PoisonError::into_inner),
            };
        }
        desk.rung = false;
        Some(desk.view.clone())
    }
}

/// The thread that develops. Dropping it stops and joins it.
pub struct Developer {
    bell: Bell,
    thread: Option<JoinHandle<()>>,
}

impl Developer {
    /// Starts the thread. `poll` reads the newest state, `repaint` wakes the window.
    ///
    /// # Errors
    /// When the operating system refuses a thread.
    pub fn new(
        bell: Bell,
        poll: impl Fn() -> ViewState + Send + 'static,
        repaint: impl Fn() + Send + 'static,
    ) -> std::io::Result<Self> {
        let theirs = bell.clone();
        let thread = std::thread::Builder::new()
            .name("majorant-developer".into())
            .spawn(move || run(&theirs, &poll, &repaint))?;
        Ok(Self { bell, thread: Some(thread) })
    }

    /// Develops with these display settings from now on, and the newest picture at once.
    pub fn set_view(&self, view: &ViewDoc) {
        if self.bell.lock().view != *view {
            self.bell.change(|desk| {
                desk.view = view.clone();
                desk.rung = true;
            });
        }
    }

    /// Shortest time between pictures that the window can afford.
    pub fn set_interval(&self, interval: Duration) {
        self.bell.lock().interval = interval;
    }

    /// The newest picture, if there is one that was not taken yet.
    #[must_use]
    pub fn take(&self) -> Option<Picture> {
        self.bell.lock().done.take()
    }
}

impl Drop for Developer {
    fn drop(&mut self) {
        self.bell.change(|desk| desk.closed = true);
        if let Some(thread) = self.thread.take() {
            // A developer that panicked leaves the last picture; there is nothing to add here.
            let _ = thread.join();
        }
    }
}

fn run(bell: &Bell, poll: &dyn Fn() -> ViewState, repaint: &dyn Fn()) {
    let mut rested = Instant::now();
    let mut last: Option<(Arc<Snapshot>, ViewDoc)> = None;
    while let Some(view) = bell.wait(rested) {
        let started = Instant::now();
        if let Some(snapshot) = poll().snapshot {
            let known = last.as_ref().is_some_and(|(s, v)| Arc::ptr_eq(s, &snapshot) && *v == view);
            if !known {
                let image = develop(&snapshot, &view);
                bell.lock().done = Some(Picture { image, snapshot: Arc::clone(&snapshot) });
                last = Some((snapshot, view));
            }
        }
        let affordable = (started.elapsed() * SHARE).max(bell.lock().interval).max(SHORTEST);
        rested = started + affordable;
        repaint();
    }
}

/// Applies the display transform to every pixel.
#[must_use]
pub fn develop(snapshot: &Snapshot, view: &ViewDoc) -> ColorImage {
    let transform = DisplayTransform::new(view);
    let pixels = snapshot
        .mean
        .iter()
        .map(|&mean| {
            let [r, g, b] = transform.encode(mean);
            Color32::from_rgb(r, g, b)
        })
        .collect();
    ColorImage::new([snapshot.width, snapshot.height], pixels)
}
