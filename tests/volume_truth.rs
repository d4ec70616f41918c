//! Every file of the ground truth (OpenVDB's own C++) is read exactly, or refused with a reason.
//!
//! Needs the folder of test volumes: `MAJORANT_VOLUMES=FOLDER cargo test`. Files that may be redistributed
//! are tested without it, in `volume_files.rs`.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test may panic, and prints its tables"
)]

use majorant_tests::volumes::{self, truth};

#[test]
fn every_file_is_exact_or_refused() {
    let Some(folder) = volumes::volumes() else {
        return;
    };
    let verdicts = truth::compare(&folder, &folder.join("truth.json"));
    truth::print(&verdicts);
    let wrong: Vec<_> = verdicts.iter().filter(|v| v.is_wrong()).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(verdicts.len() > 60, "only {} grids", verdicts.len());
}

/// Files of other versions and compressions, converted from files of the ground truth.
const REWRITES: [(&str, &str); 18] = [
    ("rw_f32_mask_v220_zip", "f32_bloscmask"),
    ("rw_f32_mask_v222", "f32_bloscmask"),
    ("rw_f32_none_v220", "f32_none"),
    ("rw_f32_none_v220_zip", "f32_none"),
    ("rw_f32_none_v224_zip", "f32_none"),
    ("rw_half_mask_v220", "half_mask"),
    ("rw_half_mask_v222", "half_mask"),
    ("rw_half_mask_v224_zip", "half_mask"),
    ("rw_half_none_v220_zip", "half_none"),
    ("rw_half_none_v222", "half_none"),
    ("rw_inactive_cases_half_none_v220", "inactive_cases_half_none"),
    ("rw_inactive_cases_half_none_v220_zip", "inactive_cases_half_none"),
    ("rw_inactive_cases_half_none_v224_zip", "inactive_cases_half_none"),
    ("rw_tiles_8_128_none_v220", "tiles_8_128_none"),
    ("rw_tiles_8_128_none_v222", "tiles_8_128_none"),
    ("rw_tiles_8_128_none_v224_zip", "tiles_8_128_none"),
    ("rw_tiles_half_none_v220_zip", "tiles_half_none"),
    ("rw_tiles_half_none_v222", "tiles_half_none"),
];

#[test]
fn rewrites_hold_the_same_grids() {
    let Some(folder) = volumes::volumes() else {
        return;
    };
    let truth_file = folder.join("truth.json");
    let compare = |(rewrite, original): &(&str, &str)| {
        let [rewrite, original] = [rewrite, original].map(|name| format!("{name}.vdb"));
        truth::compare_rewrite(&folder, &truth_file, &rewrite, &original)
    };
    let verdicts: Vec<_> = REWRITES.iter().flat_map(compare).collect();
    truth::print(&verdicts);
    assert!(verdicts.iter().all(|v| !v.is_wrong() && v.refused.is_none()), "{verdicts:#?}");
}
