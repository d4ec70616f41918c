//! Statistics are shown only with the images that they describe, in every frame and after any edit.

use super::harness::{Lab, click, doc, lab, lab_on, open, undo, wait};
use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;
use majorant::lab::LabApp;
use majorant::model::Command;
use majorant::model::Source;
use majorant::model::WallEdit;
use majorant::view::tone_mapper::PictureId;
use majorant_core::compare::{ComparedWith, LEAST_SAMPLES, Verdict, label};
use majorant_core::scene::{Fault, ReferenceDoc, SceneDoc};
use majorant_core::session::Status;
use majorant_core::transport::CancelToken;

/// Two views of a grey cube that agree after few samples.
const PAIR: &str = r#"
majorant = 1
film = { width = 32, height = 18 }
medium = { extinction = 3.0, albedo = 0.9 }
lights = [{ kind = "environment" }]
render = { spp = 200 }
[[compare.views]]
seed = 1
"#;

fn pair() -> (Lab, tempfile::TempDir) {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("pair.toml");
    std::fs::write(&path, PAIR).expect("a scene file");
    (lab_on(Source::File(path)), directory)
}

fn edit(lab: &mut Lab, change: impl FnOnce(&mut SceneDoc)) {
    let mut edited = doc(lab).clone();
    change(&mut edited);
    lab.state_mut().request(Command::Edit(Box::new(edited)));
}

fn wall(lab: &mut Lab, edit: WallEdit) {
    lab.state_mut().request(Command::Wall(edit));
}

fn rendered() -> ReferenceDoc {
    ReferenceDoc::Render { estimator: "uni-nee-mis".into(), spp: Some(400), relative_error: None }
}

fn labels(lab: &Lab, text: &str) -> usize {
    lab.query_all_by_label_contains(text).count()
}

fn finished(app: &LabApp) -> bool {
    app.wall().slots().iter().all(|s| s.state.status == Status::Finished)
}

fn decided(app: &LabApp, views: usize) -> bool {
    let standings = &app.wall().analysis().standings;
    standings.len() == views && standings.iter().all(|s| s.verdict() == Verdict::Agrees)
}

/// Invariants of every frame, derived from the document and the session alone.
fn assert_current(app: &LabApp) {
    let wall = app.wall();
    for standing in &wall.analysis().standings {
        let view = (0..wall.slots().len()).find(|v| label(*v) == standing.label).expect("a view");
        let expected = app.doc().view_doc(view).expect("its document");
        assert_eq!(standing.estimator, expected.estimator.id, "view {}", standing.label);
        let picture = wall.slots()[view].picture().expect("an image of the last submission");
        assert!(standing.spp <= picture.spp, "{} samples of {}", standing.spp, picture.spp);
        let uploaded = wall.uploaded(PictureId::View(view)).and_then(|h| h.snapshot.as_ref());
        assert!(uploaded.is_none_or(|h| h.generation == picture.generation), "an older image is shown");
        if let ComparedWith::Others(others) = &standing.against {
            for other in others.split(", ") {
                assert!(wall.analysis().standing(other).is_some(), "{other} has no statistics");
            }
        }
    }
    let reference = wall.uploaded(PictureId::Reference).and_then(|h| h.reference.as_ref());
    if let (Some(shown), Some(slot)) = (reference.and_then(|r| r.snapshot()), wall.rendered_reference()) {
        assert_eq!(shown.generation, slot.state.generation, "an older reference is shown");
    }
}

/// Steps until a condition holds, and checks the invariants in every frame.
fn watch(lab: &mut Lab, what: &str, done: impl Fn(&LabApp) -> bool) {
    wait(lab, what, |app| {
        assert_current(app);
        done(app)
    });
}

#[test]
fn a_verdict_goes_in_the_frame_in_which_its_view_is_edited() {
    let (mut lab, _directory) = pair();
    watch(&mut lab, "the verdict", |app| finished(app) && decided(app, 2));
    lab.run_steps(2);
    // Once in each caption and each row of the ranking.
    assert!(labels(&lab, "agrees") >= 4);
    let before = lab.state().wall().slots()[0].state.generation;
    edit(&mut lab, |doc| doc.estimator.fault = Fault::HeroProbability);
    lab.step();
    let now = lab.state().wall().slots()[0].state.generation;
    assert!(now > before);
    // In the same frame: B was compared with A, which has changed.
    assert_eq!(labels(&lab, "agree"), 0, "the verdict of an older submission");
    let new = |app: &LabApp| app.wall().analysis().standings.iter().any(|s| s.label == "A");
    assert!(!new(lab.state()), "statistics of an older submission");
    while !new(lab.state()) {
        assert_eq!(labels(&lab, "agree"), 0, "the verdict of an older submission");
        assert_current(lab.state());
        lab.step();
    }
    // After undo: the verdict returns with a new image, not before.
    undo(&mut lab);
    assert_eq!(doc(&lab).estimator.fault, Fault::None);
    watch(&mut lab, "the verdict again", |app| decided(app, 2));
}

