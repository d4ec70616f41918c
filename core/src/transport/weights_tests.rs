//! The rescaled weights against plain products in double precision, and against Miller's pairwise form.

use super::PathWeights;
use crate::medium::{Coefficients, MajorantSegment};
use crate::scene::Absorption;
use crate::spectrum::Sampled;
use crate::transport::Collision;
use glam::Vec3;
use proptest::prelude::*;

const N: usize = 3;

/// What may happen to a path, with what it happens by.
#[derive(Clone, Debug)]
enum Step {
    Pass { majorant: [f32; N], distance: f32 },
    Null { extinction: [f32; N], albedo: [f32; N], majorant: [f32; N] },
    Scatter { extinction: [f32; N], albedo: [f32; N], majorant: [f32; N], phase: f32 },
}

/// f, p_uni and p_nee as they are defined, in double precision.
#[derive(Clone, Copy)]
struct Plain {
    f: [f64; N],
    uni: [f64; N],
    nee: [f64; N],
}

fn collision(
    extinction: [f32; N],
    albedo: [f32; N],
    majorant: [f32; N],
    absorption: Absorption,
) -> Collision<N> {
    let segment = MajorantSegment { t0: 0.0, t1: 1.0, majorant: Sampled(majorant), clamp_null: false };
    Collision::new(Vec3::ZERO, Coefficients::new(Sampled(extinction), Sampled(albedo), &segment), absorption)
}

impl Plain {
    /// Applies one line of the table of events, straight from the definitions.
    fn apply(&mut self, step: &Step, analogue: bool) {
        for i in 0..N {
            match *step {
                Step::Pass { majorant, distance } => {
                    let factor = (-f64::from(majorant[i]) * f64::from(distance)).exp();
                    self.f[i] *= factor;
                    self.uni[i] *= factor;
                    self.nee[i] *= factor;
                }
                Step::Null { extinction, majorant, .. } => {
                    let (t, m) = (f64::from(extinction[i]), f64::from(majorant[i]));
                    let null = m - t;
                    self.f[i] *= null;
                    self.uni[i] *= null.abs() * m / (t + null.abs());
                    self.nee[i] *= m;
                }
                Step::Scatter { extinction, albedo, majorant, phase } => {
                    let (t, m) = (f64::from(extinction[i]), f64::from(majorant[i]));
                    let k = m / (t + (m - t).abs());
                    let scattering = t * f64::from(albedo[i]);
                    self.f[i] *= scattering * f64::from(phase);
                    let before = self.uni[i] * if analogue { scattering } else { t } * k;
                    // The light's density takes the place of the phase function's.
                    self.nee[i] = before;
                    self.uni[i] = before * f64::from(phase);
                }
            }
        }
    }
}

fn apply(path: &mut PathWeights<N>, step: &Step, absorption: Absorption) {
    match *step {
        Step::Pass { majorant, distance } => path.pass(Sampled(majorant), distance),
        Step::Null { extinction, albedo, majorant } => {
            path.null(&collision(extinction, albedo, majorant, absorption));
        }
        Step::Scatter { extinction, albedo, majorant, phase } => {
            path.scatter(&collision(extinction, albedo, majorant, absorption));
            path.leave(phase);
        }
    }
}

fn triple(lo: f32, hi: f32) -> impl Strategy<Value = [f32; N]> {
    [lo..hi, lo..hi, lo..hi]
}

fn step() -> impl Strategy<Value = Step> {
    prop_oneof![
        (triple(0.1, 4.0), 0.01f32..0.5).prop_map(|(majorant, distance)| Step::Pass { majorant, distance }),
        (triple(0.2, 3.0), triple(0.1, 1.0), triple(0.3, 4.0))
            .prop_filter("a null collision of the hero needs μn ≠ 0", |(t, _, m)| (m[0] - t[0]).abs()
                > 0.05)
            .prop_map(|(extinction, albedo, majorant)| Step::Null { extinction, albedo, majorant }),
        (triple(0.2, 3.0), triple(0.1, 1.0), triple(0.3, 4.0), 0.01f32..3.0).prop_map(
            |(extinction, albedo, majorant, phase)| Step::Scatter { extinction, albedo, majorant, phase }
        ),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, rng_seed: proptest::test_runner::RngSeed::Fixed(5), ..ProptestConfig::default() })]

    #[test]
    fn rescaled_weights_equal_plain_products(
        steps in prop::collection::vec(step(), 1..25),
        analogue: bool,
        light in 0.01f32..5.0,
    ) {
        let absorption = if analogue { Absorption::Analogue } else { Absorption::Weighted };
        let mut path = PathWeights::<N>::CAMERA;
        let mut plain = Plain { f: [1.0; N], uni: [1.0; N], nee: [1.0; N] };
        for s in &steps {
            apply(&mut path, s, absorption);
            plain.apply(s, analogue);
        }
        let mean_uni: f64 = plain.uni.iter().sum::<f64>() / N as f64;
        let mean_both: f64 =
            (0..N).map(|i| plain.uni[i] + plain.nee[i] * f64::from(light)).sum::<f64>() / N as f64;
        let uni = path.unidirectional(Sampled::ONE);
        let both = path.balanced(Sampled::ONE, light);
        for j in 0..N {
            // Miller's pairwise form: 1 / mean_i (p_i / f_j).
            let pairwise = 1.0 / ((0..N).map(|i| plain.uni[i] / plain.f[j]).sum::<f64>() / N as f64);
            prop_assert!((f64::from(uni[j]) / (plain.f[j] / mean_uni) - 1.0).abs() < 1e-3);
            prop_assert!((f64::from(uni[j]) / pairwise - 1.0).abs() < 1e-3);
            prop_assert!((f64::from(both[j]) / (plain.f[j] / mean_both) - 1.0).abs() < 1e-3);
        }
    }

    /// A connection and a walk that make the same path give weights that sum to one.
    #[test]
    fn techniques_share_a_path_without_remainder(
        (extinction, albedo, majorant) in (triple(0.2, 3.0), triple(0.1, 1.0), triple(3.1, 5.0)),
        distances in prop::collection::vec(0.01f32..0.5, 1..6),
        phase in 0.01f32..3.0,
        light in 0.01f32..5.0,
    ) {
        let c = collision(extinction, albedo, majorant, Absorption::Weighted);
        let mut walk = PathWeights::<N>::CAMERA;
        walk.scatter(&c);
        let mut link = walk.connect(phase, light);
        walk.leave(phase);
        for d in distances {
            walk.pass(Sampled(majorant), d);
            link.pass(Sampled(majorant), d);
            walk.null(&c);
            link.null_by_ratio(&c);
        }
        // Both are f_j / mean (p_uni + p_nee) of one path, whichever technique has made it.
        let (a, b) = (walk.balanced(Sampled::ONE, light), link.connected_balanced(Sampled::ONE));
        for j in 0..N {
            prop_assert!((a[j] / b[j] - 1.0).abs() < 1e-3, "{a:?} {b:?}");
        }
    }
}

#[test]
fn a_hundred_thousand_events_stay_finite() {
    let c = collision([3.0, 1.0, 0.2], [1.0; N], [4.0, 2.0, 0.25], Absorption::Weighted);
    let mut path = PathWeights::<N>::CAMERA;
    for _ in 0..100_000 {
        path.pass(Sampled([4.0, 2.0, 0.25]), 0.3);
        path.scatter(&c);
        path.leave(0.08);
        assert!(path.balanced(Sampled::ONE, 0.1).0.iter().all(|x| x.is_finite()));
    }
}
