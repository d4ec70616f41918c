//! Rates and estimated times for display, derived from the state of a view.

use majorant_core::scene::RenderDoc;
use majorant_core::session::ViewState;

/// Rates, progress and estimated times of a view.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stats {
    /// Samples per pixel of the newest image.
    pub spp: u64,
    /// Rendering time in seconds.
    pub seconds: f64,
    /// Samples per pixel per second.
    pub spp_per_second: Option<f64>,
    /// Look-ups of the medium per second.
    pub lookups_per_second: Option<f64>,
    /// Look-ups of the medium per path.
    pub lookups_per_path: Option<f64>,
    /// Fraction of look-ups at which the extinction exceeded the majorant.
    pub exceeded: Option<f64>,
    /// Standard error relative to the image mean; measured only if it is a limit.
    pub relative_error: Option<f64>,
    /// Progress to the nearest limit, from 0 to 1.
    pub progress: Option<f32>,
    /// Estimated time to the nearest limit, in seconds.
    pub eta_seconds: Option<f64>,
    /// Number of non-finite samples.
    pub non_finite: u64,
}

impl Stats {
    /// Derives the statistics from a state and its limits. `relative_error` is that of the state's image, if
    /// it is one of the limits.
    #[must_use]
    pub fn new(state: &ViewState, limits: &RenderDoc, relative_error: Option<f64>) -> Self {
        // An image of an older submission is not evidence about this one.
        let Some(snapshot) = state.snapshot.as_ref().filter(|s| s.generation == state.generation) else {
            return Self::default();
        };
        let per = |amount: f64, of: f64| (amount > 0.0 && of > 0.0).then(|| amount / of);
        let (spp, seconds) = (snapshot.spp as f64, snapshot.seconds);
        let spp_per_second = per(spp, seconds);
        let lookups = snapshot.tally.lookups as f64;
        let by_samples = limits
            .spp
            .map(|limit| (spp / limit.max(1) as f64, spp_per_second.map(|rate| (limit as f64 - spp) / rate)));
        // Remaining seconds at the rate so far, from the progress.
        let left = |progress: f64| (progress > 0.0).then(|| seconds * (1.0 / progress - 1.0));
        let by_time =
            limits.seconds.map(f64::from).map(|limit| (seconds / limit.max(1e-9), Some(limit - seconds)));
        let by_cpu = limits.cpu_seconds.map(|limit| {
            let progress = snapshot.cpu_seconds / f64::from(limit).max(1e-9);
            (progress, left(progress))
        });
        // Errors decrease with the square root of the time.
        let by_error = limits.relative_error.zip(relative_error).map(|(limit, error)| {
            let progress = if error.is_nan() { 0.0 } else { (f64::from(limit) / error).powi(2) };
            (progress, left(progress))
        });
        let limits = [by_samples, by_time, by_cpu, by_error];
        let progress = limits.iter().flatten().map(|(progress, _)| *progress).reduce(f64::max);
        let eta = limits.iter().flatten().filter_map(|(_, eta)| *eta).reduce(f64::min);
        Self {
            spp: snapshot.spp,
            seconds,
            spp_per_second,
            lookups_per_second: per(lookups, seconds),
            lookups_per_path: per(lookups, snapshot.tally.paths as f64),
            relative_error,
            exceeded: per(snapshot.tally.exceeded as f64, lookups),
            progress: progress.map(|p| p.clamp(0.0, 1.0) as f32),
            eta_seconds: eta.map(|eta| eta.max(0.0)),
            non_finite: snapshot.tally.non_finite,
        }
    }
}

/// Formats a number with three significant digits and a metric prefix, as `12.3 M`.
#[must_use]
pub fn count(value: f64) -> String {
    // Integers are shown without decimals.
    if value.fract() == 0.0 && value.abs() < 1e4 {
        return format!("{value:.0}");
    }
    let (scaled, prefix) = match value.abs() {
        v if v >= 1e9 => (value / 1e9, " G"),
        v if v >= 1e6 => (value / 1e6, " M"),
        v if v >= 1e4 => (value / 1e3, " k"),
        _ => (value, ""),
    };
    let decimals = match scaled.abs() {
        v if v >= 99.95 => 0,
        v if v >= 9.995 => 1,
        _ => 2,
    };
    format!("{scaled:.decimals$}{prefix}")
}

