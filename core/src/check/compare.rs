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
    let value = |(i, series): (usize, &Vec<f64>)| {
        let (mean, error) = mean_and_error(series);
        Value { mean, error: error.hypot(unseen(series, image.paths_of(i))) }
    };
    image.series.iter().enumerate().map(value).collect()
}

/// What a series that never changes may hide: events that occur less than three times in as many paths are missed
/// one time in twenty, and may each matter as much as everything that was seen.
fn unseen(series: &[f64], paths: u64) -> f64 {
    let (mean, _) = mean_and_error(series);
    if is_constant(series) { 3.0 * mean.abs() / paths.max(1) as f64 } else { 0.0 }
}

/// Whether batch means differ by no more than rounding.
fn is_constant(series: &[f64]) -> bool {
    let (mean, error) = mean_and_error(series);
    error * (series.len() as f64).sqrt() <= ROUNDING * mean.abs()
}

/// The largest skewness of a series of batch means whose t-test can be trusted in its far tails. Of 128
/// Gaussian means it is 0 ± 0.22; beyond 1, rare paths of great weight decide, and what was missed of them
/// shows nowhere.
const LARGEST_SKEWNESS: f64 = 1.0;

/// Whether a series of batch means knows its own noise: a path that brings light is no rarity in it, and its
/// scatter has no long tail. Otherwise the scatter of what was seen tells nothing of what was missed, and a
/// block is judged as part of the whole.
pub(super) fn knows_its_noise(series: &[f64]) -> bool {
    let n = series.len() as f64;
    let seen = series.iter().filter(|mean| **mean != 0.0).count();
    let (mean, _) = mean_and_error(series);
    let moment = |power: i32| series.iter().map(|x| (x - mean).powi(power)).sum::<f64>() / n;
    let deviation = moment(2).sqrt();
    2 * seen >= series.len()
        && (is_constant(series) || moment(3).abs() <= LARGEST_SKEWNESS * deviation.powi(3))
}

/// Beyond this detectable bias an image is too noisy for a verdict.
const TOO_NOISY: f64 = 0.25;

/// The relative bias of the whole image's mean that would be found with the stated power.
fn detectable(image: &Batches, expected: Value, critical: f64) -> f64 {
    let Some(Value { mean, error }) = values(image).pop() else { return f64::INFINITY };
    if !image.series.last().is_some_and(|s| knows_its_noise(s)) {
        return f64::INFINITY;
    }
    let whole = Comparison::new(Value { mean, error }, expected);
    (critical + power_t(DOF)) * whole.error / expected.mean.abs()
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
    let detectable = detectable(image, expected, critical_z);
    let verdict = match image.non_finite {
        Some(at) => at.into(),
        None if !differs_from.is_empty() => Verdict::Differs { from: differs_from },
        None if detectable <= TOO_NOISY => Verdict::Agrees,
        None => Verdict::Undecided,
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
        detectable,
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
    let measured = values(image);
    let mut worst_z = worst(&all_z(image, None, &measured, &expected));
    // A case is made so that its noise can be known. If it is not, as when all of the image is black, then that
    // is wrong as well, but for estimators that have a budget because they rarely meet the light.
    if let (Some(mine), None) = (measured.last(), case.budget) {
        worst_z = worst(&[worst_z, Comparison::new(*mine, whole).z()]);
    }
    let agrees = worst_z <= critical;
    let from = if agrees { Vec::new() } else { vec!["the answer".to_owned()] };
    row(case, entry, image, whole, (worst_z, critical), from)
}

/// Holds images of different estimators against each other. Those too noisy to be judged judge nobody.
pub(super) fn pairwise(case: &Case, images: &[(&'static Entry, Batches)], critical: f64) -> Vec<Row> {
    let all: Vec<Vec<Value>> = images.iter().map(|(_, image)| values(image)).collect();
    let pool = |except: usize| {
        let others = images.iter().zip(&all).enumerate().filter(|(j, _)| *j != except);
        let known =
            others.filter(|(_, ((_, image), _))| image.series.last().is_some_and(|s| knows_its_noise(s)));
        pooled(known.filter_map(|(_, (_, values))| values.last()))
    };
    let expected: Vec<Value> = (0..images.len()).map(pool).collect();
    let judged = |i: usize| detectable(&images[i].1, expected[i], critical) <= TOO_NOISY;
    let mut rows = Vec::new();
    for (i, (entry, image)) in images.iter().enumerate() {
        let mut worst_z = 0.0f64;
        let mut differs_from = Vec::new();
        for (j, (other, others_image)) in images.iter().enumerate() {
            if i == j || !judged(i) || !judged(j) {
                continue;
            }
            let against = worst(&all_z(image, Some(others_image), &all[i], &all[j]));
            worst_z = worst_z.max(against);
            if against > critical {
                differs_from.push(other.id.to_owned());
            }
        }
        if judged(i) {
            let whole = all[i].last().map_or(0.0, |mine| Comparison::new(*mine, expected[i]).z().abs());
            worst_z = worst_z.max(whole);
            // A bias too small to be seen against any one of them may be seen against all.
            if differs_from.is_empty() && whole > critical {
                differs_from.push("the others together".to_owned());
            }
        }
        rows.push(row(case, entry, image, expected[i], (worst_z, critical), differs_from));
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
