//! Stopping criteria of a view: limits, and images whose relative error is undefined.

use crate::film::Snapshot;
use crate::scene::Limits;

/// Reason why a view has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The limit on samples per pixel was reached.
    Samples,
    /// The limit on wall-clock seconds was reached.
    Seconds,
    /// The limit on CPU seconds was reached.
    CpuSeconds,
    /// The relative standard error has reached its limit.
    RelativeError,
    /// The image is black, so that its relative error is undefined, and there is no other limit.
    Black,
    /// No pixel has a finite value, so that there is neither mean nor error, and there is no other limit.
    NotFinite,
}

impl Ending {
    /// Stable id for JSON: the key of the limit, or the fault of the image.
    #[must_use]
    pub fn id(self) -> &'static str {
        match self {
            Self::Samples => "spp",
            Self::Seconds => "seconds",
            Self::CpuSeconds => "cpu_seconds",
            Self::RelativeError => "relative_error",
            Self::Black => "black",
            Self::NotFinite => "not_finite",
        }
    }

    /// Fault of the image and its remedy; `None` where a limit was reached.
    #[must_use]
    pub fn warning(self) -> Option<&'static str> {
        match self {
            Self::Black => Some(
                "The picture is black: its relative error is not defined. Check lights and camera, or limit samples or time.",
            ),
            Self::NotFinite => Some(
                "No pixel has a finite value: its relative error is not defined. Choose another estimator, or limit samples or time.",
            ),
            _ => None,
        }
    }
}

/// Minimum samples per pixel from which the estimated error can end a view.
const LEAST_SAMPLES: u64 = 16;
/// First planned point; at 16 samples the two halves are compared.
const FIRST_POINT: u64 = 8;
/// Samples per pixel after which an image that is black, or has no finite value, is given up.
const DEGENERATE_SAMPLES: u64 = 256;
/// Largest difference between the means of the two halves of the samples, in joint standard errors.
const AGREEMENT: f64 = 2.0;

/// First planned point after `spp` samples per pixel: 8 √2ᵏ, rounded.
fn next_point(spp: u64) -> u64 {
    let points = (0..).map(|k: i32| (FIRST_POINT as f64 * 2f64.powf(0.5 * f64::from(k))).round() as u64);
    // Rounding saturates at the largest number, which has no successor.
    points.take(140).find(|point| *point > spp).unwrap_or(u64::MAX)
}

/// Stopping rule based on the estimated standard error of an image.
///
/// A naive rule stops too soon, with too dark an image, before rare paths have been sampled: neither their
/// contribution nor their variance is included yet. The error is therefore evaluated at planned points only,
/// a factor of √2 in samples apart and not before the 16th sample; it has to be small enough at two of them
/// in succession; and the means of the image over the first and the second half of the samples have to agree.
/// This makes premature stopping rarer, but cannot exclude it: for log-normal noise (σ = 1.3) in one pixel, a
/// limit of 20 % leaves a mean of 0.95, where stopping at the first small error leaves 0.87; the loss is
/// smaller with more pixels.
#[derive(Clone, Debug, Default)]
pub(super) struct ErrorTarget {
    /// Statistics at the last planned points, the newest last.
    points: Vec<Point>,
}

/// Statistics of a whole image at one point.
#[derive(Clone, Copy, Debug)]
struct Point {
    spp: u64,
    relative_error: f64,
    mean: [f64; 3],
    /// Variance of `mean`.
    variance: [f64; 3],
    degenerate: Option<Ending>,
}

impl ErrorTarget {
    /// Samples from the `spp`-th on until the next planned point.
    pub fn until_point(spp: u64) -> u64 {
        next_point(spp) - spp
    }

    /// Records an image if this is a planned point.
    pub fn note(&mut self, snapshot: &Snapshot) {
        let spp = snapshot.spp;
        if spp == 0 || next_point(spp - 1) != spp || self.points.last().is_some_and(|p| p.spp >= spp) {
            return;
        }
        // The first half of the samples ends two points earlier.
        if self.points.len() == 3 {
            self.points.remove(0);
        }
        self.points.push(Point::of(snapshot));
    }

    /// Whether the relative standard error is at most `share`.
    pub fn reached(&self, share: f64) -> bool {
        let [older, before, newest] = self.points.as_slice() else { return false };
        let good = |p: &Point| p.spp >= LEAST_SAMPLES && p.relative_error <= share;
        good(before) && good(newest) && newest.agrees_with(older)
    }

    /// Reason why the relative error will stay undefined, if it will.
    pub fn degenerate(&self) -> Option<Ending> {
        self.points.last().filter(|p| p.spp >= DEGENERATE_SAMPLES).and_then(|p| p.degenerate)
    }
}

