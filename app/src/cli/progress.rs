//! Progress bar on a terminal, hidden if standard error is redirected.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use majorant_core::film::Snapshot;
use majorant_core::io::Loading;
use std::io::IsTerminal;

/// Progress bar of a render, by samples or by seconds.
pub(super) struct Progress {
    bar: ProgressBar,
    spp: Option<u64>,
    seconds: Option<f32>,
}

/// Creates an empty bar of this length; hidden unless standard error is a terminal.
pub(super) fn bar(length: u64) -> ProgressBar {
    let bar = ProgressBar::new(length);
    bar.set_draw_target(if std::io::stderr().is_terminal() {
        ProgressDrawTarget::stderr()
    } else {
        ProgressDrawTarget::hidden()
    });
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {elapsed}  {msg}") {
        bar.set_style(style);
    }
    bar
}

impl Progress {
    pub fn new(spp: Option<u64>, seconds: Option<f32>) -> Self {
        Self { bar: bar(1000), spp, seconds }
    }

    pub fn show(&self, snapshot: &Snapshot) {
        let by_samples = self.spp.map_or(0.0, |spp| snapshot.spp as f64 / spp as f64);
        let by_time = self.seconds.map_or(0.0, |s| snapshot.seconds / f64::from(s));
        let done = by_samples.max(by_time).clamp(0.0, 1.0);
        self.bar.set_position((done * 1000.0) as u64);
        self.bar.set_message(format!("{} spp", snapshot.spp));
    }

    /// Shows the progress of reading a file before rendering.
    pub fn read(&self, loading: &Loading) {
        self.bar.set_position((loading.fraction * 1000.0) as u64);
        self.bar.set_message(format!("reading {}", loading.file));
    }

    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}
