//! Pairwise tests of the settings that affect an estimate.
//!
//! Every row of a covering array over these settings is compared with a closed form or quadrature, with the
//! statistical power of the self-check. Settings declared biased are measured to be biased. Settings that an
//! estimator does not use leave its image unchanged bit for bit.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "tests may panic, and print their tables"
)]

#[path = "covering/array.rs"]
mod array;
#[path = "covering/axes.rs"]
mod axes;
#[path = "covering/scene.rs"]
mod scene;
#[path = "covering/truth.rs"]
mod truth;

use array::Array;
use axes::{AXES, Row};
use majorant_core::check::{Answer, Case, Check, Effort, Layout, Report, Verdict};
use majorant_core::estimator::{Axis, Entry, PathIndex, REGISTRY, Settings};
use majorant_core::scene::{EmissionDoc, Fault, SceneDoc, build, keys};
use majorant_core::spectrum::SpectrumDoc;
use majorant_core::transport::CancelToken;
use scene::Known;
use std::collections::BTreeSet;

fn case(number: usize, row: &Row) -> Case {
    let place = row.place();
    let case = Case::new(format!("{number} {}", row.words()), &place.toml(), place.answer()).unwrap();
    let mut case = case.with_files(scene::files()).among(std::slice::from_ref(row.entry()));
    case.doc = row.document();
    case
}

fn run(cases: Vec<Case>, effort: Effort) -> Report {
    let mut last = std::time::Instant::now();
    let report = Check { cases, effort }.run(CancelToken::NEVER, |progress| {
        for r in progress.rows {
            let seconds = last.elapsed().as_secs_f64();
            last = std::time::Instant::now();
            println!(
                "{:9.5} {:9.5} z {:5.2} detects {:5.2} % with {:>9} paths {seconds:5.2} s {:?}  {}",
                r.measured,
                r.expected,
                r.z,
                100.0 * r.detectable,
                r.paths,
                r.verdict,
                r.scene
            );
        }
    });
    report.unwrap_or_else(|e| panic!("{e}")).unwrap()
}

/// Relative bias of a row's mean that is detected with 95 % probability.
const DETECT: f64 = 0.01;
/// Detectable relative bias for single choices, whose biases are larger.
const DETECT_CHOICE: f64 = 0.02;
/// Maximum number of paths per row; every row needs fewer.
const MAX_PATHS: u64 = 20_000_000;

/// Whether a row would have detected a relative bias of this size; false if its noise is unknown.
fn detects(row: &majorant_core::check::Row, bias: f64) -> bool {
    row.detectable <= bias
}

/// Rows that would not have detected a relative bias of this size, with their detectable bias.
fn underpowered(report: &Report, bias: f64) -> Vec<(&str, f64)> {
    let missing = report.rows.iter().filter(|row| !detects(row, bias));
    missing.map(|row| (row.scene.as_str(), row.detectable)).collect()
}

/// Compares an unbiased image with its reference for every pair of values, and every triple of interacting
/// axes.
#[test]
fn every_pair_of_settings_matches_its_reference() {
    let began = std::time::Instant::now();
    let array = Array::generate();
    println!("{} targets, {} rows, {:.1} s", array.targets, array.rows.len(), began.elapsed().as_secs_f64());
    for (target, rule) in &array.forbidden {
        println!("left out: {} ({rule})", array::words(target));
        assert!(!rule.is_empty(), "{} is in no row, and no rule forbids it", array::words(target));
    }
    for target in &array.idle {
        println!("idle: {}", array::words(target));
    }
    let cases: Vec<_> = array.rows.iter().enumerate().map(|(i, row)| case(i, row)).collect();
    println!("{:.1} s", began.elapsed().as_secs_f64());
    let report = run(cases, Effort { detect: DETECT, max_paths: MAX_PATHS, ..Effort::DEEP });
    println!("{:.1} s", report.seconds);
    let failures: Vec<_> = report.failures().map(|row| (&row.scene, row.measured, row.expected)).collect();
    assert!(failures.is_empty(), "{failures:#?}");
    assert_eq!(report.rows.len(), array.rows.len(), "a row was left out");
    let weak = underpowered(&report, DETECT);
    assert!(weak.is_empty(), "{weak:#?}");
}