#[test]
fn numbers_follow_their_views_through_every_edit_of_the_comparison() {
    let (mut lab, _directory) = lab();
    wall(&mut lab, WallEdit::Count(4));
    wall(&mut lab, WallEdit::Reference(ReferenceDoc::Pooled));
    let all = |app: &LabApp| app.wall().analysis().standings.len() == app.doc().view_count();
    watch(&mut lab, "numbers of four", all);
    // A single view, then four views with other settings.
    wall(&mut lab, WallEdit::Count(1));
    lab.step();
    assert_current(lab.state());
    wall(&mut lab, WallEdit::Count(4));
    for estimator in ["nee", "spectral-mis", "uni-nee-mis"] {
        edit(&mut lab, |doc| doc.compare.views[0].estimator.id = estimator.into());
        lab.step();
        assert_current(lab.state());
    }
    watch(&mut lab, "numbers of four again", all);
    for change in [
        WallEdit::Swap(0, 1),
        WallEdit::Remove(0),
        WallEdit::Duplicate(1),
        WallEdit::Baseline(1),
        WallEdit::Region(Some([0, 0, 16, 9])),
        WallEdit::Reference(ReferenceDoc::View { view: 1 }),
        WallEdit::Region(None),
        WallEdit::Reference(ReferenceDoc::None),
    ] {
        wall(&mut lab, change.clone());
        for _ in 0..4 {
            lab.step();
            assert_current(lab.state());
            let analysis = lab.state().wall().analysis();
            let whole = doc(&lab).compare.region.is_none();
            let pixels = if whole { 32 * 18 } else { 16 * 9 };
            assert!(analysis.standings.iter().all(|s| s.pixels == pixels), "{change:?}");
        }
        watch(&mut lab, "numbers after it", all);
    }
    lab.state_mut().request(Command::Restart);
    watch(&mut lab, "the restart", |app| app.wall().analysis().standings.is_empty());
    watch(&mut lab, "numbers after a restart", all);
}

#[test]
fn paused_are_all_views_and_the_reference_those_that_come_later_too() {
    let (mut lab, _directory) = pair();
    edit(&mut lab, |doc| doc.render.spp = None);
    watch(&mut lab, "samples", |app| app.wall().slots().iter().all(|s| s.stats.spp > 2));
    lab.key_press(Key::P);
    lab.run_steps(2);
    assert!(lab.state().wall().is_paused());
    watch(&mut lab, "the pause", |app| app.state().status == Status::Paused);
    lab.run_steps(2);
    lab.get_by_label_contains("Paused at");
    // New views, a reference and an edit of the scene get no samples.
    wall(&mut lab, WallEdit::Count(4));
    wall(&mut lab, WallEdit::Reference(rendered()));
    edit(&mut lab, |doc| doc.medium_mut().scale = 2.0);
    let still = |app: &LabApp| {
        let slots = || app.wall().slots().iter().chain(app.wall().rendered_reference());
        for slot in slots() {
            assert!(!matches!(slot.state.status, Status::Rendering | Status::Finished));
            assert_eq!(slot.picture().map_or(0, |s| s.spp), 0);
        }
        slots().count() == 5 && slots().all(|s| s.state.status == Status::Paused)
    };
    watch(&mut lab, "a pause of all", still);
    std::thread::sleep(std::time::Duration::from_millis(100));
    lab.run_steps(3);
    assert!(still(lab.state()));
    // A step renders one sample of each.
    click(&mut lab, Role::Button, "Step");
    let each = |app: &LabApp, spp: u64| {
        let slots = app.wall().slots().iter().chain(app.wall().rendered_reference());
        slots.into_iter().all(|s| s.picture().is_some_and(|p| p.coarse.is_none() && p.spp == spp))
    };
    watch(&mut lab, "one sample of each", |app| each(app, 1));
    std::thread::sleep(std::time::Duration::from_millis(100));
    lab.run_steps(3);
    assert!(each(lab.state(), 1));
    let preset = majorant::wall::presets::PRESETS[0].name;
    lab.state_mut().request(Command::OpenPreset(preset));
    lab.state_mut().request(Command::Answer(majorant::model::Answer::Discard));
    lab.step();
    assert!(doc(&lab).view_count() > 1 && lab.state().wall().is_paused());
    wait(&mut lab, "the other scene", |app| {
        app.wall().slots().iter().all(|s| s.state.status == Status::Paused && s.stats.spp == 0)
    });
    click(&mut lab, Role::Button, "Resume");
    wait(&mut lab, "all going on", |app| app.wall().slots().iter().all(|s| s.stats.spp > 0));
}

