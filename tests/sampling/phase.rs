//! Phase functions: every kind, blunt and sharp, forward and backward.

use glam::Vec3;
use majorant_core::math::Sampler;
use majorant_core::phase::{Phase, PhaseDoc};
use majorant_tests::chi2::Family;

/// One of each kind, and the parameters that are hard.
fn phases() -> Vec<(String, PhaseDoc)> {
    let hard = [0.0, 0.5, -0.5, 0.9, -0.9, 0.999, -0.999].map(|g| PhaseDoc::HenyeyGreenstein { g });
    let two = |g_forward, g_backward, forward| PhaseDoc::TwoLobe { g_forward, g_backward, forward };
    let two = [two(0.9, -0.9, 0.5), two(0.999, 0.0, 0.3), two(0.8, -0.4, 0.0), two(0.8, -0.4, 1.0)];
    let named = PhaseDoc::templates().into_iter().map(|(name, doc)| (name.to_owned(), doc));
    named.chain(hard.into_iter().chain(two).map(|doc| (format!("{doc:?}"), doc))).collect()
}

fn mean_cosine(doc: PhaseDoc) -> f64 {
    match doc {
        PhaseDoc::Isotropic {} | PhaseDoc::Rayleigh {} => 0.0,
        PhaseDoc::HenyeyGreenstein { g } => f64::from(g),
        PhaseDoc::TwoLobe { g_forward, g_backward, forward } => {
            let share = f64::from(forward);
            share * f64::from(g_forward) + (1.0 - share) * f64::from(g_backward)
        }
    }
}

/// Directions that phase functions are tried on: at both poles of the frame, and elsewhere.
fn incoming() -> [Vec3; 3] {
    [Vec3::Z, Vec3::NEG_Z, Vec3::new(0.36, -0.48, -0.8)]
}

#[test]
fn directions_follow_the_phase_function() {
    let mut family = Family::default();
    for (seed, (name, doc)) in (0..).zip(phases()) {
        let phase = Phase::new(&doc);
        for (pixel, omega_in) in (0..).zip(incoming()) {
            let mut sampler = Sampler::new(seed, pixel, 0);
            let draw = || {
                let (omega_out, density) = phase.sample(omega_in, sampler.next_2d());
                // Rounding of the directions themselves shows in the sharpest lobes.
                let error = density / phase.density(omega_in, omega_out) - 1.0;
                assert!(error.abs() < 0.05, "{name}: the density of a sample is off by {error}");
                omega_out
            };
            let density = |omega_out| phase.density(omega_in, omega_out);
            let mean = family.directions(&format!("{name} from {omega_in}"), draw, density);
            let cosine = mean.dot(omega_in.as_dvec3());
            assert!((cosine - mean_cosine(doc)).abs() < 2e-3, "{name}: ∫ p cos θ is {cosine}");
        }
    }
    family.judge();
}

#[test]
fn the_mean_cosine_of_samples_is_g() {
    let mut family = Family::default();
    for (seed, (name, doc)) in (0..).zip(phases()) {
        let phase = Phase::new(&doc);
        for (pixel, omega_in) in (0..).zip(incoming()) {
            let mut sampler = Sampler::new(seed, pixel, 1);
            // 1 − cos θ keeps the digits of sharp lobes.
            let mut offset = || {
                let (omega_out, _) = phase.sample(omega_in, sampler.next_2d());
                0.5 * (omega_out.as_dvec3().normalize() - omega_in.as_dvec3().normalize()).length_squared()
            };
            let offsets: Vec<f64> = (0..200_000).map(|_| offset()).collect();
            family.mean(&name, &offsets, 1.0 - mean_cosine(doc));
        }
    }
    family.judge();
}
