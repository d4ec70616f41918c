//! Response times of the window.

use std::collections::VecDeque;
use std::time::Instant;

/// Numbers of recent edits and frames that are kept.
const EDITS: usize = 32;
const FRAMES: usize = 120;

/// Last, median and worst of recent times, in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recent {
    /// Newest time.
    pub last: f64,
    /// Median of the recent times.
    pub median: f64,
    /// Longest of the recent times.
    pub worst: f64,
}

/// Recorder of recent latencies and frame times.
#[derive(Debug, Default)]
pub struct Latency {
    /// Newest edit whose image is not shown yet: its generation and its time.
    waiting: Option<(u64, Instant)>,
    /// Generation of the newest edit.
    edited: u64,
    visible: VecDeque<f64>,
    cancelled: VecDeque<f64>,
    /// Generation whose cancellation was recorded last.
    noted: u64,
    frames: VecDeque<f64>,
}

impl Latency {
    /// Records that an edit was submitted to the session as this generation.
    pub fn edited(&mut self, generation: u64) {
        if generation > self.edited {
            self.edited = generation;
            self.waiting = Some((generation, Instant::now()));
        }
    }

    /// Records that a frame shows an image of this generation.
    pub fn shown(&mut self, generation: u64) {
        if let Some((wanted, since)) = self.waiting
            && generation >= wanted
        {
            keep(&mut self.visible, EDITS, since.elapsed().as_secs_f64());
            self.waiting = None;
        }
    }

    /// Records the time for which the predecessor of a generation continued, as reported by the session.
    pub fn cancelled(&mut self, generation: u64, seconds: Option<f64>) {
        if let Some(seconds) = seconds
            && self.noted != generation
        {
            self.noted = generation;
            keep(&mut self.cancelled, EDITS, seconds);
        }
    }

    /// Records the time that the window spent on a frame, in seconds.
    pub fn frame(&mut self, seconds: f64) {
        keep(&mut self.frames, FRAMES, seconds);
    }

    /// Time from an edit to the first frame that shows its image.
    #[must_use]
    pub fn first_picture(&self) -> Option<Recent> {
        recent(&self.visible)
    }

    /// Time from an edit until the last worker has stopped tracing the old scene.
    #[must_use]
    pub fn cancellation(&self) -> Option<Recent> {
        recent(&self.cancelled)
    }

    /// Time of the window per frame: reading the session, widgets and commands, without rasterisation.
    #[must_use]
    pub fn frames(&self) -> Option<Recent> {
        recent(&self.frames)
    }
}

fn keep(times: &mut VecDeque<f64>, most: usize, seconds: f64) {
    if times.len() == most {
        times.pop_front();
    }
    times.push_back(seconds);
}

fn recent(times: &VecDeque<f64>) -> Option<Recent> {
    let last = *times.back()?;
    let mut sorted: Vec<f64> = times.iter().copied().collect();
    sorted.sort_by(f64::total_cmp);
    Some(Recent { last, median: sorted[sorted.len() / 2], worst: sorted[sorted.len() - 1] })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edit_waits_for_its_image_and_counts_once() {
        let mut latency = Latency::default();
        assert_eq!(latency.first_picture(), None);
        latency.edited(3);
        latency.shown(2);
        assert_eq!(latency.first_picture(), None, "an older image does not count");
        latency.shown(3);
        // Later frames report the same edit, which counts only once.
        latency.edited(3);
        latency.shown(3);
        assert_eq!(latency.visible.len(), 1);
        latency.cancelled(3, None);
        latency.cancelled(3, Some(0.002));
        latency.cancelled(3, Some(0.002));
        assert_eq!(latency.cancelled.len(), 1);
    }

    #[test]
    fn times_are_summarised_and_dropped() {
        let mut latency = Latency::default();
        for i in 0..200u16 {
            latency.frame(f64::from(i));
        }
        let frames = latency.frames().unwrap();
        assert_eq!((frames.last, frames.median, frames.worst), (199.0, 140.0, 199.0));
    }
}
