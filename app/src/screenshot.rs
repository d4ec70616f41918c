//! Delayed screenshot of the window, after which the program ends; for documentation and checks.

use egui::{ColorImage, Context, ViewportCommand};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

type Slot = Arc<Mutex<Option<Arc<ColorImage>>>>;

/// Pending screenshot of the window.
pub struct Screenshot {
    path: PathBuf,
    due: Instant,
    slot: Slot,
    requested: bool,
    finished: bool,
}

impl Screenshot {
    /// Schedules a screenshot after this many seconds.
    #[must_use]
    pub fn new(path: PathBuf, after_seconds: f32) -> Self {
        let wait = Duration::from_secs_f32(after_seconds.clamp(0.0, 86_400.0));
        Self { path, due: Instant::now() + wait, slot: Slot::default(), requested: false, finished: false }
    }

    /// Advances the screenshot by one frame; returns an error message if it failed.
    pub fn update(&mut self, ctx: &Context) -> Option<String> {
        if self.finished {
            return None;
        }
        let now = Instant::now();
        if now < self.due {
            ctx.request_repaint_after(self.due - now);
            return None;
        }
        if !self.requested {
            self.requested = true;
            let (slot, repaint) = (Arc::clone(&self.slot), ctx.clone());
            ctx.request_screenshot(move |image| {
                *slot.lock().unwrap_or_else(PoisonError::into_inner) = Some(image);
                repaint.request_repaint();
            });
            return None;
        }
        let image = self.slot.lock().unwrap_or_else(PoisonError::into_inner).take()?;
        self.finished = true;
        let written = write(&self.path, &image);
        if written.is_ok() {
            ctx.send_viewport_cmd(ViewportCommand::Close);
        }
        written.err()
    }
}

fn write(path: &Path, image: &ColorImage) -> Result<(), String> {
    let problem = |reason: String| format!("{}: the screenshot cannot be written: {reason}", path.display());
    let side = |n: usize| u32::try_from(n).map_err(|e| problem(e.to_string()));
    let (width, height) = (side(image.width())?, side(image.height())?);
    let bytes = image.pixels.iter().flat_map(|p| [p.r(), p.g(), p.b()]).collect();
    let picture =
        image::RgbImage::from_raw(width, height, bytes).ok_or_else(|| problem("wrong size".into()))?;
    picture.save(path).map_err(|e| problem(e.to_string()))
}