impl Point {
    fn of(snapshot: &Snapshot) -> Self {
        let (mut mean, mut variance, mut known, mut black) = ([0.0; 3], [0.0; 3], 0u64, true);
        for (m, e) in snapshot.mean.iter().zip(&snapshot.standard_error) {
            if !m.iter().chain(e).all(|x| x.is_finite()) {
                continue;
            }
            known += 1;
            for c in 0..3 {
                mean[c] += f64::from(m[c]);
                variance[c] += f64::from(e[c]).powi(2);
                black &= m[c] == 0.0 && e[c] == 0.0;
            }
        }
        let n = known.max(1) as f64;
        let degenerate = match (known, black) {
            (0, _) => Some(Ending::NotFinite),
            (_, true) => Some(Ending::Black),
            _ => None,
        };
        Self {
            spp: snapshot.spp,
            relative_error: snapshot.relative_error(),
            mean: mean.map(|m| m / n),
            variance: variance.map(|v| v / (n * n)),
            degenerate,
        }
    }

    /// Whether the samples since an earlier point have the same mean, within the joint standard error of
    /// both.
    fn agrees_with(&self, earlier: &Self) -> bool {
        let (n, a) = (self.spp as f64, earlier.spp as f64);
        let b = n - a;
        (0..3).all(|c| {
            let since = (n * self.mean[c] - a * earlier.mean[c]) / b;
            // n times the variance of the mean is the variance of one sample.
            let joint = (n * self.variance[c] * (1.0 / a + 1.0 / b)).sqrt();
            // Images have single precision.
            let rounding = 1e-6 * self.mean[c].abs();
            (since - earlier.mean[c]).abs() <= AGREEMENT * joint + rounding
        })
    }
}

