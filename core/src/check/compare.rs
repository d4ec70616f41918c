//! Comparison of batch means with expected values and with each other.

use super::batches::DOF;
use super::report::{Row, Verdict};
use super::stats::{mean_and_error, power_t};
use super::{Answer, Batches, Case, Value};
use crate::estimator::Entry;

/// Relative rounding error of single precision in a mean, which applies even to an estimate without noise.
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
        // Equal values agree even if their error is 0.
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

/// Upper bound on events missed by a constant series: events that occur less often than three times in its
/// number of paths are missed with a probability of 5 %, and each may contribute as much as the whole mean.
fn unseen(series: &[f64], paths: u64) -> f64 {
    let (mean, _) = mean_and_error(series);
    if is_constant(series) { 3.0 * mean.abs() / paths.max(1) as f64 } else { 0.0 }
}

/// Whether batch means differ by rounding only.
fn is_constant(series: &[f64]) -> bool {
    let (mean, error) = mean_and_error(series);
    error * (series.len() as f64).sqrt() <= ROUNDING * mean.abs()
}

/// Largest skewness of a series of batch means for which the far tails of the t-test are reliable. For 128
/// Gaussian means the skewness is 0 ± 0.22; beyond 1, rare paths of large weight dominate, and the scatter
/// does not reveal how many were missed.
const LARGEST_SKEWNESS: f64 = 1.0;

/// Whether the scatter of a series of batch means is a reliable noise estimate: most batches have a
/// contribution, and their distribution has no long tail. Otherwise the observed scatter does not reveal
/// missed contributions, and a block is tested as part of the whole only.
pub(super) fn noise_is_reliable(series: &[f64]) -> bool {
    let n = series.len() as f64;
    let seen = series.iter().filter(|mean| **mean != 0.0).count();
    let (mean, _) = mean_and_error(series);
    let moment = |power: i32| series.iter().map(|x| (x - mean).powi(power)).sum::<f64>() / n;
    let deviation = moment(2).sqrt();
    2 * seen >= series.len()
        && (is_constant(series) || moment(3).abs() <= LARGEST_SKEWNESS * deviation.powi(3))
}

/// Relative detectable bias beyond which an image is too noisy for a verdict.
const TOO_NOISY: f64 = 0.25;

/// Relative bias of the image mean that would be detected with probability [`super::stats::POWER`].
fn detectable(image: &Batches, expected: Value, critical: f64) -> f64 {
    let Some(Value { mean, error }) = values(image).pop() else { return f64::INFINITY };
    if !image.series.last().is_some_and(|s| noise_is_reliable(s)) {
        return f64::INFINITY;
    }
    let whole = Comparison::new(Value { mean, error }, expected);
    (critical + power_t(DOF)) * whole.error / expected.mean.abs()
}

/// z of every pair of values; the last is that of the whole image.
fn all_z(image: &Batches, other: Option<&Batches>, a: &[Value], b: &[Value]) -> Vec<f64> {
    let known = |image: &Batches, i: usize| image.series.get(i).is_some_and(|s| noise_is_reliable(s));
    (a.iter().zip(b).enumerate())
        .filter(|(i, _)| known(image, *i) && other.is_none_or(|o| known(o, *i)))
        .map(|(_, (a, b))| Comparison::new(*a, *b).z())
        .collect()
}

fn worst(z: &[f64]) -> f64 {
    // NaN counts as a difference.
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

/// Compares an image with a known answer.
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
    // A case is designed so that its noise can be estimated. If it cannot, as for a black image, the image
    // fails as well, except for estimators with a budget because they rarely hit a light.
    if let (Some(mine), None) = (measured.last(), case.budget) {
        worst_z = worst(&[worst_z, Comparison::new(*mine, whole).z()]);
    }
    let agrees = worst_z <= critical;
    let from = if agrees { Vec::new() } else { vec!["the answer".to_owned()] };
    row(case, entry, image, whole, (worst_z, critical), from)
}

/// Compares images of different estimators. Images that are too noisy are not used in comparisons.
pub(super) fn pairwise(case: &Case, images: &[(&'static Entry, Batches)], critical: f64) -> Vec<Row> {
    let all: Vec<Vec<Value>> = images.iter().map(|(_, image)| values(image)).collect();
    let pool = |except: usize| {
        let others = images.iter().zip(&all).enumerate().filter(|(j, _)| *j != except);
        let known =
            others.filter(|(_, ((_, image), _))| image.series.last().is_some_and(|s| noise_is_reliable(s)));
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
            // A bias too small to be detected against any single estimator may be detected against all.
            if differs_from.is_empty() && whole > critical {
                differs_from.push("the others together".to_owned());
            }
        }
        rows.push(row(case, entry, image, expected[i], (worst_z, critical), differs_from));
    }
    rows
}

/// Mean of independent values, weighted by inverse variance; NaN without values.
fn pooled<'a>(values: impl Iterator<Item = &'a Value>) -> Value {
    let (mut weights, mut sum) = (0.0, 0.0);
    for v in values {
        // An estimate without noise has the error of its rounding.
        let error = v.error.hypot(ROUNDING * v.mean).max(f64::MIN_POSITIVE.sqrt());
        weights += 1.0 / (error * error);
        sum += v.mean / (error * error);
    }
    Value { mean: sum / weights, error: (1.0 / weights).sqrt() }
}
