//! End-to-end tests of `majorant path` and `majorant contributions`.

use super::{fails, succeeds};
use serde_json::Value;

fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&succeeds(arguments)).unwrap()
}

#[test]
fn a_path_is_printed_with_its_weights_and_sums_to_its_sample() {
    let path = ["path", "plume-spectral", "--pixel", "256,300", "--estimator", "uni-nee-mis"];
    let table = succeeds(&path);
    for word in ["leaves the camera", "light is added", "by definition", "on the film", "nm, the hero first"]
    {
        assert!(table.contains(word), "{word}: {table}");
    }
    let json = json(&[&path[..], &["--json"]].concat());
    assert_eq!((json["estimator"].as_str(), json["pixel"][1].as_u64()), (Some("uni-nee-mis"), Some(300)));
    let mut sum = [0.0f32; 4];
    for credit in json["rows"].as_array().unwrap().iter().map(|row| &row["credit"]) {
        for (sum, value) in sum.iter_mut().zip(credit["value"].as_array().into_iter().flatten()) {
            *sum += value.as_f64().unwrap() as f32;
        }
    }
    for (sum, told) in sum.iter().zip(json["sum"].as_array().unwrap()) {
        assert_eq!(f64::from(*sum), told.as_f64().unwrap());
    }
    // The estimator's path weights agree with their definition: p_nee / p_uni is the same in every row.
    let lanes =
        |value: &Value| value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect::<Vec<_>>();
    let (mut held, mut turned) = (0, false);
    let samples = (0..8).map(|sample| {
        let sample = sample.to_string();
        self::json(&[&path[..], &["--sample", &sample, "--json"]].concat())
    });
    let rows: Vec<Value> = samples.flat_map(|json| json["rows"].as_array().unwrap().clone()).collect();
    for row in &rows {
        let kept = row["kept"].as_array().unwrap();
        // Light is sampled at a turn: between a vertex and that p_nee means nothing.
        match row["event"].as_str().unwrap() {
            "turns" => turned = true,
            "scatters" | "is reflected" | "leaves the camera" => turned = false,
            _ => {}
        }
        if row["branch"] == "path" && !turned {
            continue;
        }
        assert_eq!((kept[1][0].as_str(), kept[2][0].as_str()), (Some("p_uni/P"), Some("p_nee/P")));
        for ((uni, nee), (ln_uni, ln_nee)) in lanes(&kept[1][1])
            .iter()
            .zip(lanes(&kept[2][1]))
            .zip(lanes(&row["ln_p_uni"]).iter().zip(lanes(&row["ln_p_nee"])))
        {
            if *uni > 1e-20 && nee > 1e-20 {
                held += 1;
                assert!((nee.ln() - uni.ln() - (ln_nee - ln_uni)).abs() < 5e-3, "{row}");
            }
        }
    }
    assert!(held >= 8, "{held}");
    // By default the brightest of the first 64 samples is replayed.
    let film =
        |json: &Value| json["film"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).sum::<f64>();
    let first = self::json(&[&path[..], &["--sample", "0", "--json"]].concat());
    assert!(film(&first) <= film(&json));
}

#[test]
fn contributions_are_written_as_files_and_numbers() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().to_str().unwrap();
    let small = ["--set", "film.width=32", "film.height=24", "--spp", "8"];
    let parts =
        [&["contributions", "cloud-sidelit", "--by", "technique", "-o", out, "--json"], &small[..]].concat();
    let json = json(&parts);
    let shares: Vec<_> =
        json["parts"].as_array().unwrap().iter().map(|p| p["variance_share"].as_f64().unwrap()).collect();
    assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-6 && shares.len() == 2, "{shares:?}");
    for name in ["unidirectional.png", "next-event.png"] {
        assert!(directory.path().join(name).metadata().unwrap().len() > 100, "{name}");
    }
    assert!(
        succeeds(&[&["contributions", "cloud-sidelit", "--by", "order"], &small[..]].concat())
            .contains("8 and more")
    );
}

#[test]
fn mistakes_in_paths_and_contributions_are_explained() {
    let outside = fails(&["path", "first-light", "--pixel", "9999,0"], 1);
    assert!(outside.contains("outside of the image"), "{outside}");
    assert!(fails(&["path", "first-light", "--pixel", "7"], 2).contains("COLUMN,ROW"));
    assert!(fails(&["parts", "first-light", "--by", "luck"], 2).contains("technique, order, nulls, hero"));
    assert!(fails(&["parts", "first-light", "--estimator", "magic"], 1).contains("not an estimator"));
}

/// Contributions are traced with the progressive majorants of the film.
#[test]
fn rising_majorants_are_those_of_the_film() {
    let keys = [
        "--set",
        "film.width=24",
        "film.height=18",
        "medium.majorant.factor=0.1",
        "medium.majorant.resolution=8",
        "medium.majorant.when_exceeded=\"progressive\"",
    ];
    let of = |command: &[&str]| json(&[command, &["--json"], &keys[..]].concat());
    let film = of(&["render", "first-light", "--spp", "21"]);
    let parts = of(&["parts", "first-light", "--spp", "21"]);
    let number = |v: &Value| v.as_f64().unwrap();
    for c in 0..3 {
        let sum: f64 = parts["parts"].as_array().unwrap().iter().map(|p| number(&p["mean"][c])).sum();
        let mean = number(&film["mean"][c]);
        assert!((sum - mean).abs() < 1e-6 * mean, "{sum} {mean}");
    }
}
