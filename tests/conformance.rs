//! Every estimator on every case of the self-check, as one family of comparisons with the power to detect a
//! bias of 1 % in the mean of any scene; and tests of the check with faulty estimators.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "tests may panic, and print their tables"
)]

use majorant_core::check::{self, Case, Check, Effort, Report, Verdict, own_scene};
use majorant_core::estimator::{self, Entry, PathEstimate, PathIndex, Settings};
use majorant_core::io::{Library, embedded, scene_file};
use majorant_core::scene::{Fault, Scene, WhenExceeded};
use majorant_core::spectrum::SpectrumDoc;
use majorant_core::transport::{CancelToken, PathContext};
use std::collections::BTreeMap;

fn run(cases: Vec<Case>, effort: Effort) -> Report {
    let report = Check { cases, effort }.run(CancelToken::NEVER, |progress| {
        for r in progress.rows {
            println!(
                "{:36} {:13} {:9.5} {:9.5} z {:5.2} worst {:5.2} of {:4.2} sees {:5.2} % with {:>9} paths {:?}",
                r.scene,
                r.estimator,
                r.measured,
                r.expected,
                r.z,
                r.worst_z,
                r.critical_z,
                100.0 * r.detectable,
                r.paths,
                r.verdict
            );
        }
    });
    let report = report.unwrap_or_else(|e| panic!("{e}")).unwrap();
    println!("{:.1} s", report.seconds);
    report
}

#[test]
fn every_estimator_is_true_on_every_case() {
    let cases = check::built_in(true).unwrap();
    let budgeted: Vec<_> = cases.iter().filter(|c| c.budget.is_some()).map(|c| c.name.clone()).collect();
    let images: usize = cases.iter().map(|case| case.estimators().len()).sum();
    let report = run(cases, Effort::DEEP);
    let failures: Vec<_> = report.failures().collect();
    assert!(failures.is_empty(), "{failures:#?}");
    assert_eq!(report.rows.len(), images, "every estimator is tested on every case");
    // The specified power: 1 % in the mean of every scene with every estimator, except for estimators that
    // rarely hit the lights of a few scenes by other renderers, which have a budget of paths instead.
    let weak: Vec<_> =
        report.rows.iter().filter(|r| !(r.detectable <= 0.01 || budgeted.contains(&r.scene))).collect();
    assert!(weak.is_empty(), "{weak:#?}");
}

/// The embedded scenes, checked like a user's scene. Some are difficult, with noise dominated by rare paths,
/// which must not cause a wrong verdict.
#[test]
fn estimators_agree_on_the_embedded_scenes() {
    for seed in 0..2 {
        let scenes = embedded::SCENES.iter().map(|s| {
            let mut doc = scene_file::parse(s.toml, s.name).unwrap();
            doc.render.seed = seed;
            let mut case = own_scene(s.name, &doc, Library::default());
            case.budget = Some(120_000);
            case
        });
        let report = run(scenes.collect(), Effort::QUICK);
        assert!(report.passes(), "{:#?}", report.failures().collect::<Vec<_>>());
        let (agree, undecided) = report.agreeing_and_undecided();
        // With so few paths, most estimators are undecided on a cloud lit by a small sun and on lamps in fog.
        assert!(agree > undecided, "{agree} agree, {undecided} undecided");
    }
}

/// An estimator that is 3 % too bright and otherwise correct.
fn bright(scene: &Scene, settings: &Settings, at: PathIndex, context: PathContext<'_>) -> PathEstimate {
    let truth = (estimator::find("uni-nee-mis").unwrap().kernel)(scene, settings, at, context);
    PathEstimate { rgb: truth.rgb * 1.03, ..truth }
}

static BRIGHT: [Entry; 1] = [Entry {
    id: "bright",
    name: "Too bright",
    summary: "",
    reference: "",
    uses: estimator::Axis::ALL.as_slice(),
    infinite_variance: |_| None,
    bias_of: |_| None,
    kernel: bright,
}];

