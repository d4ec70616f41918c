//! End-to-end tests of the command line: output and exit codes of the program.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may panic")]

#[path = "cli/bench.rs"]
mod bench;
#[path = "cli/compare.rs"]
mod compare;
#[path = "cli/figures.rs"]
mod figures;
#[path = "cli/files.rs"]
mod files;
#[path = "cli/inspect.rs"]
mod inspect;
#[path = "harness/volumes/write.rs"]
mod write;

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
    assert_eq!(
        ids,
        [
            "independent",
            "spectral-mis",
            "nee",
            "uni-nee-mis",
            "equiangular-mis",
            "spectral-tracking",
            "mitsuba2-volpath"
        ]
    );
    let scenes = succeeds(&["scenes"]);
    for name in [
        "first-light",
        "plume-spectral",
        "cloud-backlit",
        "cloud-sidelit",
        "homogeneous-absorption",
        "fire",
        "lantern",
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
    // The scene in the metadata renders to the same image.
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

/// A render whose relative error is undefined ends with an image, a distinct exit code and a message.
#[test]
fn a_black_picture_ends_a_render_that_waits_for_its_error() {
    let directory = tempfile::tempdir().unwrap();
    let png = directory.path().join("black.png");
    let scene = directory.path().join("black.toml");
    let source = "majorant = 1\n[film]\nwidth = 8\nheight = 6\n[render]\nrelative_error = 0.1\n";
    std::fs::write(&scene, source).unwrap();
    let output = majorant(&["render", scene.to_str().unwrap(), "-o", png.to_str().unwrap(), "--json"]);
    assert_eq!(output.status.code(), Some(4), "{}", text(&output.stderr));
    assert!(text(&output.stderr).contains("black"), "{}", text(&output.stderr));
    let json: Value = serde_json::from_str(&text(&output.stdout)).unwrap();
    assert_eq!((json["ended_by"].as_str(), json["spp"].as_u64()), (Some("black"), Some(256)));
    assert!(png.exists());
    // Other limits end a render with light.
    let lit = ["render", "first-light", "--set", "film.width=8", "film.height=6", "--json"];
    let by = |more: &[&str]| {
        let json: Value = serde_json::from_str(&succeeds(&[&lit[..], more].concat())).unwrap();
        json["ended_by"].as_str().unwrap().to_owned()
    };
    assert_eq!(by(&["--spp", "3"]), "spp");
    assert_eq!(by(&["--seconds", "0.1"]), "seconds");
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
        serde_json::from_str(&succeeds(&["info", &file("../assets/oracle/S2/density.npy"), "--json"]))
            .unwrap();
    assert_eq!(npy["grids"][0]["bbox"], serde_json::json!([0, 0, 0, 63, 63, 63]));
    assert!(succeeds(&["info", &file("../assets/oracle/S2/scene.toml")]).contains("uni-nee-mis"));
    // The only medium is an object, as before there were several; all media are a list.
    let scene = |name: &str| -> Value {
        let scene = file(&format!("../assets/oracle/{name}/scene.toml"));
        serde_json::from_str(&succeeds(&["info", &scene, "--json"])).unwrap()
    };
    let (one, two) = (scene("S2"), scene("S7"));
    assert_eq!((&one["medium"]["scale"], &one["media"][0]["scale"]), (&16.0.into(), &16.0.into()));
    assert_eq!((two["media"].as_array().unwrap().len(), &two["medium"]), (2, &Value::Null));
    assert!(
        succeeds(&["info", &file("../assets/oracle/S7/scene.toml")]).contains("haze: homogeneous medium")
    );
}

#[test]
fn check_prints_its_table_and_says_what_it_could_have_seen() {
    let names = ["furnace/thin", "half-space/spectral-roulette"];
    let table = succeeds(&["check", names[0], names[1]]);
    let lines: Vec<_> = table.lines().collect();
    let cases = names.iter().flat_map(|name| majorant_core::check::named(name).unwrap());
    let rows: usize = cases.map(|case| case.estimators().len()).sum();
    assert!(rows > majorant_core::estimator::REGISTRY.len());
    assert_eq!(lines.len(), 1 + rows + 1, "{table}");
    assert!(lines[0].contains("measured") && lines[0].contains("verdict"), "{table}");
    assert!(lines[1..=rows].iter().all(|l| l.ends_with("  agrees")), "{table}");
    assert!(lines[rows + 1].starts_with(&format!("{rows} of {rows} agree")), "{table}");
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
    // Mitsuba 2's volpath has infinite variance in a homogeneous medium of this colour.
    assert_eq!(rows.len(), majorant_core::estimator::REGISTRY.len() - 1);
    for row in rows {
        assert_eq!((&row["verdict"], &row["scene"]), (&"agrees".into(), &loose.as_str().into()), "{row}");
        let number = |key: &str| row[key].as_f64().unwrap();
        assert!(number("measured") > 0.1 && number("expected") > 0.1 && number("detectable") < 0.04, "{row}");
        assert!(number("z").abs() <= number("critical_z"), "{row}");
    }
    // Configurations that are declared biased are not compared.
    let clamped = own("clamped.toml", "factor = 0.5, when_exceeded = \"clamp\"");
    let text = succeeds(&["check", &clamped]);
    assert!(text.contains("the majorant is clamped") && text.contains("0 of 0 agree"), "{text}");
    assert!(fails(&["check", "no-such-scene"], 1).contains("check --list"));
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

/// A scene with an error target whose samples are limited by the command line.
#[test]
fn limits_that_are_given_replace_the_scenes_and_say_so() {
    let arguments = [
        "render",
        "furnace",
        "--size",
        "8x8",
        "--json",
        "--set",
        "render.relative_error=0.5",
        "render.cpu_seconds=9",
    ];
    let output = majorant(&[&arguments[..], &["--spp", "2"]].concat());
    let said = text(&output.stderr);
    assert!(output.status.success() && said.contains("render.cpu_seconds = 9"), "{said}");
    assert!(said.contains("render.relative_error = 0.5 no longer holds"), "{said}");
    assert!(text(&output.stdout).contains("\"spp\":2"), "{}", text(&output.stdout));
}

/// `keys` lists every key once, with type, range, unit, default and description.
#[test]
fn keys_are_listed() {
    let listed: Vec<Value> = serde_json::from_str(&succeeds(&["keys", "--json"])).unwrap();
    assert!(listed.len() >= 140, "{}", listed.len());
    for key in &listed {
        for field in ["path", "type", "range", "unit", "default", "label", "tip", "affects", "biases"] {
            assert!(key.get(field).is_some(), "{field}: {key}");
        }
        assert!(
            !key["tip"].as_str().unwrap().is_empty() && !key["label"].as_str().unwrap().is_empty(),
            "{key}"
        );
        let affects = key["affects"].as_str().unwrap();
        assert!(["scene", "estimate", "limits", "view"].contains(&affects), "{key}");
    }
    let find = |path: &str| listed.iter().find(|key| key["path"] == path).unwrap();
    assert_eq!(find("lights.*.radius")["kind"], serde_json::json!(["sphere"]));
    assert_eq!(find("medium.majorant.factor")["range"], serde_json::json!([0.01, 1000.0]));
    assert!(find("medium.majorant.when_exceeded")["biases"].as_str().unwrap().contains("clamp"));
    let ids = find("compare.views.*.estimator.id")["values"].as_array().unwrap();
    assert!(ids.contains(&"nee".into()));
    assert!(find("compare.measure")["values"].as_array().unwrap().contains(&"relmse".into()));
    let lines = succeeds(&["keys", "medium.majorant"]);
    assert!(lines.lines().count() == 4 && lines.contains("default \"weighted\""), "{lines}");
    assert!(fails(&["keys", "magic"], 1).contains("magic"));
    let table = succeeds(&["keys", "--markdown"]);
    assert!(table.starts_with("| key |") && table.contains("`camera.fov_deg`"), "{table}");
}
