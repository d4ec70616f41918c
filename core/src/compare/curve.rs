//! Error against samples, seconds or look-ups, and the line through it.

use super::reference::Reference;
use crate::film::Snapshot;
use crate::measure::{self, Measure, Picture, Region};
use std::sync::Arc;

/// What a curve runs along.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Axis {
    /// Samples per pixel.
    #[default]
    Samples,
    /// CPU seconds of path tracing.
    Seconds,
    /// Look-ups of the medium, per pixel.
    Lookups,
}

impl Axis {
    /// Every axis, in the order that pickers show.
    pub const ALL: [Self; 3] = [Self::Samples, Self::Seconds, Self::Lookups];

    /// Its name with its unit.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Samples => "samples per pixel",
            Self::Seconds => "CPU seconds",
            Self::Lookups => "look-ups per pixel",
        }
    }
}

/// An early picture of a view, kept so that its error can be measured against whatever comes later.
#[derive(Clone, Debug)]
pub struct Checkpoint {
    /// Samples per pixel.
    pub spp: u64,
    /// CPU seconds of path tracing.
    pub cpu_seconds: f64,
    /// Look-ups per pixel.
    pub lookups: f64,
    width: usize,
    height: usize,
    mean: Vec<[f32; 3]>,
}

impl Checkpoint {
    /// Keeps a view's picture.
    #[must_use]
    pub fn of(snapshot: &Snapshot) -> Self {
        let pixels = (snapshot.width * snapshot.height).max(1) as f64;
        Self {
            spp: snapshot.spp,
            cpu_seconds: snapshot.cpu_seconds,
            lookups: snapshot.tally.lookups as f64 / pixels,
            width: snapshot.width,
            height: snapshot.height,
            mean: snapshot.mean.clone(),
        }
    }

    /// Where it stands on an axis.
    #[must_use]
    pub fn at(&self, axis: Axis) -> f64 {
        match axis {
            Axis::Samples => self.spp as f64,
            Axis::Seconds => self.cpu_seconds,
            Axis::Lookups => self.lookups,
        }
    }

    /// Its error in a region. `None` if the reference has another size.
    #[must_use]
    pub fn point(&self, measure: &Measure, reference: &Reference, region: Option<Region>) -> Option<Point> {
        let picture = Picture { width: self.width, height: self.height, pixels: &self.mean };
        let held = measure::Reference {
            picture: reference.estimate().picture,
            standard_error: reference.standard_error(),
        };
        let region = region.unwrap_or(Region::whole(self.width, self.height));
        let measured = (measure.measure)(&picture, &held, region).ok()?;
        Some(Point {
            along: Axis::ALL.map(|axis| self.at(axis)),
            value: measured.corrected(),
            error: measured.error,
        })
    }
}

/// The growing series of a view's checkpoints: each has [`Checkpoints::RATIO`] times the samples of the last.
#[derive(Clone, Debug, Default)]
pub struct Checkpoints {
    generation: u64,
    kept: Vec<Arc<Checkpoint>>,
}

impl Checkpoints {
    /// Samples of a checkpoint over those of the one before it, at least.
    pub const RATIO: f64 = 1.5;

    /// Keeps a picture if it is far enough from the last; a new generation starts over.
    pub fn observe(&mut self, snapshot: &Snapshot) {
        if snapshot.generation != self.generation {
            *self = Self { generation: snapshot.generation, kept: Vec::new() };
        }
        let due = self.kept.last().is_none_or(|c| snapshot.spp as f64 >= Self::RATIO * c.spp as f64);
        if snapshot.spp > 0 && snapshot.coarse.is_none() && due {
            self.kept.push(Arc::new(Checkpoint::of(snapshot)));
        }
    }

    /// From the first to the newest.
    #[must_use]
    pub fn kept(&self) -> &[Arc<Checkpoint>] {
        &self.kept
    }

    /// Which submission they belong to.
    #[must_use]
    pub fn generation(&self) -> u64 {
        self.generation
    }
}

/// A point of an error curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Samples, seconds and look-ups, in the order of [`Axis::ALL`].
    pub along: [f64; 3],
    /// The error, without what the reference's noise adds to it.
    pub value: f64,
    /// Its standard error.
    pub error: f64,
}

impl Point {
    /// Where it stands on an axis.
    #[must_use]
    pub fn at(&self, axis: Axis) -> f64 {
        self.along[axis as usize]
    }
}

/// A power law, `value = factor · along^slope`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// Slope in the log-log plot.
    pub slope: f64,
    /// Standard error of the slope; infinite for two points.
    pub slope_error: f64,
    /// The value at 1.
    pub factor: f64,
}

impl PowerLaw {
    /// Least squares in the logarithms; `None` below two usable points.
    #[must_use]
    pub fn fit(points: &[Point], axis: Axis) -> Option<Self> {
        let logs: Vec<(f64, f64)> = points
            .iter()
            .map(|p| (p.at(axis).ln(), p.value.ln()))
            .filter(|(x, y)| x.is_finite() && y.is_finite())
            .collect();
        let n = logs.len() as f64;
        let (mx, my) = logs.iter().fold((0.0, 0.0), |(a, b), (x, y)| (a + x / n, b + y / n));
        let sxx: f64 = logs.iter().map(|(x, _)| (x - mx).powi(2)).sum();
        let sxy: f64 = logs.iter().map(|(x, y)| (x - mx) * (y - my)).sum();
        if logs.len() < 2 || sxx <= 0.0 {
            return None;
        }
        let slope = sxy / sxx;
        let residual: f64 = logs.iter().map(|(x, y)| (y - my - slope * (x - mx)).powi(2)).sum();
        let slope_error = if logs.len() > 2 { (residual / (n - 2.0) / sxx).sqrt() } else { f64::INFINITY };
        Some(Self { slope, slope_error, factor: (my - slope * mx).exp() })
    }

    /// The value somewhere.
    #[must_use]
    pub fn at(&self, along: f64) -> f64 {
        self.factor * along.powf(self.slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_is_fitted_exactly() {
        let points: Vec<Point> = (0..5)
            .map(|i| {
                let x = 2f64.powi(i);
                Point { along: [x, 2.0 * x, 7.0 * x], value: 3.0 * x.powf(-0.5), error: 0.0 }
            })
            .collect();
        let law = PowerLaw::fit(&points, Axis::Samples).unwrap();
        assert!((law.slope + 0.5).abs() < 1e-12 && (law.factor - 3.0).abs() < 1e-12, "{law:?}");
        assert!(law.slope_error < 1e-9);
        let by_time = PowerLaw::fit(&points, Axis::Seconds).unwrap();
        assert!((by_time.at(2.0) - 3.0).abs() < 1e-9);
        assert_eq!(PowerLaw::fit(&points[..1], Axis::Samples), None);
        let zero = Point { value: 0.0, ..points[0] };
        assert_eq!(PowerLaw::fit(&[zero, points[1]], Axis::Samples), None);
    }
}
