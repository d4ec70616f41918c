//! Error curves over samples, seconds or look-ups, and fitted power laws.

use super::reference::Reference;
use crate::film::Snapshot;
use crate::measure::{self, Measure, Picture, Region};
use std::sync::Arc;

/// Horizontal axis of an error curve.
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
    /// All axes, in display order.
    pub const ALL: [Self; 3] = [Self::Samples, Self::Seconds, Self::Lookups];

    /// Name with its unit.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Samples => "samples per pixel",
            Self::Seconds => "CPU seconds",
            Self::Lookups => "look-ups per pixel",
        }
    }
}

/// An early image of a view, kept so that its error can be measured against later references.
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
    /// Keeps the image of a view.
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

    /// Position on an axis.
    #[must_use]
    pub fn at(&self, axis: Axis) -> f64 {
        match axis {
            Axis::Samples => self.spp as f64,
            Axis::Seconds => self.cpu_seconds,
            Axis::Lookups => self.lookups,
        }
    }

    /// Error in a region. `None` if the reference has a different size.
    #[must_use]
    pub fn point(&self, measure: &Measure, reference: &Reference, region: Option<Region>) -> Option<Point> {
        let picture = Picture { width: self.width, height: self.height, pixels: &self.mean };
        let held = measure::ReferencePicture {
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

/// Checkpoints of a view in geometric progression: each has at least [`Checkpoints::RATIO`] times the samples
/// of its predecessor.
#[derive(Clone, Debug, Default)]
pub struct Checkpoints {
    generation: u64,
    kept: Vec<Arc<Checkpoint>>,
}

impl Checkpoints {
    /// Minimum ratio of the samples of successive checkpoints.
    pub const RATIO: f64 = 1.5;

    /// Keeps an image if it is due; a new generation starts over.
    pub fn observe(&mut self, snapshot: &Snapshot) {
        if snapshot.generation != self.generation {
            *self = Self { generation: snapshot.generation, kept: Vec::new() };
        }
        let due = self.kept.last().is_none_or(|c| snapshot.spp as f64 >= Self::RATIO * c.spp as f64);
        if snapshot.spp > 0 && snapshot.coarse.is_none() && due {
            self.kept.push(Arc::new(Checkpoint::of(snapshot)));
        }
    }

    /// Checkpoints from the first to the newest.
    #[must_use]
    pub fn kept(&self) -> &[Arc<Checkpoint>] {
        &self.kept
    }

    /// Generation that they belong to.
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
    /// Error, corrected for the noise of the reference.
    pub value: f64,
    /// Standard error of `value`.
    pub error: f64,
}

impl Point {
    /// Position on an axis.
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
    /// Value at 1.
    pub factor: f64,
}

impl PowerLaw {
    /// Fits by least squares in the logarithms; `None` with fewer than two usable points.
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

    /// Value at a position.
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