#[test]
fn without_a_reference_variance_and_efficiency_stand_where_errors_would() {
    let (mut lab, _directory) = pair();
    watch(&mut lab, "numbers", |app| finished(app) && decided(app, 2));
    lab.run_steps(2);
    let analysis = lab.state().wall().analysis();
    assert!(analysis.standings.iter().all(|s| s.errors.is_empty() && s.variance > 0.0));
    assert!(analysis.curves.is_empty());
    assert_eq!(labels(&lab, "relMSE"), 0);
    assert!(labels(&lab, "σ²") >= 2 && labels(&lab, "efficiency") >= 1);
    lab.get_by_label_contains(
        "No reference, no errors. Verdicts: against the mean of the other unbiased views.",
    );
    // There is no map of errors either, but one of z.
    wall(&mut lab, WallEdit::Layer("relative".into()));
    watch(&mut lab, "no map", |app| app.wall().uploaded(PictureId::View(0)).is_none());
    lab.step();
    assert!(labels(&lab, "Errors need a reference") >= 2);
    wall(&mut lab, WallEdit::Layer("z".into()));
    watch(&mut lab, "a map of z", |app| {
        app.wall().uploaded(PictureId::View(0)).is_some_and(|h| h.map.is_some())
    });
    wall(&mut lab, WallEdit::Layer("picture".into()));
    // The mean of the other views is named as the reference; errors are corrected for its noise, and their ±
    // includes it.
    lab.run_steps(2);
    click(&mut lab, Role::Button, "Reference");
    click(&mut lab, Role::RadioButton, "The mean of the other unbiased views");
    lab.key_press(Key::Escape);
    watch(&mut lab, "errors", |app| app.wall().analysis().standings.iter().all(|s| !s.errors.is_empty()));
    lab.run_steps(2);
    lab.get_by_label_contains(
        "against the mean of the other unbiased views, corrected for the noise of that mean",
    );
    assert!(labels(&lab, "relMSE") >= 3 && labels(&lab, "±") >= 4);
    for s in &lab.state().wall().analysis().standings {
        let error = s.error("relmse").expect("an error");
        assert!(error.reference_share > 0.0 && error.uncertainty() > error.reference_share);
    }
}

#[test]
fn nothing_is_measured_against_a_picture_without_samples() {
    let (mut lab, _directory) = pair();
    watch(&mut lab, "numbers", |app| finished(app) && decided(app, 2));
    lab.key_press(Key::P);
    lab.run_steps(2);
    wall(&mut lab, WallEdit::Reference(rendered()));
    let reference = |app: &LabApp| app.wall().rendered_reference().map(|s| s.state.status.clone());
    watch(&mut lab, "the reference", |app| reference(app) == Some(Status::Paused));
    std::thread::sleep(std::time::Duration::from_millis(400));
    lab.run_steps(3);
    // The cell of the reference is shown, statistics are not.
    assert!(lab.state().wall().pictures_shown().contains(&PictureId::Reference));
    lab.get_by_label_contains("No reference yet");
    assert_eq!((labels(&lab, " 0 spp"), labels(&lab, "relMSE ")), (0, 0));
    assert!(lab.state().wall().analysis().standings.iter().all(|s| s.errors.is_empty()));
    lab.get_by_label_contains("No errors yet");
    lab.key_press(Key::P);
    watch(&mut lab, "errors", |app| app.wall().analysis().standings.iter().all(|s| !s.errors.is_empty()));
    watch(&mut lab, "the reference's end", |app| reference(app) == Some(Status::Finished));
    let against = ComparedWith::Reference("Uni+NEE MIS, 400 spp".into());
    watch(&mut lab, "the last numbers", |app| {
        let shown = app.wall().uploaded(PictureId::Reference).and_then(|h| h.reference.as_ref());
        app.wall().analysis().standings.iter().all(|s| s.against == against)
            && shown.is_some_and(|r| r.origin == "Uni+NEE MIS, 400 spp")
    });
    lab.run_steps(2);
    // Caption, button and footnote of the table show the same number; every error has its ±.
    assert!(labels(&lab, "Uni+NEE MIS, 400 spp") >= 2);
    for s in &lab.state().wall().analysis().standings {
        let error = s.error("relmse").expect("an error");
        let text = majorant_core::compare::report::words::quantity(error.corrected(), error.uncertainty());
        assert!(text.contains('±') && labels(&lab, &text) >= 2, "{text}");
    }
    // An edit of the scene restarts the reference: its old image and its statistics disappear at once.
    edit(&mut lab, |doc| doc.medium_mut().scale = 1.5);
    lab.step();
    assert_current(lab.state());
    assert_eq!((labels(&lab, "relMSE "), labels(&lab, "400 spp")), (0, 0));
    watch(&mut lab, "a reference of at least three samples", |app| {
        let held = app.wall().analysis().standings.iter().any(|s| !s.errors.is_empty());
        let picture = app.wall().rendered_reference().and_then(|s| s.picture());
        held && picture.is_some_and(|p| p.spp >= LEAST_SAMPLES)
    });
}

