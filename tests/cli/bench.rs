//! End-to-end tests of `majorant bench`.

use super::{fails, succeeds};
use serde_json::Value;

/// Scene with a reference image in the same folder.
const S3: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/oracle/S3/scene.toml");

fn rows(arguments: &[&str]) -> Vec<Value> {
    succeeds(arguments).lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn bench_measures_every_estimator_against_the_reference_beside_the_scene() {
    // Directions as in the papers: with product sampling, connections would be efficient here.
    let plain = ["--set", "estimator.light_sampling=emitter", "estimator.directions=phase"];
    let common = ["bench", S3, "--spp", "8", "--repeats", "3", "--threads", "2", "--json"];
    let rows = rows(&[&common[..], &plain].concat());
    assert_eq!(rows.len(), majorant_core::estimator::REGISTRY.len());
    let mean = |row: &Value, key: &str| row[key]["mean"].as_f64().unwrap();
    for row in &rows {
        assert_eq!((row["scene"].as_str(), row["reference"].as_str()), (Some("S3"), Some("reference.exr")));
        assert_eq!((row["repeats"].as_u64(), row["spp"].as_f64()), (Some(3), Some(8.0)));
        for key in ["relmse", "efficiency", "lookups_to_unit_error", "speedup"] {
            let (lo, hi) = (row[key]["lo"].as_f64().unwrap(), row[key]["hi"].as_f64());
            assert!(lo <= mean(row, key) && hi.is_none_or(|hi| mean(row, key) <= hi), "{key}: {row}");
        }
        // Only numbers that depend on the seed alone are compared, not times.
        let lookups = row["lookups_per_path"].as_f64().unwrap();
        let unit = mean(row, "lookups_to_unit_error") / (mean(row, "relmse") * 8.0 * 128.0 * 128.0 * lookups);
        assert!((unit - 1.0).abs() < 0.05, "{row}");
    }
    let by_id = |id: &str| rows.iter().find(|r| r["estimator"] == id).unwrap();
    // With back lighting and a sharp phase function, NEE alone has a large error.
    assert!(mean(by_id("nee"), "relmse") > 10.0 * mean(by_id("uni-nee-mis"), "relmse"));
    assert_eq!(mean(&rows[0], "speedup"), 1.0);
}

#[test]
fn bench_makes_a_reference_of_its_own_and_prints_columns() {
    let arguments = ["furnace", "--set", "film.width=24", "film.height=16"];
    let common = ["--spp", "2", "--repeats", "2", "--reference-seconds", "0.05", "--estimators", "nee"];
    let with = |last: &'static str| [&["bench"][..], &arguments, &common, &[last]].concat();
    let csv = succeeds(&with("--csv"));
    let mut lines = csv.lines();
    let header: Vec<_> = lines.next().unwrap().split(',').collect();
    let fields: Vec<_> = lines.next().unwrap().split(',').collect();
    assert!(header.len() == 24 && header.contains(&"efficiency_lo"), "{header:?}");
    assert_eq!(&fields[..5], ["furnace", "nee", "2", fields[3], "2"]);
    assert!(lines.next().is_none() && csv.contains("own run of Uni+NEE MIS"));
    let table = succeeds(&with("--threads=1"));
    assert!(table.contains("efficiency") && table.contains("errors against own run"), "{table}");
}

#[test]
fn bench_refuses_what_means_nothing() {
    let clamped = ["--set", "medium.majorant.factor=0.5", "medium.majorant.when_exceeded=clamp"];
    let message = fails(&[&["bench", "furnace"][..], &clamped].concat(), 1);
    assert!(message.contains("clamped"), "{message}");
    assert!(fails(&["bench", "furnace", "--estimators", "magic"], 1).contains("magic"));
    assert!(fails(&["bench", "furnace", "first-light", "--reference", "r.exr"], 1).contains("one scene"));
    assert!(fails(&["bench", "furnace", "--reference", "missing.exr"], 1).contains("missing.exr"));
    let size = fails(&["bench", S3, "--set", "film.width=64", "--spp", "1"], 1);
    assert!(size.contains("64") && size.contains("128"), "{size}");
    fails(&["bench", "furnace", "--seconds", "0"], 2);
    fails(&["bench", "furnace", "--repeats", "1"], 2);
}
