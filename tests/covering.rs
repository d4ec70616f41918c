//! Settings in pairs: a covering array over every choice that changes how an image is estimated, each row held against a
//! closed form or quadrature with the power of the self-check; what is declared biased is measured to be; what an
//! estimator does not use leaves its image bit by bit as it is.
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
use majorant_core::check::{Case, Check, Effort, Report, Verdict};
use majorant_core::estimator::{Entry, PathIndex, REGISTRY, Settings};
use majorant_core::scene::build;
use majorant_core::transport::CancelToken;

fn case(number: usize, row: &Row) -> Case {
    let place = row.place();
    let case = Case::new(format!("{number} {}", row.words()), &place.toml(), place.answer()).unwrap();
    let mut case = case.with_files(scene::files()).among(std::slice::from_ref(row.entry()));
    case.doc = row.document();
    case
}

fn run(cases: Vec<Case>, effort: Effort) -> Report {
    let report = Check { cases, effort }.run(CancelToken::NEVER, |progress| {
        for r in progress.rows {
            println!(
                "{:9.5} {:9.5} z {:5.2} sees {:5.2} % with {:>9} paths {:?}  {}",
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

/// The relative bias of a row's mean that is looked for: 2 %, or with `MAJORANT_DEEP` set the 1 % of the other cases, for
/// four times as long. The noisiest rows have a budget of three million paths (twelve), and see two and a half times as much
/// at worst.
fn detect() -> f64 {
    if std::env::var_os("MAJORANT_DEEP").is_some() { 0.01 } else { 0.02 }
}

/// Every pair of values, and every triple of those that interact, in an unbiased image that is as it should be.
#[test]
fn every_pair_of_settings_is_true() {
    let began = std::time::Instant::now();
    let array = Array::generate();
    println!("{} targets, {} rows, {:.1} s", array.targets, array.rows.len(), began.elapsed().as_secs_f64());
    for (target, rule) in &array.forbidden {
        println!("left out: {} ({rule})", array::words(target));
        assert!(!rule.is_empty(), "{} is in no row, and no rule says why", array::words(target));
    }
    let cases: Vec<_> = array.rows.iter().enumerate().map(|(i, row)| case(i, row)).collect();
    let detect = detect();
    let max_paths = (1200.0 / (detect * detect)) as u64;
    let report = run(cases, Effort { detect, max_paths, ..Effort::DEEP });
    println!("{:.1} s", report.seconds);
    let failures: Vec<_> = report.failures().map(|row| (&row.scene, row.measured, row.expected)).collect();
    assert!(failures.is_empty(), "{failures:#?}");
    assert_eq!(report.rows.len(), array.rows.len(), "nothing is left out");
    let weak: Vec<_> = report
        .rows
        .iter()
        .filter(|r| r.detectable.is_nan() || r.detectable > 2.5 * detect)
        .map(|r| &r.scene)
        .collect();
    assert!(weak.is_empty(), "{weak:#?}");
}

/// Copies of the registry's entries that claim to be unbiased.
fn unlabelled() -> &'static [Entry] {
    static ENTRIES: std::sync::LazyLock<Vec<Entry>> =
        std::sync::LazyLock::new(|| REGISTRY.iter().map(|e| Entry { bias_of: |_| None, ..*e }).collect());
    &ENTRIES
}

/// Single choices that bias some estimator in some medium: what is declared biased is measured to be, and the same choice is
/// measured to be true where it is not declared.
#[test]
fn what_is_declared_biased_is() {
    let choices: [(&str, &[(&str, &str)]); 3] = [
        ("cut off", &[("medium.majorant.factor", "0.5"), ("medium.majorant.when_exceeded", "clamp")]),
        (
            "cut off at first",
            &[("medium.majorant.factor", "0.5"), ("medium.majorant.when_exceeded", "progressive")],
        ),
        ("exceeded", &[("medium.majorant.factor", "0.5"), ("medium.majorant.when_exceeded", "weighted")]),
    ];
    let (mut biased, mut cases) = (Vec::new(), Vec::new());
    for (what, settings) in choices {
        for entry in unlabelled() {
            let labelled = majorant_core::estimator::find(entry.id).unwrap();
            for density in ["uniform", "rough"] {
                let mut row = Row::plain(
                    entry.id,
                    &[("density", density), ("estimator.mode", "rgb"), ("known", "single")],
                );
                for (key, value) in settings {
                    row.set(key, value);
                }
                // A choice that the estimator does not use is another test's.
                if settings.iter().any(|(key, _)| !row.uses(key)) {
                    continue;
                }
                let mut case = case(cases.len(), &row);
                case.name = format!("{what} {density} {}", entry.id);
                case.registry = std::slice::from_ref(entry);
                if !case.estimators().is_empty() {
                    biased.push(labelled.bias(&case.doc).is_some());
                    cases.push(case);
                }
            }
        }
    }
    let report = run(cases, Effort { detect: 0.02, ..Effort::DEEP });
    assert_eq!(report.rows.len(), biased.len());
    for (row, biased) in report.rows.iter().zip(&biased) {
        let differs = matches!(row.verdict, Verdict::Differs { .. });
        assert!(differs == *biased && row.detectable <= 0.025, "declared biased: {biased}, {row:#?}");
    }
    assert!(biased.iter().filter(|b| **b).count() >= 16, "{biased:?}");
}

/// Single precision products overflow along the long paths of a dense medium, and their light is lost.
#[test]
fn products_in_single_precision_lose_light() {
    let mut row =
        Row::plain("uni-nee-mis", &[("density", "uniform"), ("estimator.mode", "rgb"), ("known", "furnace")]);
    row.set("estimator.bookkeeping", "apart-f32");
    let mut case = case(0, &row);
    case.doc.medium.scale = 120.0;
    assert!(case.estimators().is_empty(), "it is labelled");
    case.registry = unlabelled();
    case.registry = std::slice::from_ref(case.registry.iter().find(|e| e.id == "uni-nee-mis").unwrap());
    let rescaled = case.varied("rescaled", |doc| doc.estimator.bookkeeping = Default::default());
    let effort = Effort { max_paths: 40_000, ..Effort::QUICK };
    let report = run(vec![case, rescaled], effort);
    let passes: Vec<_> = report.rows.iter().map(|row| row.passes()).collect();
    assert_eq!(passes, [false, true], "{:#?}", report.rows);
}

/// An axis that an estimator does not use changes no bit of its image; one that it uses changes some.
#[test]
fn unused_axes_leave_images_as_they_are() {
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
    for entry in REGISTRY {
        for axis in AXES.iter().filter(|a| a.axis.is_some()) {
            let mut changed = false;
            for density in ["uniform", "rough", "colours"] {
                for coloured in ["true", "false"] {
                    let place = [("density", density), ("coloured", coloured), ("known", "single")];
                    let plain = Row::plain(entry.id, &place);
                    let before = paths(&plain, entry);
                    for value in &axis.values {
                        let mut row = plain.clone();
                        row.set(axis.key, value);
                        changed |= paths(&row, entry) != before;
                    }
                }
            }
            assert_eq!(changed, axis.used_by(entry), "{}: {}", entry.id, axis.key);
        }
    }
}
