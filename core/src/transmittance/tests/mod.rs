//! Comparison of every technique with closed forms.

mod in_medium;

use super::*;
use crate::spectrum::Sampled;

/// Largest accepted deviation of a mean, in standard errors. Seeds are fixed, so that the tests are
/// deterministic.
const LIMIT: f64 = 4.0;

/// Mean of an estimator, its standard error, and the mean number of look-ups.
struct Measured<const N: usize> {
    mean: [f64; N],
    error: [f64; N],
    lookups: f64,
}

impl<const N: usize> Measured<N> {
    fn of(samples: u32, seed: u64, estimate: impl Fn(&mut Sampler) -> Estimate<N>) -> Self {
        let (mut sum, mut squares, mut lookups) = ([0.0; N], [0.0; N], 0.0);
        for i in 0..samples {
            let found = estimate(&mut Sampler::new(seed, u64::from(i), 0));
            for c in 0..N {
                let weight = f64::from(found.weight[c]);
                sum[c] += weight;
                squares[c] += weight * weight;
            }
            lookups += f64::from(found.lookups);
        }
        let n = f64::from(samples);
        let mean = sum.map(|s| s / n);
        let error =
            std::array::from_fn(|c| ((squares[c] / n - mean[c] * mean[c]).max(0.0) / (n - 1.0)).sqrt());
        Self { mean, error, lookups: lookups / n }
    }

    /// Largest deviation in standard errors, with a tolerance of one part in 10⁵ for single precision.
    fn deviation(&self, truth: [f64; N]) -> f64 {
        let each = (0..N).map(|c| {
            let off = (self.mean[c] - truth[c]).abs();
            (off - 1e-5 * truth[c]).max(0.0) / self.error[c].max(1e-12 * truth[c])
        });
        each.fold(0.0, f64::max)
    }

    /// Largest standard error relative to the truth: the bias that could be detected.
    fn blur(&self, truth: [f64; N]) -> f64 {
        (0..N).map(|c| self.error[c] / truth[c]).fold(0.0, f64::max)
    }
}

fn unbiased() -> impl Iterator<Item = TransmittanceKind> {
    TransmittanceKind::all().into_iter().filter(|kind| kind.entry().unbiased)
}

fn holds<const N: usize>(kind: TransmittanceKind, profile: &Analytic<N>, samples: u32, blur: f64) {
    let truth = profile.transmittance();
    let found = Measured::of(samples, 11, |sampler| kind.estimate(profile, sampler));
    let what =
        format!("{} {profile:?}: {:?} ± {:?}, not {truth:?}", kind.entry().id, found.mean, found.error);
    assert!(found.deviation(truth) < LIMIT, "{what}");
    assert!(found.blur(truth) < blur, "too noisy to decide: {what}");
}

#[test]
fn unbiased_techniques_have_the_transmittance_as_their_mean() {
    for kind in unbiased() {
        for shape in Shape::ALL {
            for (depth, samples) in [(0.2, 10_000), (1.5, 30_000), (4.0, 100_000)] {
                for cells in [1, 7] {
                    let extinction = (depth / shape.integral(1.0)) as f32;
                    holds(kind, &Analytic::new(shape, [extinction], cells), samples, 0.03);
                }
            }
        }
    }
}

#[test]
fn components_that_share_their_look_ups_each_have_their_own_mean() {
    for kind in unbiased() {
        for cells in [1, 6] {
            // Proportional components, with a hero neither the thinnest nor the densest.
            holds(kind, &Analytic::new(Shape::Gaussian, [6.0, 2.0, 9.0, 4.0], cells), 100_000, 0.03);
            // A different medium for every component.
            let components = [(Shape::Ramp, 3.0), (Shape::Cosine, 2.0), (Shape::Hole, 1.5)];
            let profile = Analytic { components, length: 1.3, cells, majorant_factor: 1.2 };
            holds(kind, &profile, 100_000, 0.03);
        }
    }
}

#[test]
fn majorants_that_do_not_bound_leave_the_mean_alone() {
    for kind in unbiased() {
        for shape in Shape::ALL {
            for cells in [1, 5] {
                let mut profile = Analytic::new(shape, [1.5, 2.0, 1.0], cells);
                profile.majorant_factor = 0.6;
                holds(kind, &profile, 200_000, 0.03);
            }
        }
        let mut loose = Analytic::new(Shape::Cosine, [2.0], 3);
        loose.majorant_factor = 4.0;
        holds(kind, &loose, 40_000, 0.03);
    }
}

/// Length and depth beyond those of one block, with many cells.
#[test]
fn long_and_dense_rays_through_many_cells_come_out_right() {
    let components = [(Shape::Cosine, 0.35), (Shape::Cosine, 0.3)];
    for kind in unbiased().filter(|kind| *kind != TransmittanceKind::DeltaTracking(DeltaTracking)) {
        for (cells, factor) in [(100, 1.0), (3, 2.0)] {
            let profile = Analytic { components, length: 30.0, cells, majorant_factor: factor };
            holds(kind, &profile, 100_000, 0.1);
        }
    }
}

#[test]
fn constant_extinction_is_exact_where_the_technique_says_so() {
    let profile = Analytic::new(Shape::Constant, [3.0, 1.0], 4);
    let truth = profile.transmittance();
    for id in ["residual-ratio", "unbiased-marching", "marching"] {
        let kind = TransmittanceKind::find(id).unwrap();
        for i in 0..1000 {
            let found = kind.estimate(&profile, &mut Sampler::new(3, i, 0));
            for (weight, exact) in found.weight.0.into_iter().zip(truth) {
                assert!((f64::from(weight) / exact - 1.0).abs() < 1e-4, "{id}: {found:?}");
            }
        }
    }
}