#[test]
fn no_view_shares_random_numbers_with_the_reference() {
    let (mut lab, _directory) = pair();
    wall(&mut lab, WallEdit::Reference(rendered()));
    let seed = |lab: &Lab| {
        let slot = lab.state().wall().rendered_reference().expect("a reference");
        slot.rendered.render.seed
    };
    let first = seed(&lab);
    edit(&mut lab, |doc| (doc.render.seed, doc.compare.views[0].seed) = (first, first + 1));
    lab.step();
    assert!(![first, first + 1].contains(&seed(&lab)));
    watch(&mut lab, "errors", |app| {
        let standings = &app.wall().analysis().standings;
        standings.len() == 2 && standings.iter().all(|s| matches!(s.against, ComparedWith::Reference(_)))
    });
    // A view with the seed of the view that is the reference is not compared with it.
    edit(&mut lab, |doc| doc.compare.views[0].seed = first);
    wall(&mut lab, WallEdit::Reference(ReferenceDoc::View { view: 0 }));
    watch(&mut lab, "the refusal", |app| {
        let standing = app.wall().analysis().standing("B");
        standing
            .is_some_and(|s| matches!(s.against, ComparedWith::Nothing(why) if why.contains("another seed")))
    });
    assert!(lab.state().wall().analysis().standing("B").is_some_and(|s| s.errors.is_empty()));
}

#[test]
fn a_path_is_that_of_the_scene_as_it_is_now() {
    let (mut lab, _directory) = lab();
    wait(&mut lab, "finishing", finished);
    lab.state_mut().request(Command::ShowTab("path"));
    lab.state_mut().request(Command::Pick([16, 9]));
    let mut before = String::new();
    for scale in [1.0, 0.3, 2.0, 0.1] {
        edit(&mut lab, |doc| doc.medium_mut().scale = scale);
        // The path may be requested in every frame, including the first.
        lab.step();
        assert!(before.is_empty() || labels(&lab, &before) == 0, "the path of scale {scale} is another");
        wait(&mut lab, "the picture", finished);
        let samples = |app: &LabApp| app.wall().analysis().pixel.as_ref().map_or(0, |(_, v)| v.len());
        wait(&mut lab, "its samples", |app| samples(app) == 1);
        lab.run_steps(2);
        wait(&mut lab, "the path", |app| !app.inspector().path.query.is_running());
        lab.run_steps(2);
        let sample = lab.state().inspector().path.sample.expect("a sample");
        let probe = lab.state().wall().slots()[0].probe().expect("a scene");
        let [r, g, b] = probe.samples((16, 9), sample..sample + 1, CancelToken::NEVER)[0].rgb;
        before = format!("→  {r:.4} {g:.4} {b:.4}");
        assert_eq!(labels(&lab, &before), 1, "{before} is not the path that is shown");
    }
}

#[test]
fn all_four_limits_are_shown_and_edited() {
    let (mut lab, _directory) = lab();
    lab.get_by_label_contains("Stops at 4 spp.");
    open(&mut lab, "Limits, threads, seed");
    for (name, value) in [("Stop after", 60.0), ("CPU time", 30.0), ("Error", 0.25)] {
        click(&mut lab, Role::CheckBox, &format!("{name} on"));
        lab.get_by_role_and_label(Role::SpinButton, name).set_value_accesskit(value);
        lab.run_steps(3);
    }
    let limits = doc(&lab).render.limits();
    assert_eq!(
        (limits.spp, limits.seconds, limits.cpu_seconds, limits.relative_error),
        (Some(4), Some(60.0), Some(30.0), Some(0.25))
    );
    lab.get_by_label_contains("Stops at 4 spp, 60 s, 30 s of CPU time or an error of 25 %");
    lab.check_accessibility();
    // The relative error is the only limit, and ends the render.
    for name in ["Stop at", "Stop after", "CPU time"] {
        click(&mut lab, Role::CheckBox, &format!("{name} on"));
    }
    assert_eq!(doc(&lab).render.limits().relative_error, Some(0.25));
    assert_eq!((labels(&lab, "Stops at an error of 25 %"), labels(&lab, "Left: no limit")), (1, 0));
    wait(&mut lab, "the end", |app| app.state().status == Status::Finished);
    let error = lab.state().stats().relative_error.expect("an error");
    assert!(error <= 0.25, "{error}");
    assert_eq!(lab.state().stats().progress, Some(1.0));
    click(&mut lab, Role::CheckBox, "Error on");
    assert!(doc(&lab).render.limits().are_none());
    lab.get_by_label_contains("there is no limit");
    lab.get_by_label("Left: no limit");
}