/// Copies of the registry's entries without any declared bias.
fn unlabelled() -> &'static [Entry] {
    static ENTRIES: std::sync::LazyLock<Vec<Entry>> =
        std::sync::LazyLock::new(|| REGISTRY.iter().map(|e| Entry { bias_of: |_| None, ..*e }).collect());
    &ENTRIES
}

/// A row with additional settings, measured under one estimator.
struct Choice {
    what: String,
    row: Row,
    set: fn(&mut SceneDoc),
    /// Maximum number of paths.
    budget: Option<u64>,
    /// Relative bias to detect.
    detect: f64,
    /// Reference, if it differs from that of the row's scene.
    answer: Option<Answer>,
}

impl Choice {
    fn new(what: impl Into<String>, row: Row, set: fn(&mut SceneDoc)) -> Self {
        Self { what: what.into(), row, set, budget: None, detect: DETECT_CHOICE, answer: None }
    }
}

/// Biased choices, and the same choices in scenes where they are unbiased, for every bias rule of the table
/// of keys.
fn choices() -> Vec<Choice> {
    let mut choices = Vec::new();
    for entry in REGISTRY {
        for density in ["uniform", "rough"] {
            let row = Row::plain(entry.id, &[("density", density), ("estimator.mode", "rgb")]);
            for when in ["clamp", "progressive", "weighted"] {
                let mut row = row.clone();
                row.set("medium.majorant.factor", "0.5");
                row.set("medium.majorant.when_exceeded", when);
                choices.push(Choice::new(format!("exceeded, {when}, {density}"), row, |_| ()));
            }
            if row.uses("estimator.transmittance") {
                // The small size lets ray marching reach the side of the box in one step, and the scaled
                // density makes that step optically thick.
                let mut row = row.clone();
                row.set("estimator.transmittance", "marching");
                (row.percent, row.size) = (Some(400), 5);
                choices.push(Choice::new(format!("marched, {density}"), row, |_| ()));
            }
        }
        // An emissive medium without scattering.
        let mut row = Row::plain(entry.id, &[("density", "uniform")]);
        (row.known, row.coloured) = (Known::Transmittance, false);
        let emission =
            truth::film(|lambda| (1.0 - row.place().transmittance()) * truth::blackbody(f64::from(lambda)));
        choices.push(Choice {
            answer: Some(Answer::uniform(emission, Layout::WHOLE)),
            ..Choice::new("glows", row, |doc| {
                doc.medium_mut().emission = Some(EmissionDoc::default());
                doc.lights.clear();
            })
        });
    }
    let rough = Row::plain("uni-nee-mis", &[("density", "rough"), ("estimator.roulette_depth", "1")]);
    let uniform = Row::plain("uni-nee-mis", &[("density", "uniform")]);
    choices.push(Choice::new("no fault", rough.clone(), |_| ()));
    let mut fault = |row: &Row, budget: Option<u64>, set: fn(&mut SceneDoc)| {
        let mut doc = row.document();
        set(&mut doc);
        let what = format!("{:?}", doc.estimator.fault);
        choices.push(Choice { budget, detect: DETECT, ..Choice::new(what, row.clone(), set) });
    };
    fault(&rough, None, |doc| doc.estimator.fault = Fault::RouletteOnOneTechnique);
    fault(&rough, None, |doc| doc.estimator.fault = Fault::PhaseInBoth);
    // The first acts at collisions with null density zero; the second ends flights with more than eight null
    // collisions.
    fault(&uniform, None, |doc| doc.estimator.fault = Fault::NullByRounding);
    fault(&rough, Some(200_000), |doc| {
        doc.estimator.fault = Fault::NullCap;
        doc.medium_mut().majorant.factor = 30.0;
    });
    // The hero's probabilities cancel unless another hero never samples the same event: green, with albedo 0,
    // never scatters.
    let mut row = Row::plain("uni-nee-mis", &[("density", "uniform"), ("estimator.mode", "rgb")]);
    row.set("estimator.absorption", "analogue");
    let Answer::Known(mut colour) = row.place().answer() else { panic!("no known answer") };
    colour[1].mean = 0.0;
    let dark: [fn(&mut SceneDoc); 2] = [
        |doc| doc.medium_mut().albedo = SpectrumDoc::Rgb([0.9, 0.0, 0.5]),
        |doc| {
            doc.medium_mut().albedo = SpectrumDoc::Rgb([0.9, 0.0, 0.5]);
            doc.estimator.fault = Fault::HeroProbability;
        },
    ];
    for (what, set) in ["green is black", "HeroProbability"].into_iter().zip(dark) {
        let answer = Some(Answer::Known(colour.clone()));
        choices.push(Choice { answer, detect: DETECT, ..Choice::new(what, row.clone(), set) });
    }
    // Products in single precision overflow along the long paths of a dense medium, which loses their
    // contributions.
    for bookkeeping in ["apart-f32", "rescaled"] {
        let mut row = Row::plain("uni-nee-mis", &[("density", "uniform"), ("estimator.mode", "rgb")]);
        row.set("estimator.bookkeeping", bookkeeping);
        (row.known, row.percent) = (Known::Furnace, Some(20_000));
        choices.push(Choice { budget: Some(400_000), ..Choice::new(bookkeeping, row, |_| ()) });
    }
    choices
}