/// Reason for ending a view with these samples and times; `None` while it continues.
pub(super) fn ending(
    limits: &Limits,
    (spp, seconds, cpu_seconds): (u64, f64, f64),
    target: &ErrorTarget,
) -> Option<Ending> {
    let reached = [
        (limits.spp.is_some_and(|limit| spp >= limit), Ending::Samples),
        (limits.seconds.is_some_and(|limit| seconds >= f64::from(limit)), Ending::Seconds),
        (limits.cpu_seconds.is_some_and(|limit| cpu_seconds >= f64::from(limit)), Ending::CpuSeconds),
        (limits.relative_error.is_some_and(|share| target.reached(share.into())), Ending::RelativeError),
    ];
    let alone = *limits == Limits { relative_error: limits.relative_error, ..Limits::default() };
    let first = reached.into_iter().find(|(reached, _)| *reached).map(|(_, ending)| ending);
    first.or_else(|| target.degenerate().filter(|_| alone && limits.relative_error.is_some()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Film, Images, Tally};
    use crate::math::Sampler;

    #[test]
    fn points_are_planned_a_factor_of_the_root_of_two_apart() {
        let mut spp = 0;
        let points: Vec<u64> = std::iter::repeat_with(|| {
            spp = next_point(spp);
            spp
        })
        .take(9)
        .collect();
        assert_eq!(points, [8, 11, 16, 23, 32, 45, 64, 91, 128]);
        // For any number of samples there is a later point, or none.
        for spp in [u64::from(u32::MAX), 1 << 40, u64::MAX / 2, u64::MAX - 1] {
            assert!(next_point(spp) > spp);
            assert!(ErrorTarget::until_point(spp) > 0);
        }
    }

    fn snapshot(film: &Film, spp: u64) -> Snapshot {
        let Images { mean, standard_error, noise } = Images::of(film);
        Snapshot {
            generation: 1,
            width: film.width,
            height: film.height,
            mean,
            standard_error,
            noise,
            spp,
            coarse: None,
            seconds: 1.0,
            cpu_seconds: 1.0,
            tally: Tally::default(),
            threads: 1,
            cost_error: 0.0,
            target: String::new(),
        }
    }

    /// Number of samples after which a film of `pixels` pixels ends, and the reason; `None` if not within
    /// `most`.
    fn end(share: f32, pixels: usize, most: u64, sample: impl Fn(u64, u64) -> f32) -> Option<(u64, Ending)> {
        let limits = Limits { relative_error: Some(share), ..Limits::default() };
        let (mut film, mut target) = (Film::new(pixels, 1), ErrorTarget::default());
        for spp in 1..=most {
            for (i, pixel) in film.pixels.iter_mut().enumerate() {
                let value = sample(i as u64, spp - 1);
                if value.is_finite() {
                    pixel.add([value; 3]);
                }
            }
            target.note(&snapshot(&film, spp));
            if let Some(ending) = ending(&limits, (spp, 1.0, 1.0), &target) {
                return Some((spp, ending));
            }
        }
        None
    }

    #[test]
    fn a_picture_without_noise_ends_at_the_first_points_that_may_end_it() {
        assert_eq!(end(0.01, 4, 100, |_, _| 0.5), Some((23, Ending::RelativeError)));
    }

    #[test]
    fn a_black_picture_and_one_without_values_end_with_their_reason() {
        assert_eq!(end(0.01, 4, 300, |_, _| 0.0), Some((256, Ending::Black)));
        assert_eq!(end(0.01, 4, 300, |_, _| f32::NAN), Some((256, Ending::NotFinite)));
        // A pixel with one non-zero sample is not black.
        let once = |pixel, sample| if (pixel, sample) == (2, 100) { 1.0 } else { 0.0 };
        assert_eq!(end(0.01, 4, 300, once), None);
    }

    #[test]
    fn other_limits_hold_for_a_black_picture() {
        let film = Film::new(2, 2);
        let mut target = ErrorTarget::default();
        let mut black = film.clone();
        black.pixels.iter_mut().for_each(|p| (0..256).for_each(|_| p.add([0.0; 3])));
        target.note(&snapshot(&black, 256));
        let both = Limits { spp: Some(1 << 40), relative_error: Some(0.1), ..Limits::default() };
        assert_eq!(ending(&both, (256, 1.0, 1.0), &target), None);
        assert_eq!(ending(&both, (1 << 40, 1.0, 1.0), &target), Some(Ending::Samples));
        assert_eq!(ending(&Limits::default(), (256, 1.0, 1.0), &target), None);
    }

    /// Samples of both signs whose mean is negative at first. A signed ratio of error to mean would be below
    /// any limit.
    #[test]
    fn a_negative_mean_is_no_small_error() {
        let signed = |pixel, sample| {
            let noise = Sampler::new(3, pixel, sample).next_1d() - 0.5;
            // The first samples are negative; all later ones compensate for them.
            0.05 + 4.0 * noise - if sample < 8 { 3.0 } else { 0.0 }
        };
        assert_eq!(end(0.02, 16, 3000, signed), None);
        // A negative image, such as a difference, ends as its opposite does.
        let of = |sign: f32| {
            end(0.02, 16, 4000, move |pixel, sample| sign * (1.0 + Sampler::new(4, pixel, sample).next_1d()))
        };
        assert_eq!(of(1.0), of(-1.0));
        assert!(of(-1.0).is_some_and(|(_, ending)| ending == Ending::RelativeError));
    }

    /// Constant until rare paths are sampled: the error of the first samples is 0.
    #[test]
    fn late_contributions_are_detected_by_comparing_halves() {
        let late = |pixel, sample| {
            if sample < 20 { 1.0 } else { 2.0 * Sampler::new(5, pixel, sample).next_optical_depth() }
        };
        let (spp, ending) = end(0.02, 64, 10_000, late).unwrap();
        assert!(spp > 100 && ending == Ending::RelativeError, "{spp}");
    }

    /// Skewed noise as in light transport: a log-normal of mean 1. At the first sample with an error of 30 %
    /// the mean is a fifth too dark; with the planned rule, less than a tenth.
    #[test]
    fn the_planned_rule_is_less_dark_than_the_first_good_error() {
        const SHARE: f32 = 0.3;
        const RUNS: u64 = 1000;
        const SIGMA: f32 = 1.3;
        let sample = |seed: u64, number: u64| {
            let mut numbers = Sampler::new(seed, 0, number);
            let normal = (2.0 * numbers.next_optical_depth()).sqrt();
            (SIGMA * normal * (std::f32::consts::TAU * numbers.next_1d()).cos() - 0.5 * SIGMA * SIGMA).exp()
        };
        let (mut planned, mut eager) = (0.0, 0.0);
        for seed in 0..RUNS {
            let (spp, _) = end(SHARE, 1, 100_000, |_, s| sample(seed, s)).unwrap();
            planned += (0..spp).map(|s| f64::from(sample(seed, s))).sum::<f64>() / spp as f64 / RUNS as f64;
            let mut film = Film::new(1, 1);
            let first = (1..).find(|n| {
                film.pixels[0].add([sample(seed, n - 1); 3]);
                snapshot(&film, *n).relative_error() <= f64::from(SHARE)
            });
            assert!(first.is_some());
            eager += film.pixels[0].mean[0] / RUNS as f64;
        }
        assert!(eager < 0.86 && (0.9..1.0).contains(&planned), "{eager} {planned}");
    }
}
