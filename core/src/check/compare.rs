//! From batch means to lines of the table.

use super::batches::DOF;
use super::report::{Row, Verdict};
use super::stats::{mean_and_error, power_t};
use super::{Answer, Batches, Case, Value};
use crate::estimator::Entry;

/// Relative error that single precision may leave in a mean, by which even an estimate without noise
/// may be off.
const ROUNDING: f64 = 5e-5;

/// A difference of two values with its standard error.
#[derive(Clone, Copy, Debug)]
struct Comparison {
    difference: f64,
    error: f64,
}

impl Comparison {
    fn new(measured: Value, expected: Value) -> Self {
        let rounding = ROUNDING * expected.mean.abs().max(measured.mean.abs());
        let error = measured.error.hypot(expected.error).hypot(rounding);
        Self { difference: measured.mean - expected.mean, error }
    }

    fn z(&self) -> f64 {
        // Exactly nothing seen and exactly nothing expected is no surprise.
        if self.difference == 0.0 { 0.0 } else { self.difference / self.error.max(f64::MIN_POSITIVE) }
    }
}

fn values(image: &Batches) -> Vec<Value> {
    image
        .series
        .iter()
        .map(|series| {
            let (mean, error) = mean_and_error(series);
            Value { mean, error }
        })
        .collect()
}

/// Whether a series of batch means knows its own noise. Where light is met in few batches only, the scatter
/// of what was seen tells nothing of what was missed; such a block is judged as part of the whole.
fn knows_its_noise(series: &[f64]) -> bool {
    2 * series.iter().filter(|mean| **mean != 0.0).count() >= series.len()
}

/// The z of every pair of values, the last being that of the whole image.
fn all_z(image: &Batches, other: Option<&Batches>, a: &[Value], b: &[Value]) -> Vec<f64> {
    let known = |image: &Batches, i: usize| image.series.get(i).is_some_and(|s| knows_its_noise(s));
    (a.iter().zip(b).enumerate())
        .filter(|(i, _)| known(image, *i) && other.is_none_or(|o| known(o, *i)))
        .map(|(_, (a, b))| Comparison::new(*a, *b).z())
        .collect()
}

fn worst(z: &[f64]) -> f64 {
    // What is not a number is no agreement.
    z.iter().map(|z| if z.is_nan() { f64::INFINITY } else { z.abs() }).fold(0.0, f64::max)
}

fn row(
    case: &Case,
    entry: &Entry,
    image: &Batches,
    expected: Value,
    (worst_z, critical_z): (f64, f64),
    differs_from: Vec<String>,
) -> Row {
    let (mean, error) = image.whole();
    let whole = Comparison::new(Value { mean, error }, expected);
    let blind = !image.series.last().is_some_and(|s| knows_its_noise(s));
    let seen = (critical_z + power_t(DOF)) * whole.error / expected.mean.abs();
    let verdict = match image.non_finite {
        Some(at) => at.into(),
        None if differs_from.is_empty() => Verdict::Agrees,
        None => Verdict::Differs { from: differs_from },
    };
    Row {
        scene: case.name.clone(),
        estimator: entry.id,
        mode: case.mode(),
        measured: mean,
        error,
        expected: expected.mean,
        z: whole.z(),
        worst_z,
        critical_z,
        detectable: if blind { f64::INFINITY } else { seen },
        paths: image.paths,
        verdict,
    }
}

/// Holds an image against a known answer.
pub(super) fn against_known(
    case: &Case,
    entry: &Entry,
    image: &Batches,
    known: &[Value],
    critical: f64,
) -> Row {
    let whole = Answer::Known(known.to_vec()).whole().unwrap_or(Value { mean: f64::NAN, error: 0.0 });
    let mut expected = known.to_vec();
    expected.push(whole);
    let worst_z = worst(&all_z(image, None, &values(image), &expected));
    let agrees = worst_z <= critical;
    let from = if agrees { Vec::new() } else { vec!["the answer".to_owned()] };
    row(case, entry, image, whole, (worst_z, critical), from)
}

/// Holds images of different estimators against each other.
pub(super) fn pairwise(case: &Case, images: &[(&'static Entry, Batches)], critical: f64) -> Vec<Row> {
    let all: Vec<Vec<Value>> = images.iter().map(|(_, image)| values(image)).collect();
    let mut rows = Vec::new();
    for (i, (entry, image)) in images.iter().enumerate() {
        let mut worst_z = 0.0f64;
        let mut differs_from = Vec::new();
        for (j, (other, others_image)) in images.iter().enumerate().filter(|(j, _)| *j != i) {
            let against = worst(&all_z(image, Some(others_image), &all[i], &all[j]));
            worst_z = worst_z.max(against);
            if against > critical {
                differs_from.push(other.id.to_owned());
            }
        }
        let others = pooled(all.iter().enumerate().filter(|(j, _)| *j != i).filter_map(|(_, v)| v.last()));
        let whole = all[i].last().map_or(f64::NAN, |mine| Comparison::new(*mine, others).z().abs());
        // A bias too small to be seen against any one of them may be seen against all.
        if differs_from.is_empty()
            && whole > critical
            && image.series.last().is_some_and(|s| knows_its_noise(s))
        {
            differs_from.push("the others together".to_owned());
        }
        rows.push(row(case, entry, image, others, (worst_z.max(whole), critical), differs_from));
    }
    rows
}

/// The mean of independent values by inverse variance; an estimate alone has nothing to be held against.
fn pooled<'a>(values: impl Iterator<Item = &'a Value>) -> Value {
    let (mut weights, mut sum) = (0.0, 0.0);
    for v in values {
        // An estimate without noise counts as one with the noise of its rounding.
        let error = v.error.hypot(ROUNDING * v.mean).max(f64::MIN_POSITIVE.sqrt());
        weights += 1.0 / (error * error);
        sum += v.mean / (error * error);
    }
    Value { mean: sum / weights, error: (1.0 / weights).sqrt() }
}
