//! Settings of every view.

use crate::compare::Standing;
use crate::compare::report::gather::{Gathered, Shown};
use crate::compare::report::{reproduce, words};
use crate::scene::{Absorption, EstimatorDoc, MajorantDoc, Mode, WhenExceeded};
use serde::Serialize;
use serde_json::Value;

/// Settings of one view.
#[derive(Serialize)]
pub(super) struct Setting {
    label: String,
    name: String,
    mode: &'static str,
    absorption: &'static str,
    choices: String,
    depth: String,
    roulette: String,
    majorant: String,
    seed: u64,
    spp: u64,
    against: String,
    command: Option<String>,
}

/// Settings of all views, in their order.
pub(super) fn settings(gathered: &Gathered<'_>) -> Vec<Setting> {
    gathered.views.iter().zip(&gathered.standings).map(|view| setting(gathered, view)).collect()
}

fn setting(gathered: &Gathered<'_>, (shown, standing): (&Shown<'_>, &Standing)) -> Setting {
    let doc = &shown.view.doc;
    let estimator = &doc.estimator;
    Setting {
        label: standing.label.clone(),
        name: standing.name.clone(),
        mode: match estimator.mode {
            Mode::Spectral => "spectral",
            Mode::Rgb => "RGB",
        },
        absorption: match estimator.absorption {
            Absorption::Analogue => "analogue",
            Absorption::Weighted => "weighted",
            Absorption::Roulette => "roulette",
        },
        choices: choices(estimator),
        depth: estimator.max_depth.map_or_else(|| "unlimited".into(), |d| d.to_string()),
        roulette: estimator.roulette_depth.map_or_else(|| "never".into(), |d| format!("after {d}")),
        majorant: majorant(&doc.medium().majorant),
        seed: doc.render.seed,
        spp: standing.spp,
        against: words::against(&standing.against),
        command: reproduce::command(shown, &gathered.experiment.doc),
    }
}

/// Further settings that differ from the defaults, in the notation of scene files.
fn choices(estimator: &EstimatorDoc) -> String {
    const SHOWN: [&str; 5] = ["id", "mode", "absorption", "max_depth", "roulette_depth"];
    let (Ok(Value::Object(chosen)), Ok(usual)) =
        (serde_json::to_value(estimator), serde_json::to_value(EstimatorDoc::default()))
    else {
        return String::new();
    };
    let differ =
        chosen.iter().filter(|(key, value)| !SHOWN.contains(&key.as_str()) && usual[key.as_str()] != **value);
    let words = differ.map(|(key, value)| match value {
        Value::String(word) => format!("{key}: {word}"),
        other => format!("{key}: {other}"),
    });
    let words: Vec<_> = words.collect();
    if words.is_empty() { "defaults".into() } else { words.join(", ").replace('"', "") }
}

fn majorant(doc: &MajorantDoc) -> String {
    let mut text = format!("× {}", doc.factor);
    if doc.shared {
        text += ", shared by all components";
    }
    if doc.factor < 1.0 {
        text += match doc.when_exceeded {
            WhenExceeded::Clamp => ", clamped",
            WhenExceeded::Weighted => ", weighted where exceeded",
            WhenExceeded::Progressive => ", raised where exceeded",
        };
    }
    text
}