#[test]
fn empty_rays_pass_everything_and_cost_nothing() {
    let empty = Analytic::new(Shape::Ramp, [0.0; 3], 4);
    for kind in TransmittanceKind::all() {
        let found = kind.estimate(&empty, &mut Sampler::new(1, 0, 0));
        assert_eq!((found.weight, found.lookups), (Sampled::ONE, 0), "{}", kind.entry().id);
    }
}

/// The bias is significant at a coarse step and negligible at a fine one.
#[test]
fn marching_is_biased_by_its_step() {
    let profile = Analytic::new(Shape::Cosine, [6.0], 1);
    let truth = profile.transmittance();
    let at = |step, offset| {
        let technique = Marching { step, offset };
        Measured::of(200_000, 5, |sampler| technique.estimate(&profile, sampler))
    };
    let coarse = at(0.34, Offset::Jittered);
    assert!(coarse.deviation(truth) > 20.0, "{}", coarse.deviation(truth));
    // By Jensen's inequality the estimate is too bright.
    assert!(coarse.mean[0] > truth[0] + 10.0 * coarse.error[0]);
    let fine = at(0.002, Offset::Jittered);
    assert!(fine.deviation(truth) < LIMIT, "{}", fine.deviation(truth));
    let bias = |found: Measured<1>| (found.mean[0] / truth[0] - 1.0).abs();
    assert!(bias(fine) < 0.01 * bias(coarse));
    // The unbiased variant passes the same test at a similar cost.
    let other = UnbiasedMarching::default();
    let found = Measured::of(200_000, 5, |sampler| other.estimate(&profile, sampler));
    assert!(found.deviation(truth) < LIMIT && found.blur(truth) < 0.01);
}

/// Without random numbers the only error is the bias.
#[test]
fn marching_by_midpoints_is_one_number_and_wrong() {
    let profile = Analytic::new(Shape::Gaussian, [8.0], 1);
    let at = |step| {
        let technique = Marching { step, offset: Offset::Midpoint };
        let found = technique.estimate(&profile, &mut Sampler::new(1, 0, 0));
        assert_eq!(found, technique.estimate(&profile, &mut Sampler::new(2, 0, 0)));
        (f64::from(found.weight[0]) / profile.transmittance()[0] - 1.0, found.lookups)
    };
    let [(rough, three), (smooth, many)] = [0.34, 0.002].map(at);
    assert!(rough < -0.3 && smooth.abs() < 1e-4, "{rough} {smooth}");
    assert_eq!((three, many), (3, 500));
}

/// Profiles wrong by 2 % stand for wrong weights; the test detects them under every technique.
#[test]
fn a_weight_that_is_wrong_by_two_percent_is_seen() {
    #[derive(Clone, Copy)]
    struct Wrong(Analytic<1>);
    impl Profile<1> for Wrong {
        type Pieces<'a> = AnalyticPieces<'a, 1>;
        fn pieces(&self) -> AnalyticPieces<'_, 1> {
            self.0.pieces()
        }
        fn extinction(&self, t: f32, piece: &Piece<1>) -> Sampled<1> {
            self.0.extinction(t, piece) * 1.02
        }
    }
    let mut right = Analytic::new(Shape::Gaussian, [6.0], 4);
    right.majorant_factor = 1.1;
    let truth = right.transmittance();
    for kind in unbiased() {
        let found = Measured::of(400_000, 11, |sampler| kind.estimate(&Wrong(right), sampler));
        assert!(found.deviation(truth) > 2.0 * LIMIT, "{}: {}", kind.entry().id, found.deviation(truth));
    }
}

/// Order of variances by the entries' summaries: weights beat decisions, and marching beats both.
#[test]
fn techniques_keep_the_order_of_their_variances() {
    let profile = Analytic::new(Shape::Gaussian, [8.0], 8);
    let truth = profile.transmittance();
    let of = |id: &str| {
        let kind = TransmittanceKind::find(id).unwrap();
        Measured::of(40_000, 9, |sampler| kind.estimate(&profile, sampler))
    };
    let [delta, ratio, residual, marching] =
        ["delta", "ratio", "residual-ratio", "unbiased-marching"].map(of);
    assert!(ratio.error[0] < 0.8 * delta.error[0]);
    assert!(residual.error[0] < 0.8 * ratio.error[0] && residual.lookups < ratio.lookups);
    assert!(marching.error[0] < 0.3 * ratio.error[0], "{} {}", marching.error[0], ratio.error[0]);
    // Delta tracking returns 0 or 1.
    let coin = (truth[0] * (1.0 - truth[0]) / 39_999.0).sqrt();
    assert!((delta.error[0] / coin - 1.0).abs() < 0.02);
    // Ratio tracking looks up once per unit of majorant depth.
    let depth: f64 = profile.pieces().map(|p| f64::from(p.largest_majorant() * p.length())).sum();
    assert!((ratio.lookups / depth - 1.0).abs() < 0.02);
}

#[test]
fn entries_have_ids_of_their_own_and_are_found_by_them() {
    let all = TransmittanceKind::all();
    for kind in &all {
        assert_eq!(TransmittanceKind::find(kind.entry().id), Some(*kind));
        assert_eq!(all.iter().filter(|k| k.entry().name == kind.entry().name).count(), 1);
    }
    assert_eq!(TransmittanceKind::find("magic"), None);
    assert!(all.iter().any(|kind| !kind.entry().unbiased));
}
