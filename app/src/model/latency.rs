//! How soon the window answers, measured where people feel it.

use std::collections::VecDeque;
use std::time::Instant;

/// Edits and frames that are remembered.
const EDITS: usize = 32;
const FRAMES: usize = 120;

/// The last and the usual of a few measured times, in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recent {
    /// The newest.
    pub last: f64,
    /// Half of those remembered are shorter.
    pub median: f64,
    /// The longest remembered.
    pub worst: f64,
}

/// See the [module](self).
#[derive(Debug, Default)]
pub struct Latency {
    /// The newest edit whose picture is still to be seen: its generation, and when it was made.
    waiting: Option<(u64, Instant)>,
    /// The newest edit.
    edited: u64,
    visible: VecDeque<f64>,
    cancelled: VecDeque<f64>,
    /// The generation whose cancellation was noted last.
    noted: u64,
    frames: VecDeque<f64>,
}

impl Latency {
    /// An edit was handed to the session as this generation.
    pub fn edited(&mut self, generation: u64) {
        if generation > self.edited {
            self.edited = generation;
            self.waiting = Some((generation, Instant::now()));
        }
    }

    /// A frame shows a picture of this generation.
    pub fn shown(&mut self, generation: u64) {
        if let Some((wanted, since)) = self.waiting
            && generation >= wanted
        {
            keep(&mut self.visible, EDITS, since.elapsed().as_secs_f64());
            self.waiting = None;
        }
    }

    /// The session says how long a generation's predecessor went on.
    pub fn cancelled(&mut self, generation: u64, seconds: Option<f64>) {
        if let Some(seconds) = seconds
            && self.noted != generation
        {
            self.noted = generation;
            keep(&mut self.cancelled, EDITS, seconds);
        }
    }

    /// The window's own part of a frame.
    pub fn frame(&mut self, seconds: f64) {
        keep(&mut self.frames, FRAMES, seconds);
    }

    /// From an edit to the first frame that shows its picture.
    #[must_use]
    pub fn first_picture(&self) -> Option<Recent> {
        recent(&self.visible)
    }

    /// From an edit to the moment when no worker traces the old scene any more.
    #[must_use]
    pub fn cancellation(&self) -> Option<Recent> {
        recent(&self.cancelled)
    }

    /// The window's own part of a frame: reading the session, widgets, commands; without the rasteriser.
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
    fn an_edit_waits_for_its_own_picture_and_counts_once() {
        let mut latency = Latency::default();
        assert_eq!(latency.first_picture(), None);
        latency.edited(3);
        latency.shown(2);
        assert_eq!(latency.first_picture(), None, "an older picture is no answer");
        latency.shown(3);
        // Frames go on asking; an edit that was answered is not a new one.
        latency.edited(3);
        latency.shown(3);
        assert_eq!(latency.visible.len(), 1);
        latency.cancelled(3, None);
        latency.cancelled(3, Some(0.002));
        latency.cancelled(3, Some(0.002));
        assert_eq!(latency.cancelled.len(), 1);
    }

    #[test]
    fn times_are_summed_up_and_forgotten() {
        let mut latency = Latency::default();
        for i in 0..200u16 {
            latency.frame(f64::from(i));
        }
        let frames = latency.frames().unwrap();
        assert_eq!((frames.last, frames.median, frames.worst), (199.0, 140.0, 199.0));
    }
}