/// Measures the choices of every bias rule of the table of keys: those declared biased differ from their
/// reference, all others agree with it.
#[test]
fn exactly_the_declared_biases_are_measured() {
    let (mut declared, mut cases, mut rules) =
        ([Vec::new(), Vec::new()], [Vec::new(), Vec::new()], BTreeSet::new());
    for (number, choice) in choices().into_iter().enumerate() {
        let labelled = choice.row.entry();
        let mut case = case(number, &choice.row);
        (choice.set)(&mut case.doc);
        case.name = format!("{} {}", choice.what, labelled.id);
        case.budget = choice.budget;
        case.answer = choice.answer.unwrap_or(case.answer);
        case.registry = std::slice::from_ref(unlabelled().iter().find(|e| e.id == labelled.id).unwrap());
        let bias = labelled.bias(&case.doc);
        let ruled = keys::all().iter().filter(|key| key.biases.is_some_and(|b| (b.holds)(&case.doc)));
        let ruled: Vec<_> = ruled.map(|key| key.path).collect();
        assert!(bias.is_none() || !ruled.is_empty(), "{}: {bias:?} without a rule in the table", case.name);
        if bias.is_some() {
            rules.extend(ruled);
        }
        if !case.estimators().is_empty() {
            let closely = usize::from(choice.detect == DETECT);
            declared[closely].push(bias.is_some());
            cases[closely].push(case);
        }
    }
    for key in keys::all().iter().filter(|key| key.biases.is_some() && !key.path.starts_with("compare.")) {
        assert!(rules.contains(key.path), "{}: no case measures its bias", key.path);
    }
    let declared = declared.concat();
    assert!(declared.iter().filter(|declared| **declared).count() >= 24, "{declared:?}");
    let reports = cases
        .into_iter()
        .zip([DETECT_CHOICE, DETECT])
        .map(|(cases, detect)| run(cases, Effort { detect, ..Effort::DEEP }));
    let rows: Vec<_> = reports.flat_map(|report| report.rows).collect();
    assert_eq!(rows.len(), declared.len());
    let wrong: Vec<_> = rows
        .iter()
        .zip(&declared)
        .filter(|(row, declared)| {
            let differs = matches!(row.verdict, Verdict::Differs { .. } | Verdict::NotFinite { .. });
            // An unbiased choice must be measured with the required power.
            differs != **declared || !**declared && !detects(row, DETECT_CHOICE)
        })
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// With a fiftieth of their paths, rows lack the statistical power that the pairwise test requires.
#[test]
fn a_fiftieth_of_the_paths_lacks_power() {
    let rows = ["uni-nee-mis", "nee", "spectral-mis", "spectral-tracking"]
        .map(|id| Row::plain(id, &[("density", "rough"), ("estimator.mode", "rgb")]));
    let cases: Vec<_> = rows.iter().enumerate().map(|(i, row)| case(i, row)).collect();
    let effort = Effort { detect: DETECT, max_paths: MAX_PATHS, ..Effort::DEEP };
    let report = run(cases.clone(), effort);
    assert_eq!(underpowered(&report, DETECT), []);
    for (mut case, row) in cases.into_iter().zip(&report.rows) {
        case.budget = Some(row.paths / 50);
        let report = run(vec![case], effort);
        assert_eq!(underpowered(&report, DETECT).len(), 1, "{:#?}", report.rows);
    }
}

/// An axis that an estimator does not use leaves its image unchanged bit for bit; every axis that it uses
/// changes it.
#[test]
fn unused_axes_leave_images_unchanged() {
    let paths = |row: &Row, entry: &Entry| -> Vec<[u32; 3]> {
        let doc = row.document();
        let scene = build(&doc, &mut scene::files()).unwrap();
        let settings = Settings::new(&doc.estimator, 5);
        let at = |i: u32| PathIndex { x: i % 2, y: i / 2 % 2, sample: u64::from(i / 4) };
        let bits = |i| {
            (entry.kernel)(&scene, &settings, at(i), CancelToken::NEVER.into())
                .rgb
                .to_array()
                .map(f32::to_bits)
        };
        (0..400).map(bits).collect()
    };
    let mut wrong = Vec::new();
    for entry in REGISTRY {
        for axis in AXES.iter().filter(|a| a.axis.is_some()) {
            let mut changed = false;
            for density in ["uniform", "rough", "colours"] {
                for coloured in [true, false] {
                    let mut plain = Row::plain(entry.id, &[("density", density)]);
                    plain.coloured = coloured;
                    let before = paths(&plain, entry);
                    for value in &axis.values {
                        let mut row = plain.clone();
                        row.set(axis.key, value);
                        changed |= paths(&row, entry) != before;
                    }
                }
            }
            if changed != axis.used_by(entry) {
                wrong.push(format!("{}: {} changes the image: {changed}", entry.id, axis.key));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Every key that affects the estimate is an axis with values or is listed in `NO_AXES` with a reason.
#[test]
fn every_key_of_the_estimate_is_an_axis() {
    for key in axes::keys_of_the_estimate() {
        let values = AXES.iter().find(|axis| axis.key == key.path).map(|axis| axis.values.len());
        let reason = axes::NO_AXES.iter().find(|(path, _)| *path == key.path);
        assert!(
            values.is_some_and(|n| n >= 2) != reason.is_some(),
            "{} affects the estimate: add values for it, or a reason to `NO_AXES`",
            key.path
        );
    }
    for (path, reason) in axes::NO_AXES {
        assert!(!reason.is_empty() && axes::keys_of_the_estimate().any(|key| key.path == path), "{path}");
    }
    for axis in Axis::ALL {
        let is_axis = AXES.iter().any(|a| a.axis == Some(axis));
        assert!(is_axis != axes::NO_AXES.iter().any(|(path, _)| *path == axis.key()), "{axis:?}");
    }
    // The densities cover every kind that a scene file accepts.
    let kinds = keys::find("medium.density.kind", None).unwrap().values();
    let used: BTreeSet<_> = scene::Density::ALL.map(|density| density.kind().0).into();
    assert_eq!(used, kinds.into_iter().collect());
}

/// Quadrature on coarser grids agrees with the reference within the stated error.
#[test]
fn quadrature_error_is_within_its_bound() {
    let fields = [
        (&*truth::CONSTANT, truth::constant(0.8)),
        (&*truth::ROUGH, truth::rough(0.8)),
        (&*truth::COLOURS, truth::colours(0.8)),
    ];
    // At 4/5 of the resolution the error is 25/16 of the reference's error, so the difference is 9/16 of it.
    for (field, coarser) in fields {
        for sigma in [[0.9, 0.0, 0.0], [0.36, 0.0, 0.0], [0.5, 0.4, 0.3]] {
            let (a, b) = (field.single(sigma), coarser.single(sigma));
            println!("{a} {b}: {:.1e}", a / b - 1.0);
            assert!((a / b - 1.0).abs() < 9.0 / 16.0 * truth::QUADRATURE, "{a} {b}");
            let (a, b) = (field.transmittance(sigma), coarser.transmittance(sigma));
            assert!((a / b - 1.0).abs() < 9.0 / 16.0 * truth::QUADRATURE, "{a} {b}");
        }
    }
}
