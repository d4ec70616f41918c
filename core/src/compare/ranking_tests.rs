//! Tests of the ranking on images with known noise.

use super::{ComparedWith, Question, RankedView, Reference, Standing, Verdict, comparisons, rank};
use crate::film::{Film, Images, Snapshot, Tally};
use crate::math::Sampler;
use crate::measure;
use crate::scene::{SceneDoc, WhenExceeded};
use std::sync::Arc;

const SIZE: usize = 24;
const SPP: u64 = 24;

/// Exponential samples of mean 1 + `bias`, averaged over `quiet` values, with variance 1/quiet.
fn picture(seed: u64, quiet: u64, bias: f32) -> Snapshot {
    let mut film = Film::new(SIZE, SIZE);
    for (i, pixel) in film.pixels.iter_mut().enumerate() {
        for s in 0..SPP {
            let mut sampler = Sampler::new(seed, i as u64, s);
            let mut mean = || (0..quiet).map(|_| sampler.next_optical_depth()).sum::<f32>() / quiet as f32;
            pixel.add(std::array::from_fn(|_| mean() * (1.0 + bias)));
        }
    }
    let Images { mean, standard_error, noise } = Images::of(&film);
    Snapshot {
        generation: seed,
        width: SIZE,
        height: SIZE,
        mean,
        standard_error,
        noise,
        spp: SPP,
        coarse: None,
        seconds: 1.0,
        cpu_seconds: 2.0,
        tally: Tally { paths: 100, lookups: 700, ..Tally::default() },
        threads: 2,
        cost_error: 0.0,
        target: "image".into(),
    }
}

fn doc(seed: u64) -> SceneDoc {
    let mut doc = SceneDoc::default();
    doc.render.seed = seed;
    doc
}

fn question<'a>() -> Question<'a> {
    Question {
        reference: None,
        reference_view: None,
        baseline: 0,
        region: None,
        measures: measure::find("mse").into_iter().collect(),
    }
}

fn ranked(views: &[(SceneDoc, Snapshot)], question: &Question<'_>) -> Vec<Standing> {
    let labels = ["A", "B", "C"];
    let ranked_views: Vec<RankedView<'_>> = views
        .iter()
        .zip(labels)
        .map(|((doc, snapshot), label)| RankedView { label, doc, snapshot })
        .collect();
    rank(&ranked_views, question, &comparisons(&ranked_views, question))
}

#[test]
fn efficiency_is_what_its_formula_says() {
    let views = [(doc(0), picture(1, 1, 0.0)), (doc(1), picture(2, 4, 0.0))];
    let standings = ranked(&views, &question());
    for (s, variance) in standings.iter().zip([1.0, 0.25]) {
        assert!((s.variance * SPP as f64 / variance - 1.0).abs() < 0.1, "{}", s.variance);
        assert!((s.efficiency * s.variance * s.cpu_seconds - 1.0).abs() < 1e-9);
        // The channels are independent here, so that two thirds of the variance are perpendicular to grey.
        assert!((s.chroma_variance / s.variance - 2.0 / 3.0).abs() < 0.05);
        assert_eq!(s.lookups_per_path, 7.0);
    }
    assert_eq!((standings[0].speedup, standings[0].speedup_interval), (1.0, [1.0, 1.0]));
    // Compared with the other view and corrected for its noise, the error equals the variance.
    let mse = standings[0].error("mse").unwrap().corrected();
    assert!((mse / standings[0].variance - 1.0).abs() < 0.2, "{mse} {}", standings[0].variance);
}

/// Without a reference the better view must not look worse: no error is measured against a much noisier
/// image.
#[test]
fn against_much_noisier_views_nothing_is_measured() {
    let views = [(doc(0), picture(1, 64, 0.0)), (doc(1), picture(2, 1, 0.0))];
    let standings = ranked(&views, &question());
    assert!(standings[0].errors.is_empty() && standings[0].agreement.is_some());
    let mse = standings[1].error("mse").unwrap();
    assert!((mse.corrected() / standings[1].variance - 1.0).abs() < 0.2, "{mse:?}");
    // A black view has no noise to correct for.
    let views = [(doc(0), picture(1, 64, 0.0)), (doc(1), picture(2, 1, -1.0))];
    let standings = ranked(&views, &question());
    assert_eq!(standings[0].against, ComparedWith::Others("B".into()));
    assert!(standings.iter().all(|s| s.errors.is_empty()));
    // A chosen reference is always used, and its noise is stated.
    let noisy = Arc::new(picture(3, 1, 0.0));
    let reference = Reference::of(&noisy, "noisy");
    let question = Question { reference: Some(&reference), ..question() };
    let mse = *ranked(&views, &question)[0].error("mse").unwrap();
    assert!(mse.uncertainty() > mse.reference_share && mse.reference_share > 0.9 * mse.value, "{mse:?}");
}

#[test]
fn the_interval_of_the_speed_up_holds_the_truth_as_often_as_it_says() {
    let trials = 200;
    let hits = (0..trials)
        .filter(|i| {
            let views = [(doc(0), picture(2 * i + 100, 1, 0.0)), (doc(1), picture(2 * i + 101, 4, 0.0))];
            let [lo, hi] = ranked(&views, &question())[1].speedup_interval;
            lo <= 4.0 && 4.0 <= hi
        })
        .count();
    // 190 ± 3.1 of 200.
    assert!((181..=199).contains(&hits), "{hits} of {trials}");
}

