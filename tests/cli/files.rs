//! End-to-end tests of external files: choices and repairs are reported, and images match those of equivalent
//! files.

use crate::write::{TinyGrid, vdb};
use crate::{fails, majorant, text};
use serde_json::Value;
use std::path::Path;

/// Renders a scene with the given lines; returns the JSON and the text on stderr.
fn rendered(folder: &Path, lines: &str) -> (Value, String) {
    let scene = folder.join("scene.toml");
    let head = "majorant = 1\n[film]\nwidth = 24\nheight = 16\n[estimator]\nmode = \"rgb\"\n";
    std::fs::write(&scene, format!("{head}{lines}")).unwrap();
    let output = majorant(&["render", scene.to_str().unwrap(), "--spp", "4", "--threads", "1", "--json"]);
    let said = text(&output.stderr);
    assert!(output.status.success(), "{said}");
    (serde_json::from_str(text(&output.stdout).lines().last().unwrap()).unwrap(), said)
}

fn info(file: &Path) -> Value {
    let output = majorant(&["info", file.to_str().unwrap(), "--json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    serde_json::from_str(&text(&output.stdout)).unwrap()
}

/// Returns the notices in the JSON of a render, each of which must be on stderr, too.
fn notices((json, said): &(Value, String)) -> Vec<String> {
    let notices: Vec<String> =
        json["notices"].as_array().unwrap().iter().map(|n| n.as_str().unwrap().to_owned()).collect();
    assert!(notices.iter().all(|notice| said.contains(notice)), "{notices:?}: {said}");
    notices
}

#[test]
fn pictures_light_a_scene_as_their_files_mean_it() {
    let pictures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/pictures");
    let folder = tempfile::tempdir().unwrap();
    let lit = |name: &str| {
        let file = pictures.join(name).display().to_string();
        rendered(folder.path(), &format!("[[lights]]\nkind = \"environment-map\"\nfile = {file:?}\n"))
    };
    for (file, same, word) in [
        ("left_half.exr", "whole.exr", "black"),
        ("sun_half_inf.exr", "sun_65504.exr", "65504"),
        ("luminance.exr", "white.exr", "luminance"),
    ] {
        let (odd, plain) = (lit(file), lit(same));
        assert_eq!(odd.0["mean"], plain.0["mean"], "{file}");
        assert!(odd.0["mean"][0].as_f64().unwrap() > 0.0, "{file}");
        assert!(notices(&odd).len() == 1 && notices(&odd)[0].contains(word), "{:?}", notices(&odd));
        assert!(notices(&plain).is_empty(), "{:?}", notices(&plain));
        let described = info(&pictures.join(file));
        assert!(described["notices"][0].as_str().unwrap().contains(word), "{described}");
        assert_eq!(described["width"], info(&pictures.join(same))["width"], "{file}");
    }
    let converted = lit("ap0.exr");
    assert!(notices(&converted)[0].contains("Bradford"), "{:?}", notices(&converted));
}

#[test]
fn the_density_is_chosen_by_name_and_told() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, version: u32, grids: &[TinyGrid]| {
        let file = folder.path().join(name);
        std::fs::write(&file, vdb(version, false, grids)).unwrap();
        file
    };
    let density = TinyGrid::default();
    let temperature = TinyGrid { name: "temperature", largest: 512.0, ..density };
    write("density.vdb", 224, &[density]);
    write("half.vdb", 225, &[TinyGrid { values: "half", ..density }]);
    write("newer.vdb", 227, &[density]);
    let capital = write("capital.vdb", 224, &[temperature, TinyGrid { name: "Density", ..density }]);
    let hot =
        write("hot.vdb", 224, &[temperature, TinyGrid { name: "velocity", values: "vec3s", ..density }]);
    let scene = |file: &str| {
        format!(
            "[medium]\nscale = 4.0\n[medium.density]\nkind = \"grid\"\nfile = {file:?}\n\
             [[lights]]\nkind = \"environment\"\n"
        )
    };
    let of = |file: &str| rendered(folder.path(), &scene(file));
    let plain = of("density.vdb");
    assert!(notices(&plain).is_empty(), "{:?}", notices(&plain));
    for (file, words) in [
        ("half.vdb", &[][..]),
        ("newer.vdb", &["file version 227"]),
        ("capital.vdb", &["\"Density\" is read as the density"]),
    ] {
        let odd = of(file);
        assert_eq!(odd.0["mean"], plain.0["mean"], "{file}");
        assert_eq!(odd.0["density_grid"], if file == "capital.vdb" { "Density" } else { "density" });
        let told = notices(&odd);
        assert_eq!(told.len(), words.len(), "{told:?}");
        assert!(told.iter().zip(words).all(|(notice, word)| notice.contains(word)), "{told:?}");
    }
    let described = info(&capital);
    assert_eq!(described["density"], "Density");
    assert!(described["notices"][0].as_str().unwrap().contains("Density"), "{described}");
    assert_eq!(described["grids"].as_array().unwrap().len(), 2);

    // A file with only a temperature is refused unless the grid is named.
    assert!(info(&hot).get("density").is_none());
    std::fs::write(folder.path().join("hot.toml"), format!("majorant = 1\n{}", scene("hot.vdb"))).unwrap();
    let file = folder.path().join("hot.toml").display().to_string();
    let refused = fails(&["render", &file, "--spp", "1", "--json"], 1);
    assert!(refused.contains("\"temperature\", \"velocity\"") && refused.contains("`grid`"), "{refused}");
    let named = ["--set", "medium.density.grid=\"temperature\"", "--set", "medium.scale=0.01"];
    let output =
        majorant(&[&["render", &file, "--spp", "1", "--size", "8x8", "--json"][..], &named].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
}