/// The check has the specified power: a bias of detectable size is found in at least 90 % of the rows.
#[test]
fn a_small_bias_is_found_in_nearly_every_case() {
    let mut cases = check::built_in(false).unwrap();
    cases.retain(|c| matches!(c.answer, check::Answer::Known(_)));
    for case in &mut cases {
        case.registry = &BRIGHT;
    }
    let report = run(cases, Effort::QUICK);
    let found = report.rows.iter().filter(|r| matches!(r.verdict, Verdict::Differs { .. })).count();
    assert!(
        report.rows.len() > 40 && found * 10 >= report.rows.len() * 9,
        "{found} of {}",
        report.rows.len()
    );
}

/// A clamped majorant is declared biased and not compared; undeclared it is detected.
#[test]
fn a_clamped_majorant_is_labelled_and_caught() {
    static UNLABELLED: std::sync::LazyLock<Vec<Entry>> = std::sync::LazyLock::new(|| {
        estimator::REGISTRY.iter().map(|e| Entry { bias_of: |_| None, ..*e }).collect()
    });
    let mut case = check::named("single-scattering/grid-majorant-0.5").unwrap().remove(0);
    case.doc.medium_mut().majorant.when_exceeded = WhenExceeded::Clamp;
    assert!(case.estimators().is_empty());
    case.registry = &UNLABELLED;
    for row in run(vec![case], Effort::QUICK).rows {
        assert!(!row.passes(), "{row:?}");
    }
}

/// Every deliberate fault is declared; undeclared, the check detects each in a suitable case.
#[test]
fn planted_faults_are_labelled_and_caught() {
    static UNLABELLED: std::sync::LazyLock<Vec<Entry>> = std::sync::LazyLock::new(|| {
        let with = |id: &str| *estimator::find(id).unwrap();
        vec![with("nee"), Entry { bias_of: |_| None, ..with("uni-nee-mis") }]
    });
    for fault in Fault::ALL {
        let name = match fault {
            Fault::None => continue,
            Fault::HeroProbability => "half-space/chromatic-analogue",
            Fault::RouletteOnOneTechnique => "half-space/chromatic-roulette",
            Fault::NullByRounding | Fault::PhaseInBoth => "single-scattering/sun-hg0.9",
            Fault::NullCap => "single-scattering/grid-majorant-10",
        };
        let mut case = check::named(name).unwrap().remove(0);
        case.registry = &UNLABELLED;
        if fault == Fault::HeroProbability {
            // One channel only absorbs; there is no closed form for this case.
            case.doc.medium_mut().albedo = SpectrumDoc::Rgb([0.95, 0.0, 0.8]);
            case.answer = check::Answer::Agreement;
        }
        assert!(run(vec![case.clone()], Effort::QUICK).passes(), "{name} without a fault");
        case.doc.estimator.fault = fault;
        let labelled = estimator::find("uni-nee-mis").unwrap().bias(&case.doc);
        assert!(labelled.is_some_and(|why| why.contains("planted")), "{labelled:?}");
        let report = run(vec![case], Effort::QUICK);
        let failures: Vec<_> = report.failures().map(|row| row.estimator).collect();
        assert!(failures.contains(&"uni-nee-mis"), "{fault:?}: {:#?}", report.rows);
    }
}

/// Without a known answer, the biased estimator is distinguished from the correct ones.
#[test]
fn the_odd_one_out_is_named() {
    static WITH_BRIGHT: std::sync::LazyLock<Vec<Entry>> =
        std::sync::LazyLock::new(|| estimator::REGISTRY.iter().copied().chain(BRIGHT).collect());
    let mut cases = check::named("agreement/cloud").unwrap();
    cases[0].registry = &WITH_BRIGHT;
    let report = run(cases, Effort::DEEP);
    let against: BTreeMap<_, _> = report
        .rows
        .iter()
        .map(|r| match &r.verdict {
            Verdict::Differs { from } => (r.estimator, from.clone()),
            _ => (r.estimator, Vec::new()),
        })
        .collect();
    assert!(against["bright"].len() >= 4, "{against:?}");
    // One or two are too noisy to detect a difference of a few per cent; none differs from another.
    for (estimator, from) in against.iter().filter(|(id, _)| **id != "bright") {
        assert!(from.iter().all(|other| other == "bright"), "{estimator}: {from:?}");
    }
}
