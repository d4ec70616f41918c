//! Transmittance of heterogeneous slabs against quadrature that shares no code with the renderer.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "tests may panic, and print their tables"
)]

use majorant_core::estimator::REGISTRY;
use majorant_tests::render::{BATCHES, Blocks, frozen, oracle, reduce, scene, table, tests_folder};
use majorant_tests::stats::judge;

const DOF: f64 = (BATCHES - 1) as f64;

/// An absorbing rough slab in front of a uniform environment; per-pixel quadrature is given.
#[test]
fn rough_slab_matches_the_analytic_picture() {
    let o = oracle("S6", 16);
    let analytic = reduce(&table(&tests_folder().join("oracle/S6/analytic.npy")), 16);
    for entry in REGISTRY {
        let blocks = Blocks::render(&o.scene, &o.doc, entry.id, 4, 16, 16);
        // The picture was evaluated on a finite set of rays per pixel: allow for 3e-4.
        let verdict = judge(&blocks.against_known(&analytic, &vec![3e-4; 768]), DOF, 0.0);
        println!("{}: {verdict:?}", entry.id);
        assert!(verdict.agrees(), "{}: {verdict:?}", entry.id);
    }
}

/// Values of a rough 1 × 1 × n column, by index.
fn rough(i: usize) -> f64 {
    let x = i as f64;
    (0.5 + 0.5 * (2.1 * x).sin()) * (1.0 + 0.7 * (0.9 * x).cos()).abs()
}

/// σt(λ) = scale · density · σ(λ) along the axis of a column of n cells, wavelength by wavelength:
/// the film's colour is ∫ e^(−τ(λ)) response(λ) dλ.
#[test]
fn spectral_transmittance_matches_quadrature_over_wavelengths() {
    let n = 12;
    let folder = tempfile::tempdir().unwrap();
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    let header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({n}, 1, 1), }}");
    let padded = format!("{header:<117}\n");
    bytes.extend((padded.len() as u16).to_le_bytes());
    bytes.extend(padded.as_bytes());
    for i in 0..n {
        bytes.extend((rough(i) as f32).to_le_bytes());
    }
    std::fs::write(folder.path().join("column.npy"), bytes).unwrap();
    let mut doc = scene(
        "majorant = 1
        [camera]
        origin = [0.0, 0.0, 40.0]
        target = [0.0, 0.0, 0.0]
        fov_deg = 0.02
        [film]
        width = 4
        height = 4
        [medium]
        scale = 1.5
        extinction = \"400:0.2, 500:3, 560:0.5, 700:1\"
        albedo = 0.0
        density = { kind = \"grid\", file = \"column.npy\" }
        [medium.placement]
        fit = 1.0
        [[lights]]
        kind = \"environment\"
        radiance = \"400:0.5, 650:2\"",
    );
    doc.render.seed = 3;
    // ∫ density dz over the unit length: cell-centred samples, linear between, held at both ends.
    let value = |z: f64| {
        let s = (z * n as f64 - 0.5).clamp(0.0, (n - 1) as f64);
        let i = (s as usize).min(n - 2);
        rough(i) + (rough(i + 1) - rough(i)) * (s - i as f64)
    };
    let steps = 240_000;
    let column: f64 =
        (0..steps).map(|i| value((f64::from(i) + 0.5) / f64::from(steps))).sum::<f64>() / f64::from(steps);
    let between = |points: &[(f64, f64)], l: f64| {
        let last = points.len() - 1;
        if l <= points[0].0 {
            return points[0].1;
        }
        if l >= points[last].0 {
            return points[last].1;
        }
        let i = points.iter().rposition(|p| p.0 <= l).unwrap();
        let (a, b) = (points[i], points[i + 1]);
        a.1 + (b.1 - a.1) * (l - a.0) / (b.0 - a.0)
    };
    let mut known = [0.0f64; 3];
    for i in 0..4700 {
        let l = 360.0 + 0.1 * (f64::from(i) + 0.5);
        let sigma = 1.5 * between(&[(400.0, 0.2), (500.0, 3.0), (560.0, 0.5), (700.0, 1.0)], l);
        let light = between(&[(400.0, 0.5), (650.0, 2.0)], l);
        let response = majorant_core::spectrum::response(l as f32);
        for c in 0..3 {
            known[c] += 0.1 * light * (-sigma * column).exp() * f64::from(response[c]);
        }
    }
    let scene = frozen(&doc, folder.path());
    for entry in REGISTRY {
        let blocks = Blocks::render(&scene, &doc, entry.id, 256, 1, 1);
        let verdict = judge(&blocks.against_known(&known, &[1e-5; 3]), DOF, 0.0);
        println!("{}: {known:?} {verdict:?}", entry.id);
        assert!(verdict.agrees(), "{}: {verdict:?}", entry.id);
    }
}