#[test]
fn noise_of_the_cost_widens_the_interval() {
    let views = |cost_error| {
        let noisy = Snapshot { cost_error, ..picture(2, 4, 0.0) };
        [(doc(0), picture(1, 1, 0.0)), (doc(1), noisy)]
    };
    let width = |cost| {
        let [lo, hi] = ranked(&views(cost), &question())[1].speedup_interval;
        (hi / lo).ln()
    };
    assert!(width(0.2) > 0.75 && width(0.2) > 2.0 * width(0.0), "{} {}", width(0.2), width(0.0));
    assert!(width(f64::INFINITY).is_infinite() || width(f64::INFINITY).is_nan());
}

#[test]
fn a_biased_view_is_excluded_from_pools_and_detected() {
    let mut clamped = doc(2);
    clamped.medium_mut().majorant.factor = 0.5;
    clamped.medium_mut().majorant.when_exceeded = WhenExceeded::Clamp;
    let views = [(doc(0), picture(1, 4, 0.0)), (doc(1), picture(2, 4, 0.0)), (clamped, picture(3, 4, 0.1))];
    let standings = ranked(&views, &question());
    let verdicts: Vec<Verdict> = standings.iter().map(Standing::verdict).collect();
    assert_eq!(verdicts, [Verdict::Agrees, Verdict::Agrees, Verdict::Differs]);
    assert_eq!(standings[0].against, ComparedWith::Others("B".into()));
    assert_eq!(standings[2].against, ComparedWith::Others("A, B".into()));
    let found = standings[2].agreement.unwrap();
    assert!((found.difference - 0.1).abs() < 4.0 * found.error, "{found:?}");
}

#[test]
fn views_are_compared_only_with_the_same_image_under_other_random_numbers() {
    let nothing = |views: &[(SceneDoc, Snapshot)], question: &Question<'_>| {
        let s = &ranked(views, question)[0];
        assert!(s.errors.is_empty() && s.agreement.is_none());
        match &s.against {
            ComparedWith::Nothing(why) => *why,
            other => panic!("{other:?}"),
        }
    };
    let (a, b) = (picture(1, 1, 0.0), picture(2, 1, 0.0));
    // Equal seeds.
    assert!(nothing(&[(doc(0), a.clone()), (doc(0), b.clone())], &question()).contains("own seed"));
    // Different images.
    let other = Snapshot { target: "another".into(), ..b.clone() };
    assert!(nothing(&[(doc(0), a.clone()), (doc(1), other.clone())], &question()).contains("same image"));
    // A reference of a different image is not used, even if other views exist.
    let stale = Reference::of(&Arc::new(other), "stale.exr");
    let with = Question { reference: Some(&stale), ..question() };
    assert!(nothing(&[(doc(0), a.clone()), (doc(1), b.clone())], &with).contains("different image"));
    // A view is not its own reference.
    let promoted = Reference::of(&Arc::new(a.clone()), "view A");
    let with = Question { reference: Some(&promoted), reference_view: Some(0), ..question() };
    assert!(nothing(&[(doc(0), a), (doc(1), b)], &with).contains("the reference"));
}

/// The pool excludes images that are biased, have infinite variance, or lost samples.
#[test]
fn only_sound_pictures_are_pooled() {
    let against = |edit: fn(&mut SceneDoc, &mut Snapshot)| {
        let mut views =
            vec![(doc(1), picture(1, 1, 0.0)), (doc(2), picture(2, 1, 0.0)), (doc(3), picture(3, 1, 0.0))];
        let (doc, snapshot) = &mut views[1];
        edit(doc, snapshot);
        ranked(&views, &question())[0].against.clone()
    };
    assert_eq!(against(|_, _| ()), ComparedWith::Others("B, C".into()));
    assert_eq!(against(|_, s| s.tally.non_finite = 1), ComparedWith::Others("C".into()));
    assert_eq!(
        against(|d, _| {
            d.estimator.id = "mitsuba2-volpath".into();
            d.medium_mut().extinction = crate::spectrum::SpectrumDoc::Rgb([1.0, 2.0, 3.0]);
        }),
        ComparedWith::Others("C".into())
    );
}

/// A promoted view that is biased measures errors, but gives no verdict.
#[test]
fn a_biased_reference_gives_no_verdict() {
    let views = |when_exceeded| {
        let mut biased = doc(2);
        biased.medium_mut().majorant.factor = 0.5;
        biased.medium_mut().majorant.when_exceeded = when_exceeded;
        vec![(doc(1), picture(1, 1, 0.0)), (biased, picture(2, 1, 0.3))]
    };
    let verdict = |when_exceeded| {
        let views = views(when_exceeded);
        let reference = Reference::of(&Arc::new(views[1].1.clone()), "view B");
        let question = Question { reference: Some(&reference), reference_view: Some(1), ..question() };
        let standing = ranked(&views, &question).swap_remove(0);
        (standing.verdict(), standing.errors.len())
    };
    assert_eq!(verdict(WhenExceeded::Weighted), (Verdict::Differs, 1));
    assert_eq!(verdict(WhenExceeded::Clamp), (Verdict::Undecided, 1));
}
