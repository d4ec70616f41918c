//! End-to-end tests of `majorant compare`.

use super::{fails, succeeds};
use serde_json::Value;
use std::path::Path;

/// Three unbiased views of a cube in a white environment, and one with a clamped majorant.
const COMPARED: &str = "
majorant = 1
[film]
width = 32
height = 32
[medium]
extinction = 4.0
albedo = 0.8
[[lights]]
kind = \"environment\"
[estimator]
id = \"spectral-mis\"
mode = \"rgb\"
[[compare.views]]
estimator = { id = \"nee\", mode = \"rgb\" }
seed = 1
[[compare.views]]
estimator = { id = \"independent\", mode = \"rgb\" }
seed = 2
[[compare.views]]
estimator = { id = \"nee\", mode = \"rgb\" }
majorant = { factor = 0.5, when_exceeded = \"clamp\" }
seed = 3
";

fn json_lines(text: &str) -> Vec<Value> {
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn compare_ranks_and_finds_the_biased_view() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    std::fs::write(path("scene.toml"), COMPARED).unwrap();
    let report = path("report");
    let reference =
        ["--reference-estimator", "nee", "--reference-spp", "256", "--threads", "2", "--baseline", "B"];
    let mut arguments = vec!["compare", "scene.toml", "--spp", "64", "-o", &report, "--html", "--json"];
    let scene = path("scene.toml");
    arguments[1] = &scene;
    arguments.extend(reference);
    let rows = json_lines(&succeeds(&arguments));
    let keys = [
        "estimator",
        "label",
        "spp",
        "seconds",
        "wall_seconds",
        "lookups",
        "lookups_per_path",
        "relmse",
        "variance",
        "chroma_variance",
        "efficiency",
        "speedup",
        "speedup_ci",
        "bias_z",
        "p",
        "verdict",
        "against",
        "declared_bias",
        "seed",
        "mode",
        "excluded",
    ];
    let verdicts: Vec<_> = rows.iter().map(|r| r["verdict"].as_str().unwrap()).collect();
    assert_eq!(verdicts, ["agrees", "agrees", "agrees", "biased"], "{rows:?}");
    for (row, seed) in rows.iter().zip(0..) {
        let mut found: Vec<_> = row.as_object().unwrap().keys().map(String::as_str).collect();
        let mut expected = keys.to_vec();
        found.sort_unstable();
        expected.sort_unstable();
        assert_eq!(found, expected);
        let number = |key: &str| row[key].as_f64().unwrap();
        assert_eq!((&row["seed"], &row["spp"], &row["mode"]), (&seed.into(), &64.into(), &"rgb".into()));
        assert!((number("efficiency") * number("variance") * number("seconds") - 1.0).abs() < 1e-12, "{row}");
        assert!(number("lookups_per_path") > 0.0 && number("relmse") > 0.0, "{row}");
        assert_eq!(row["against"], "NEE, 256 samples per pixel");
    }
    assert_eq!((&rows[1]["speedup"], &rows[1]["speedup_ci"]), (&1.0.into(), &serde_json::json!([1.0, 1.0])));
    assert_eq!(rows[3]["declared_bias"], "the majorant is clamped");
    assert!(rows[3]["p"].as_f64().unwrap() < 1e-5);
    for name in
        ["A-spectral-mis.png", "D-nee.z.png", "reference.png", "compare.exr", "ranking.csv", "index.html"]
    {
        assert!(Path::new(&report).join(name).metadata().unwrap().len() > 100, "{name}");
    }
    let info: Value =
        serde_json::from_str(&succeeds(&["info", &path("report/compare.exr"), "--json"])).unwrap();
    assert!(info["channels"].as_array().unwrap().contains(&"map.z".into()), "{info}");
    let document = std::fs::read_to_string(path("report/compare.json")).unwrap();
    let document: Value = serde_json::from_str(&document).unwrap();
    assert_eq!(document["views"].as_array().unwrap(), &rows);

    // The command on the page reproduces the image bit by bit.
    let again = succeeds(&[
        "render",
        &path("report/scene.toml"),
        "--estimator",
        "nee",
        "--seed",
        "1",
        "--spp",
        "64",
        "-o",
        &path("B.exr"),
        "--json",
    ]);
    assert!(again.contains("\"seed\":1"), "{again}");
    let pictures =
        ["B.exr", "report/B-nee.exr"].map(|n| majorant_core::io::picture::read(path(n).as_ref()).unwrap());
    assert_eq!(pictures[0].pixels, pictures[1].pixels);

    // The table has the same verdicts.
    let table = succeeds(&["compare", &scene, "--spp", "64", "-o", &report]);
    assert!(table.contains("biased: ") && table.contains("the majorant is clamped"), "{table}");
    assert!(table.contains("A against mean of B, C"), "{table}");
}

#[test]
fn compare_lines_up_what_it_is_told_to() {
    let rows = |arguments: &[&str]| {
        let all = [&["compare", "furnace", "--size", "16x16", "--json"], arguments].concat();
        json_lines(&succeeds(&all))
            .iter()
            .map(|r| (r["estimator"].as_str().unwrap().to_owned(), r["seed"].as_u64().unwrap()))
            .collect::<Vec<_>>()
    };
    let every = rows(&["--spp", "4"]);
    assert_eq!(
        every.iter().map(|r| r.0.as_str()).collect::<Vec<_>>(),
        majorant_core::estimator::REGISTRY.iter().map(|e| e.id).collect::<Vec<_>>()
    );
    let two =
        rows(&["--estimators", "nee,independent", "--seconds", "0.05", "--seed", "5", "--fair", "samples"]);
    assert_eq!(two, [("nee".into(), 5), ("independent".into(), 6)]);
}

#[test]
fn compare_explains_mistakes() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let compare = |more: &[&str], code: i32| {
        fails(&[&["compare", "furnace", "--size", "16x16", "--spp", "4", "--json"], more].concat(), code)
    };
    assert!(compare(&["--estimators", "nee,magic"], 1).contains("`magic`"));
    assert!(compare(&["--baseline", "magic"], 1).contains("magic"));
    assert!(compare(&["--reference", &path("none.exr")], 1).contains("none.exr"));
    assert!(compare(&["-o", "/proc/report"], 1).contains("/proc/report"));
    let other = path("other.exr");
    succeeds(&[
        "render",
        "furnace",
        "--size",
        "16x16",
        "--spp",
        "4",
        "-o",
        &other,
        "--set",
        "medium.scale=2",
    ]);
    let refused = compare(&["--reference", &other], 1);
    assert!(refused.contains("other.exr") && refused.contains("these differ: medium"), "{refused}");
    succeeds(&["render", "furnace", "--size", "16x16", "--spp", "4", "-o", &other, "--seed", "9"]);
    succeeds(&["compare", "furnace", "--size", "16x16", "--spp", "4", "--json", "--reference", &other]);
    assert!(compare(&["--size", "8x8", "--reference", &other], 2).contains("--size"));
    compare(&["--seconds", "1"], 2);
    compare(&["--measure", "magic"], 2);
    compare(&["--reference-estimator", "nee"], 2);
    fails(&["compare", "furnace", "--json"], 2);
    fails(&["compare", "furnace", "--spp", "4", "--html"], 2);
}
