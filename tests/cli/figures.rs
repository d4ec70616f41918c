//! End-to-end tests of `majorant figures`.

use super::{fails, succeeds};
use majorant_core::compare::report::words;
use majorant_core::figures::FIGURES;
use majorant_core::figures::study::{VARIANTS, questions};
use serde_json::Value;
use std::path::Path;

const TINY: &[&str] = &["--size", "24x16", "--spp", "3", "--threads", "2"];

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap()
}

#[test]
fn figures_write_pictures_numbers_and_a_conclusion_that_agrees_with_them() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path().join("new").join("report");
    let study = ["--reference-spp", "64", "--seconds", "0.02", "--repeats", "3"];
    let printed = succeeds(&[&["figures", "all", "-o", dir.to_str().unwrap()], TINY, &study].concat());
    let json: Value = serde_json::from_str(&read(&dir, "figures.json")).unwrap();
    let figures = json["figures"].as_array().unwrap();
    assert_eq!(figures.len(), FIGURES.len());
    assert!(json["command"].as_str().unwrap().starts_with("majorant figures all -o "));

    // Every panel has its files and numbers.
    let mut panels = 0;
    for (figure, made) in FIGURES.iter().zip(figures) {
        assert!(dir.join(made["png"].as_str().unwrap()).metadata().unwrap().len() > 1000);
        for (strip, row) in figure.strips.iter().zip(made["strips"].as_array().unwrap()) {
            assert_eq!((row["name"].as_str(), &row["reference"]["spp"]), (Some(strip.name), &64.into()));
            let mut files = vec![&row["reference"]["png"], &row["reference"]["exr"]];
            for (panel, numbers) in strip.panels.iter().zip(row["panels"].as_array().unwrap()) {
                assert_eq!(numbers["estimator"], panel.estimator);
                assert_eq!(numbers["spp"], 3);
                let number = |key: &str| numbers[key].as_f64().unwrap();
                assert!(number("lookups") > 0.0 && number("seconds") > 0.0, "{numbers}");
                assert!(number("relmse_error") > 0.0, "{numbers}");
                assert!(number("variance") > 0.0 && number("variance_error") > 0.0, "{numbers}");
                assert_ne!(numbers["verdict"], "biased", "{numbers}");
                files.extend([&numbers["png"], &numbers["exr"]]);
                panels += 1;
            }
            assert!(files.iter().all(|f| dir.join(f.as_str().unwrap()).metadata().unwrap().len() > 100));
        }
    }
    assert_eq!(panels, 1 + 2 + 6 + 2);
    assert_eq!(read(&dir, "figures.csv").lines().count(), 1 + panels);

    // The study's answers are ratios of its rows, and the conclusion agrees with them.
    let conclusion: Vec<&str> =
        json["conclusion"].as_array().unwrap().iter().map(|p| p.as_str().unwrap()).collect();
    let studies = json["study"].as_array().unwrap();
    assert_eq!(studies.len(), 5);
    let page = read(&dir, "index.html");
    for study in studies {
        let scene = study["scene"].as_str().unwrap();
        let rows = study["rows"].as_array().unwrap();
        assert_eq!((rows.len(), &study["left_out"]), (VARIANTS.len(), &Value::Array(vec![])));
        let answers = study["answers"].as_array().unwrap();
        assert_eq!(answers.len(), questions().count(), "{study}");
        for answer in answers {
            let efficiency = |id: &str| {
                let row = rows.iter().find(|r| r["estimator"] == answer[id]).unwrap();
                row["efficiency"]["mean"].as_f64().unwrap()
            };
            let [mean, lo, hi] = ["mean", "lo", "hi"].map(|end| answer["ratio"][end].as_f64().unwrap());
            // With runs this short, times are dominated by the machine; the table has the means of quotients.
            if answer["by"] == "efficiency" {
                assert!(
                    (mean / (efficiency("variant") / efficiency("against")) - 1.0).abs() < 1e-9,
                    "{answer}"
                );
            }
            let text = format!("{} [{}, {}]", words::times(mean), words::times(lo), words::times(hi));
            assert!(page.contains(&text) && printed.contains(&text), "{text}");
            if answer["question"] == "null-scattering" {
                assert!(conclusion[0].contains(&format!("{scene} {text}")), "{text}: {}", conclusion[0]);
            }
            if lo <= 1.0 && hi >= 1.0 {
                assert_eq!(answer["outcome"], "open");
            }
        }
    }
    assert!(conclusion.iter().all(|p| printed.contains(p)));
    let lines = |name: &str| read(&dir, name).lines().count();
    let count = |key: &str| studies.iter().map(|s| s[key].as_array().unwrap().len()).sum::<usize>();
    assert_eq!((lines("study.csv"), lines("answers.csv")), (1 + count("rows"), 1 + count("answers")));

    // The page loads no other file, and no partial file is left.
    assert!(page.matches("data:image/png;base64,").count() == 1 + 3 + 8 + 2);
    for loads in ["src=\"http", "href=\"http", "<script", "@import", "url("] {
        assert!(!page.contains(loads), "{loads}");
    }
    let left = std::fs::read_dir(&dir).unwrap().map(|f| f.unwrap().file_name().into_string().unwrap());
    assert!(left.into_iter().all(|name| !name.ends_with(".part") && !name.starts_with('.')));

    // The EXR of a panel contains its standard errors.
    let info: Value = serde_json::from_str(&succeeds(&[
        "info",
        dir.join("figure4-b-spectral-mis.exr").to_str().unwrap(),
        "--json",
    ]))
    .unwrap();
    assert!(info["channels"].as_array().unwrap().contains(&"stderr.R".into()), "{info}");
}

