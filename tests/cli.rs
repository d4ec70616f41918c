//! The command line end to end: the real program, its output and its exit codes.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may panic")]

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn majorant(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_majorant"))
        .args(arguments)
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn succeeds(arguments: &[&str]) -> String {
    let output = majorant(arguments);
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
    text(&output.stdout)
}

fn fails(arguments: &[&str], code: i32) -> String {
    let output = majorant(arguments);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", text(&output.stderr));
    text(&output.stderr)
}

#[test]
fn lists_estimators_and_scenes() {
    let estimators = succeeds(&["estimators"]);
    let ids: Vec<_> = estimators.lines().filter_map(|l| l.split_whitespace().next()).collect();
    assert_eq!(ids, ["independent", "spectral-mis", "nee", "uni-nee-mis"]);
    let scenes = succeeds(&["scenes"]);
    for name in [
        "first-light",
        "plume-spectral",
        "cloud-backlit",
        "cloud-sidelit",
        "homogeneous-absorption",
        "furnace",
    ] {
        let line = scenes.lines().find(|l| l.starts_with(name)).unwrap();
        assert!(line.len() > name.len() + 20, "{name} has no note: {line}");
    }
}

#[test]
fn every_embedded_scene_renders_headless() {
    let folder = tempfile::tempdir().unwrap();
    let png = folder.path().join("out.png");
    for scene in succeeds(&["scenes"]).lines().filter_map(|l| l.split_whitespace().next()) {
        let json = succeeds(&[
            "render",
            scene,
            "-o",
            png.to_str().unwrap(),
            "--spp",
            "1",
            "--size",
            "48x32",
            "--json",
        ]);
        let json: Value = serde_json::from_str(json.lines().last().unwrap()).unwrap();
        assert_eq!(json["paths"], 48 * 32, "{scene}");
        assert!(png.metadata().unwrap().len() > 100, "{scene}");
    }
}

#[test]
fn render_writes_what_the_contract_says_and_repeats_bit_by_bit() {
    let folder = tempfile::tempdir().unwrap();
    let exr = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let render = |out: &str, threads: &str| {
        let line = succeeds(&[
            "render",
            "furnace",
            "-o",
            out,
            "--estimator",
            "spectral-mis",
            "--spp",
            "3",
            "--size",
            "40x24",
            "--seed",
            "9",
            "--threads",
            threads,
            "--max-depth",
            "5",
            "--set",
            "medium.majorant.factor=2",
            "estimator.mode=spectral",
            "--json",
        ]);
        serde_json::from_str::<Value>(&line).unwrap()
    };
    let one = render(&exr("one.exr"), "1");
    let two = render(&exr("two.exr"), "2");
    for (key, value) in
        [("width", 40), ("height", 24), ("spp", 3), ("seed", 9), ("threads", 1), ("non_finite", 0)]
    {
        assert_eq!(one[key], value, "{key}");
    }
    assert_eq!((&one["estimator"], &one["mode"]), (&"spectral-mis".into(), &"spectral".into()));
    assert!(one["seconds"].as_f64().unwrap() > 0.0 && one["cpu_seconds"].as_f64().unwrap() > 0.0);
    assert!(one["lookups"].as_u64().unwrap() > 0);
    assert_eq!(one["mean"], two["mean"]);
    assert_eq!(one["mean"].as_array().unwrap().len(), 3);

    let info: Value = serde_json::from_str(&succeeds(&["info", &exr("one.exr"), "--json"])).unwrap();
    assert_eq!(info["channels"], serde_json::json!(["B", "G", "R", "stderr.B", "stderr.G", "stderr.R"]));
    assert_eq!(info["majorant"]["estimator"], "spectral-mis");
    assert_eq!(info["majorant"]["spp"], 3);
    // The scene in the metadata renders to the same picture.
    let scene = folder.path().join("again.toml");
    std::fs::write(&scene, info["majorant"]["scene"].as_str().unwrap()).unwrap();
    let again =
        succeeds(&["render", scene.to_str().unwrap(), "-o", &exr("again.exr"), "--spp", "3", "--json"]);
    assert_eq!(serde_json::from_str::<Value>(&again).unwrap()["mean"], one["mean"]);
}

#[test]
fn seconds_end_a_render() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("timed.exr");
    let line = succeeds(&[
        "render",
        "furnace",
        "-o",
        out.to_str().unwrap(),
        "--seconds",
        "0.3",
        "--size",
        "32x32",
        "--json",
    ]);
    let json: Value = serde_json::from_str(&line).unwrap();
    assert!(json["seconds"].as_f64().unwrap() >= 0.3 && json["spp"].as_u64().unwrap() >= 1);
}

