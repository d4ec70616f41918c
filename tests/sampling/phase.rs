//! Phase functions of every kind, from isotropic to sharply peaked, forward and backward.

use glam::{Vec2, Vec3};
use majorant_core::math::Sampler;
use majorant_core::phase::{Angle, Phase, PhaseDoc};
use majorant_tests::chi2::Family;

/// One phase function of each kind, and difficult parameters.
fn phases() -> Vec<(String, PhaseDoc)> {
    let hard = [0.0, 0.5, -0.5, 0.9, -0.9, 0.999, -0.999].map(|g| PhaseDoc::HenyeyGreenstein { g });
    let two = |g_forward, g_backward, forward| PhaseDoc::TwoLobe { g_forward, g_backward, forward };
    let two = [two(0.9, -0.9, 0.5), two(0.999, 0.0, 0.3), two(0.8, -0.4, 0.0), two(0.8, -0.4, 1.0)];
    // Both sides of the threshold below which the quartic is not solved, and the ends of both ranges.
    let draine = [
        (0.0, 1.0),
        (0.0, 1000.0),
        (0.009, 50.0),
        (0.011, 50.0),
        (-0.6, 3.0),
        (0.5, 0.0),
        (0.5, 1e-6),
        (0.95, 250.0),
        (0.999, 1000.0),
        (-0.999, 1.0),
    ];
    let draine = draine.map(|(g, alpha)| PhaseDoc::Draine { g, alpha });
    // All four pieces of the fit.
    let mie = [0.001, 0.08, 0.5, 1.4, 3.0, 5.0, 50.0].map(|diameter_um| PhaseDoc::Mie { diameter_um });
    let table = |angle, points: &[[f32; 2]]| PhaseDoc::Tabulated {
        angle,
        points: points.to_vec(),
        file: String::new(),
    };
    let tables = [
        table(Angle::Cosine, &[[-1.0, 1.0], [1.0, 1.0]]),
        table(Angle::Cosine, &[[-0.8, 0.0], [-0.3, 2.0], [0.0, 0.0], [0.2, 0.0], [0.9, 1.0], [1.0, 0.0]]),
        table(Angle::Degrees, &[[0.0, 5e4], [0.5, 2e4], [2.0, 40.0], [10.0, 2.0], [90.0, 0.1], [180.0, 0.3]]),
    ];
    let named = PhaseDoc::templates().into_iter().map(|doc| (doc.kind().name.to_owned(), doc));
    let others = hard.into_iter().chain(two).chain(draine).chain(mie).chain(tables);
    named.chain(others.map(|doc| (format!("{doc:?}"), doc))).collect()
}

fn mean_cosine(doc: &PhaseDoc) -> f64 {
    let known = match *doc {
        PhaseDoc::Isotropic {} | PhaseDoc::Rayleigh {} => 0.0,
        PhaseDoc::HenyeyGreenstein { g } => f64::from(g),
        PhaseDoc::TwoLobe { g_forward, g_backward, forward } => {
            let share = f64::from(forward);
            share * f64::from(g_forward) + (1.0 - share) * f64::from(g_backward)
        }
        PhaseDoc::Draine { g, alpha } => {
            let (g, alpha) = (f64::from(g), f64::from(alpha));
            // From the moments of Henyey–Greenstein: g, (1 + 2 g²)/3, (3 g + 2 g³)/5.
            (g + alpha * (3.0 * g + 2.0 * g.powi(3)) / 5.0) / (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0)
        }
        // The first test compares this with quadrature.
        PhaseDoc::Mie { .. } | PhaseDoc::Tabulated { .. } => f64::from(Phase::new(doc).mean_cosine()),
    };
    assert!((f64::from(Phase::new(doc).mean_cosine()) - known).abs() < 1e-6, "{doc:?}");
    known
}

/// Incident directions: both poles of the frame, and a general direction.
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
                // Rounding of the directions has an effect on the sharpest lobes.
                let error = density / phase.density(omega_in, omega_out) - 1.0;
                assert!(error.abs() < 0.05, "{name}: the density of a sample is off by {error}");
                omega_out
            };
            let density = |omega_out| phase.density(omega_in, omega_out);
            let mean = family.directions(&format!("{name} from {omega_in}"), draw, density);
            let cosine = mean.dot(omega_in.as_dvec3());
            assert!((cosine - mean_cosine(&doc)).abs() < 2e-3, "{name}: ∫ p cos θ is {cosine}");
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
            // 1 − cos θ keeps precision for sharp lobes.
            let mut offset = || {
                let (omega_out, _) = phase.sample(omega_in, sampler.next_2d());
                0.5 * (omega_out.as_dvec3().normalize() - omega_in.as_dvec3().normalize()).length_squared()
            };
            let offsets: Vec<f64> = (0..200_000).map(|_| offset()).collect();
            family.mean(&name, &offsets, 1.0 - mean_cosine(&doc));
        }
    }
    family.judge();
}

#[test]
fn every_parameter_stays_finite_at_every_number() {
    let mut docs: Vec<PhaseDoc> = phases().into_iter().map(|(_, doc)| doc).collect();
    for template in PhaseDoc::templates() {
        let count = template.parameters().len();
        // Every corner of the ranges.
        for corner in 0..1 << count {
            let mut doc = template.clone();
            for (i, (parameter, value)) in doc.parameters_mut().into_iter().enumerate() {
                *value = parameter.range[corner >> i & 1];
            }
            docs.push(doc);
        }
    }
    for doc in docs {
        let phase = Phase::new(&doc);
        for i in 0..=4096u16 {
            let u = (f32::from(i) / 4096.0).min(1.0 - 1.0 / 16_777_216.0);
            let (direction, density) = phase.sample(Vec3::X, Vec2::new(u, 0.3));
            assert!(direction.is_finite() && (direction.length() - 1.0).abs() < 1e-5, "{doc:?}, {u}");
            assert!(density.is_finite() && density > 0.0, "{doc:?}, {u}: {density}");
            let value = phase.value(f32::from(i) / 2048.0 - 1.0);
            assert!(value.is_finite() && value >= 0.0, "{doc:?}, {i}: {value}");
        }
    }
}