#[test]
fn figures_take_a_volume_of_ones_own_and_leave_the_study_out() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path().to_str().unwrap();
    let own = concat!("plume=", env!("CARGO_MANIFEST_DIR"), "/../tests/volumes/usd_densityAndHeat.vdb");
    let common = ["figures", "2", "-o", dir, "--reference-spp", "8", "--seconds", "0", "--volume", own];
    let printed = succeeds(&[&common[..], TINY].concat());
    assert!(printed.lines().filter(|l| l.starts_with("figure2 ")).count() == 2, "{printed}");
    let json: Value = serde_json::from_str(&read(folder.path(), "figures.json")).unwrap();
    assert!(json["volumes"][0].as_str().unwrap().ends_with("usd_densityAndHeat.vdb"));
    assert_eq!((&json["study"], &json["conclusion"]), (&Value::Array(vec![]), &Value::Array(vec![])));
    assert!(!folder.path().join("study.csv").exists());
}

#[test]
fn figures_explain_mistakes() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path().join("report");
    let figures = |more: &[&str], code: i32| {
        let common = ["figures", "-o", dir.to_str().unwrap(), "--seconds", "0"];
        fails(&[&common[..], more].concat(), code)
    };
    let sentence = |more: &[&str]| {
        let message = figures(more, 1);
        assert_eq!(message.trim().lines().count(), 1, "{message}");
        message
    };
    assert!(sentence(&["3", "--volume", "none.vdb"]).contains("none.vdb"));
    assert!(sentence(&["4", "--volume", "cloud=none.vdb"]).contains("no figure"));
    let mask = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/volumes/t_mask.vdb");
    assert!(sentence(&["3", "--volume", mask]).contains("t_mask.vdb"));
    assert!(sentence(&["2", "--size", "0x0"]).contains("film"));
    // These errors were found before anything was written.
    assert!(!dir.exists());
    let nowhere = fails(&["figures", "4", "-o", "/proc/report"], 1);
    assert!(nowhere.contains("/proc/report") && nowhere.trim().lines().count() == 1, "{nowhere}");
    figures(&["5"], 2);
    figures(&[], 2);
    figures(&["2", "--spp", "2"], 2);
    figures(&["2", "--repeats", "1"], 2);
    figures(&["2", "--size", "banana"], 2);
    figures(&["2", "--volume", "cloud="], 2);
    fails(&["figures", "2"], 2);
}