#[test]
fn info_describes_volumes_and_scenes() {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests");
    let file = |name: &str| tests.join(name).to_str().unwrap().to_owned();
    let json: Value =
        serde_json::from_str(&succeeds(&["info", &file("volumes/usd_densityAndHeat.vdb"), "--json"]))
            .unwrap();
    let density = &json["grids"][0];
    assert_eq!(density["name"], "density");
    assert_eq!(density["active_voxels"], 6124);
    assert_eq!(density["bbox"], serde_json::json!([1, 1, 31, 23, 23, 72]));
    assert_eq!(json["grids"][1]["name"], "heat");
    let refused: Value =
        serde_json::from_str(&succeeds(&["info", &file("volumes/t_mask.vdb"), "--json"])).unwrap();
    assert!(refused["grids"][0]["error"].as_str().unwrap().contains("t_mask.vdb"));
    let npy: Value =
        serde_json::from_str(&succeeds(&["info", &file("oracle/S2/density.npy"), "--json"])).unwrap();
    assert_eq!(npy["grids"][0]["bbox"], serde_json::json!([0, 0, 0, 63, 63, 63]));
    assert!(succeeds(&["info", &file("oracle/S2/scene.toml")]).contains("uni-nee-mis"));
}

#[test]
fn check_prints_its_table_and_says_what_it_could_have_seen() {
    let table = succeeds(&["check", "furnace/thin", "half-space/chromatic-roulette"]);
    let lines: Vec<_> = table.lines().collect();
    assert_eq!(lines.len(), 1 + 8 + 1, "{table}");
    assert!(lines[0].contains("measured") && lines[0].contains("verdict"), "{table}");
    assert!(lines[1..9].iter().all(|l| l.ends_with("  agrees")), "{table}");
    assert!(lines[9].starts_with("8 of 8 agree"), "{table}");
    let list = succeeds(&["check", "--list"]);
    assert!(list.contains("half-space/weighted") && list.contains("oracle (--deep only)"), "{list}");
}

#[test]
fn check_holds_estimators_against_each_other_on_a_scene_of_ones_own() {
    let folder = tempfile::tempdir().unwrap();
    let own = |name: &str, majorant: &str| {
        let path = folder.path().join(name);
        let text = format!(
            "majorant = 1\n[film]\nwidth = 64\nheight = 36\n[medium]\nextinction = \"450:1, 600:4\"\nalbedo = 0.7\n\
             majorant = {{ {majorant} }}\n[[lights]]\nkind = \"environment\""
        );
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let loose = own("loose.toml", "factor = 1.5");
    let json: Value = serde_json::from_str(&succeeds(&["check", &loose, "--json"])).unwrap();
    assert_eq!(json["passes"], true);
    let rows = json["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 4);
    for row in rows {
        assert_eq!((&row["verdict"], &row["scene"]), (&"agrees".into(), &loose.as_str().into()), "{row}");
        let number = |key: &str| row[key].as_f64().unwrap();
        assert!(number("measured") > 0.1 && number("expected") > 0.1 && number("detectable") < 0.04, "{row}");
        assert!(number("z").abs() <= number("critical_z"), "{row}");
    }
    // Nothing is claimed of what is biased by choice.
    let clamped = own("clamped.toml", "factor = 0.5, when_exceeded = \"clamp\"");
    let text = succeeds(&["check", &clamped]);
    assert!(text.contains("the majorant is clamped") && text.contains("0 of 0 agree"), "{text}");
    assert!(fails(&["check", "no-such-scene"], 1).contains("check --list"));
}

/// Three unbiased views of a cube in a white sky, and one whose majorant is clamped.
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
        assert!(number("lookups_per_path") > 1.0 && number("relmse") > 0.0, "{row}");
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

    // A picture is repeated, bit by bit, by the command that the page shows.
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

    // The table says the same in words.
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
        ["independent", "spectral-mis", "nee", "uni-nee-mis"]
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
    fails(&["compare", "furnace", "--spp", "4"], 2);
}

#[test]
fn without_a_display_the_window_names_the_headless_command() {
    let message = fails(&[], 3);
    assert_eq!(message.trim().lines().count(), 1, "{message}");
    assert!(message.contains("majorant render"), "{message}");
}

#[test]
fn mistakes_are_explained() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let out = path("x.exr");
    assert!(fails(&["render", "no-such-scene", "-o", &out], 1).contains("first-light"));
    assert!(fails(&["render", "furnace", "-o", &path("x.jpg")], 1).contains(".exr"));
    assert!(fails(&["render", "furnace", "-o", &out, "--estimator", "magic"], 1).contains("uni-nee-mis"));
    assert!(
        fails(&["render", "furnace", "-o", &out, "--set", "medium.majorant.fctor=2"], 1).contains("fctor")
    );
    assert!(fails(&["render", "furnace", "-o", &out, "--size", "0x0"], 1).contains("film"));
    assert!(fails(&["render", "furnace", "-o", &out, "--size", "100000x100000"], 1).contains("film"));
    assert!(
        fails(&["render", "furnace", "-o", &out, "--set", "medium.albedo=1.5"], 1).contains("medium.albedo")
    );
    assert!(
        fails(&["render", "furnace", "-o", "/nowhere/x.exr", "--spp", "1", "--size", "8x8"], 1)
            .contains("/nowhere")
    );
    fails(&["render", "furnace"], 2);
    fails(&["render", "furnace", "-o", &out, "--size", "banana"], 2);
    std::fs::write(path("bad.vdb"), b"not a volume").unwrap();
    assert!(fails(&["info", &path("bad.vdb")], 1).contains("bad.vdb"));
}