/// Formats a duration in seconds, as `12.3 s`, `4 min 05 s` or `2 h 07 min`.
#[must_use]
pub fn duration(seconds: f64) -> String {
    let whole = seconds.max(0.0).round() as u64;
    match whole {
        0..60 => format!("{:.1} s", seconds.max(0.0)),
        60..3600 => format!("{} min {:02} s", whole / 60, whole % 60),
        _ => format!("{} h {:02} min", whole / 3600, whole / 60 % 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use majorant_core::film::{Snapshot, Tally};
    use majorant_core::session::Status;
    use std::sync::Arc;

    fn state(spp: u64, seconds: f64) -> ViewState {
        let snapshot = Snapshot {
            generation: 3,
            width: 2,
            height: 1,
            mean: vec![[0.0; 3]; 2],
            standard_error: vec![[0.0; 3]; 2],
            noise: Vec::new(),
            spp,
            coarse: None,
            seconds,
            cpu_seconds: seconds,
            tally: Tally { paths: 2 * spp, lookups: 20 * spp, ..Tally::default() },
            threads: 1,
            cost_error: 0.0,
            target: String::new(),
        };
        ViewState {
            generation: 3,
            status: Status::Rendering,
            ending: None,
            loading: None,
            built: 3,
            snapshot: Some(Arc::new(snapshot)),
            notices: Vec::new(),
            first_picture_seconds: None,
            cancelled_seconds: None,
            scene: None,
            probe: None,
        }
    }

    #[test]
    fn the_nearest_limit_counts() {
        let limits = RenderDoc { spp: Some(100), seconds: Some(4.0), ..RenderDoc::default() };
        let stats = Stats::new(&state(10, 2.0), &limits, None);
        assert_eq!(stats.spp_per_second, Some(5.0));
        assert_eq!(stats.lookups_per_path, Some(10.0));
        assert_eq!(stats.progress, Some(0.5));
        assert_eq!(stats.eta_seconds, Some(2.0));
        let endless = RenderDoc { spp: None, seconds: None, ..limits };
        assert_eq!(Stats::new(&state(10, 2.0), &endless, None).eta_seconds, None);
        // A quarter of the CPU time was used in 2 seconds; half the error takes four times as long.
        let by_cpu = RenderDoc { cpu_seconds: Some(8.0), ..endless.clone() };
        let stats = Stats::new(&state(10, 2.0), &by_cpu, None);
        assert_eq!((stats.progress, stats.eta_seconds), (Some(0.25), Some(6.0)));
        let by_error = RenderDoc { relative_error: Some(0.125), ..endless };
        let stats = Stats::new(&state(10, 2.0), &by_error, Some(0.25));
        assert_eq!((stats.progress, stats.eta_seconds), (Some(0.25), Some(6.0)));
        assert_eq!(Stats::new(&state(10, 2.0), &by_error, Some(f64::NAN)).progress, Some(0.0));
        assert_eq!(Stats::new(&state(10, 2.0), &by_error, Some(f64::INFINITY)).eta_seconds, None);
    }

    #[test]
    fn an_old_image_has_no_rates() {
        let mut old = state(10, 2.0);
        old.generation = 4;
        assert_eq!(Stats::new(&old, &RenderDoc::default(), None), Stats::default());
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!(count(1.5), "1.50");
        assert_eq!(count(64.0), "64");
        assert_eq!(count(12_345.0), "12.3 k");
        assert_eq!(count(123_456_789.0), "123 M");
        assert_eq!(duration(5.25), "5.2 s");
        assert_eq!(duration(245.0), "4 min 05 s");
        assert_eq!(duration(7620.0), "2 h 07 min");
    }
}
