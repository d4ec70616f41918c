//! Every estimator against pictures that independent renderers have made (see `oracle/README.md`).
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "tests may panic, and print their tables"
)]

use majorant_core::estimator::REGISTRY;
use majorant_tests::render::{BATCHES, Blocks, oracle};
use majorant_tests::stats::judge;

const DOF: f64 = (BATCHES - 1) as f64;

/// Compares at `side × side` blocks. Where an estimator's noise is heavy-tailed, blocks are larger, so
/// that rare events are in every batch and the batch means know their own scatter.
fn compare(name: &str, spp: u64, side_of: impl Fn(&str) -> usize) {
    for entry in REGISTRY {
        let side = side_of(entry.id);
        let o = oracle(name, side);
        let blocks = Blocks::render(&o.scene, &o.doc, entry.id, spp, side as u32, side as u32);
        let verdict = judge(&blocks.against_known(&o.mean, &o.error), DOF, 1e-5);
        println!("{name} {}: {verdict:?}", entry.id);
        assert!(verdict.agrees(), "{name} {}: {verdict:?}", entry.id);
    }
}

#[test]
fn s1_homogeneous_cube() {
    compare("S1", 2, |_| 16);
}

#[test]
fn s1f_furnace() {
    compare("S1f", 2, |_| 16);
}

/// A small side light: unidirectional estimators meet it rarely.
#[test]
fn s2_cloud_with_a_side_light() {
    compare("S2", 8, |id| if id == "nee" || id == "uni-nee-mis" { 2 } else { 1 });
}

/// A strongly forward phase function: NEE's directions rarely fit it.
#[test]
fn s3_cloud_with_a_back_light() {
    compare("S3", 2, |id| match id {
        "uni-nee-mis" => 8,
        "nee" => 1,
        _ => 4,
    });
}

#[test]
fn s4_chromatic_plume_rgb() {
    compare("S4", 2, |_| 8);
}

#[test]
fn s5_chromatic_plume_spectral() {
    // The reference was made with a table of the observer that is 0.1 % off.
    for entry in REGISTRY {
        let o = oracle("S5", 8);
        let blocks = Blocks::render(&o.scene, &o.doc, entry.id, 2, 8, 8);
        let error: Vec<f64> = o.mean.iter().zip(&o.error).map(|(m, e)| e.hypot(1e-3 * m)).collect();
        let verdict = judge(&blocks.against_known(&o.mean, &error), DOF, 1e-5);
        println!("S5 {}: {verdict:?}", entry.id);
        assert!(verdict.agrees(), "S5 {}: {verdict:?}", entry.id);
    }
}
