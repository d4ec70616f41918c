//! Comparison of views: clicks change the document, the session and the images shown.

use super::harness::{Lab, click, doc, drag, drop_file, lab, lab_on, undo, wait};
use egui::accesskit::Role;
use egui::{Key, Modifiers, PointerButton, vec2};
use egui_kittest::kittest::Queryable;
use majorant::model::Command;
use majorant::model::Source;
use majorant::model::WallEdit;
use majorant::model::{Arrangement, Pair, WindowDoc};
use majorant::view::tone_mapper::PictureId;
use majorant::wall::dock::TABS;
use majorant::wall::presets::PRESETS;
use majorant_core::compare::{ComparedWith, Verdict, maps};
use majorant_core::io::{Library, embedded, export, scene_file};
use majorant_core::scene::{Fairness, ReferenceDoc, SceneDoc};
use majorant_core::session::{Job, Role as ViewRole, Session, Status, ViewId};
use std::sync::Arc;

/// A tight majorant, one that is too low but weighted, and one that is clamped.
const BIASED: &str = r#"
majorant = 1
film = { width = 32, height = 18 }
medium = { extinction = 3.0, albedo = 0.9 }
lights = [{ kind = "environment" }]
render = { spp = 400 }
[[compare.views]]
seed = 1
majorant = { factor = 0.95 }
[[compare.views]]
seed = 2
majorant = { factor = 0.5, when_exceeded = "clamp" }
"#;

fn biased() -> (Lab, tempfile::TempDir) {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("biased.toml");
    std::fs::write(&path, BIASED).expect("a scene file");
    (lab_on(Source::File(path)), directory)
}

fn ids(lab: &Lab) -> Vec<String> {
    doc(lab).view_docs().iter().map(|d| d.estimator.id.clone()).collect()
}

fn finished(lab: &mut Lab) {
    wait(lab, "finishing", |app| app.wall().slots().iter().all(|s| s.state.status == Status::Finished));
}

#[test]
fn views_come_and_go_and_each_has_its_own_estimator() {
    let (mut lab, _directory) = lab();
    click(&mut lab, Role::Button, "3 views");
    assert_eq!(ids(&lab), ["uni-nee-mis", "independent", "spectral-mis"]);
    finished(&mut lab);
    lab.check_accessibility();
    // The method column edits only the clicked view.
    let at = lab.get_by_label("View C").rect().center();
    drag(&mut lab, at, at, PointerButton::Primary, Modifiers::NONE);
    lab.run_steps(2);
    assert_eq!(lab.state().wall().selected(), 2);
    let generations =
        |lab: &Lab| lab.state().wall().slots().iter().map(|s| s.state.generation).collect::<Vec<_>>();
    let before = generations(&lab);
    click(&mut lab, Role::RadioButton, "NEE");
    assert_eq!(ids(&lab), ["uni-nee-mis", "independent", "nee"]);
    lab.step();
    let after = generations(&lab);
    assert_eq!((before[0], before[1]), (after[0], after[1]), "the other views continue");
    assert!(after[2] > before[2]);
    click(&mut lab, Role::Button, "Menu of view A");
    click(&mut lab, Role::Button, "Remove");
    assert_eq!(ids(&lab), ["independent", "nee"]);
    lab.step();
    assert_eq!(generations(&lab), after[1..], "views that move up continue");
    undo(&mut lab);
    assert_eq!(ids(&lab), ["uni-nee-mis", "independent", "nee"]);
    click(&mut lab, Role::Button, "1 views");
    assert_eq!(ids(&lab), ["uni-nee-mis"]);
}

#[test]
fn keys_arrange_the_views() {
    let (mut lab, _directory) = lab();
    click(&mut lab, Role::Button, "2 views");
    let arrangement = |lab: &Lab| WindowDoc::of(doc(lab)).arrangement;
    let over = lab.get_by_label("View A").rect().center();
    lab.hover_at(over);
    for (key, expected) in [
        (Key::W, Arrangement::Wipe),
        (Key::W, Arrangement::Grid),
        (Key::D, Arrangement::Difference),
        (Key::Tab, Arrangement::Flip),
    ] {
        lab.key_press(key);
        lab.run_steps(2);
        assert_eq!(arrangement(&lab), expected);
    }
    // Tab selects the next view, which the method column edits.
    assert_eq!(lab.state().wall().selected(), 0);
    lab.key_press(Key::Tab);
    lab.run_steps(2);
    assert_eq!(lab.state().wall().selected(), 1);
    lab.get_by_label("View B");
    assert!(lab.query_by_label("View A").is_none(), "one at a time");
    lab.key_press(Key::G);
    lab.run_steps(2);
    assert_eq!(arrangement(&lab), Arrangement::Grid);
    // The divider of a wipe is dragged.
    lab.key_press(Key::W);
    lab.run_steps(2);
    let divider = lab.get_by_role_and_label(Role::Slider, "Divider").rect().center() + vec2(0.0, 40.0);
    drag(&mut lab, divider, divider + vec2(60.0, 0.0), PointerButton::Primary, Modifiers::NONE);
    assert!(lab.state().wall().split > 0.52);
    assert!(!lab.state().is_modified() || doc(&lab).view_count() == 2);
}

#[test]
fn every_map_is_drawn_for_every_view() {
    let (mut lab, _directory) = biased();
    wait(&mut lab, "samples", |app| app.wall().slots().iter().all(|s| s.stats.spp >= 4));
    let reference = ReferenceDoc::Render { estimator: "nee".into(), spp: Some(64), relative_error: None };
    lab.state_mut().request(Command::Wall(WallEdit::Reference(reference)));
    lab.run_steps(2);
    for map in maps::MAPS {
        click(&mut lab, Role::ComboBox, "Layer");
        click(&mut lab, Role::Button, map.name);
        wait(&mut lab, map.name, |app| {
            (0..3).all(|v| {
                let print = app.wall().uploaded(PictureId::View(v)).and_then(|h| h.map.as_ref());
                print.is_some_and(|p| p.map.id == map.id && p.values.len() == 32 * 18)
            })
        });
        lab.check_accessibility();
    }
    lab.key_press(Key::D);
    lab.run_steps(2);
    wait(&mut lab, "the difference", |app| {
        app.wall().uploaded(PictureId::Difference).is_some_and(|h| h.map.is_some())
    });
}

#[test]
fn a_clamped_majorant_is_found_and_the_unbiased_are_left_alone() {
    let (mut lab, _directory) = biased();
    finished(&mut lab);
    let verdicts = |app: &majorant::lab::LabApp| -> Vec<Verdict> {
        app.wall().analysis().standings.iter().map(|s| s.verdict()).collect()
    };
    wait(&mut lab, "the verdict", |app| {
        verdicts(app) == [Verdict::Agrees, Verdict::Agrees, Verdict::Differs]
    });
    let standings = lab.state().wall().analysis().standings.clone();
    assert_eq!(standings[2].against, ComparedWith::Others("A, B".into()));
    assert_eq!(standings[2].declared_bias, Some("the majorant is clamped"));
    lab.get_by_label_contains("biased: the majorant is clamped");
}

#[test]
fn a_box_is_drawn_and_cleared_and_numbers_are_about_it() {
    let (mut lab, _directory) = biased();
    let at = lab.get_by_label("View A").rect().center();
    drag(&mut lab, at, at + vec2(60.0, 40.0), PointerButton::Primary, Modifiers::COMMAND);
    let region = doc(&lab).compare.region.expect("a box");
    assert!(region[2] > region[0] + 1 && region[3] > region[1] + 1, "{region:?}");
    let pixels = u64::from((region[2] - region[0]) * (region[3] - region[1]));
    wait(&mut lab, "numbers about the box", |app| {
        app.wall().analysis().standings.iter().any(|s| s.pixels == pixels)
    });
    click(&mut lab, Role::Button, "Clear the box");
    assert_eq!(doc(&lab).compare.region, None);
    // With the box tool, a drag draws the box and does not move the camera.
    lab.key_press(Key::B);
    lab.run_steps(2);
    let camera = doc(&lab).camera.clone();
    drag(&mut lab, at, at + vec2(60.0, 40.0), PointerButton::Primary, Modifiers::NONE);
    assert!(doc(&lab).compare.region.is_some());
    assert_eq!(doc(&lab).camera, camera);
}

#[test]
fn every_tab_shows_its_numbers_and_copies_them() {
    let (mut lab, _directory) = biased();
    let at = lab.get_by_label("View A").rect().center();
    drag(&mut lab, at, at, PointerButton::Primary, Modifiers::NONE);
    lab.run_steps(2);
    finished(&mut lab);
    wait(&mut lab, "the pixel's samples", |app| {
        app.wall()
            .analysis()
            .pixel
            .as_ref()
            .is_some_and(|(_, v)| v.len() == 3 && v.iter().all(|s| s.samples.len() == 400))
    });
    // The mean of the retraced samples equals that of the image.
    let (pixel, samples) = lab.state().wall().analysis().pixel.clone().expect("samples");
    for view in &samples {
        let slot = &lab.state().wall().slots()[view.view];
        let snapshot = slot.state.snapshot.as_ref().expect("a picture");
        let mean = snapshot.mean[pixel[1] * snapshot.width + pixel[0]][0];
        let sum: f64 = view.samples.iter().map(|s| f64::from(s.rgb[0])).sum();
        assert!((sum / 400.0 - f64::from(mean)).abs() < 1e-5 * f64::from(mean), "{sum} {mean}");
    }
    for tab in TABS {
        click(&mut lab, Role::Button, tab.title());
        lab.run_steps(3);
        lab.check_accessibility();
        click(&mut lab, Role::Button, "Copy as CSV");
    }
    lab.get_by_label_contains("A and B agree");
}

#[test]
fn a_reference_is_rendered_beside_the_views_and_carries_its_noise() {
    let (mut lab, _directory) = biased();
    click(&mut lab, Role::Button, "Reference");
    click(&mut lab, Role::RadioButton, "Rendered in the background");
    assert!(matches!(doc(&lab).compare.reference, ReferenceDoc::Render { .. }));
    lab.key_press(Key::Escape);
    wait(&mut lab, "errors", |app| {
        app.wall()
            .analysis()
            .standings
            .iter()
            .any(|s| matches!(s.against, ComparedWith::Reference(_)) && s.error("relmse").is_some())
    });
    wait(&mut lab, "the reference", |app| app.wall().uploaded(PictureId::Reference).is_some());
}

/// Renders a scene and writes the image to a file.
fn rendered(doc: &SceneDoc, path: &std::path::Path) {
    let (wake, woken) = std::sync::mpsc::channel();
    let session = Session::new(Library::default(), move || wake.send(()).unwrap_or(())).expect("threads");
    let job = Job { doc: Arc::new(doc.clone()), preview: false, role: ViewRole::View };
    session.submit(ViewId(1), job);
    while session.state(ViewId(1)).status != Status::Finished {
        woken.recv().expect("a session that lives");
    }
    let snapshot = session.state(ViewId(1)).snapshot.expect("a picture");
    export::write_exr(path, &snapshot, doc).expect("a picture");
}

#[test]
fn a_dropped_render_is_the_reference_until_the_scene_changes() {
    let (mut lab, directory) = biased();
    let path = directory.path().join("reference.exr");
    let mut scene = doc(&lab).view_doc(0).expect("view A");
    (scene.render.seed, scene.render.spp) = (77, Some(64));
    rendered(&scene, &path);
    drop_file(&mut lab, path);
    assert_eq!(doc(&lab).compare.reference, ReferenceDoc::File { file: "reference.exr".into() });
    wait(&mut lab, "errors", |app| {
        app.wall().analysis().standings.iter().any(|s| matches!(s.against, ComparedWith::Reference(_)))
    });
    assert_eq!(lab.state().wall().reference_state().problem, None);
    // The scene has changed: the file must not be used.
    let mut edited = doc(&lab).clone();
    edited.medium_mut().scale = 2.0;
    lab.state_mut().request(Command::Edit(Box::new(edited)));
    wait(&mut lab, "being stale", |app| app.wall().reference_state().problem.is_some());
    wait(&mut lab, "new numbers", |app| {
        let standings = &app.wall().analysis().standings;
        standings.len() == 3
            && standings.iter().all(|s| matches!(s.against, ComparedWith::Nothing(_)) && s.errors.is_empty())
    });
}

#[test]
fn the_comparison_is_saved_with_the_scene() {
    let (mut lab, directory) = biased();
    lab.key_press(Key::W);
    lab.run_steps(2);
    click(&mut lab, Role::ComboBox, "Fairness");
    click(&mut lab, Role::Button, "Equal samples");
    lab.key_press_modifiers(Modifiers::COMMAND, Key::S);
    lab.run_steps(3);
    let read = scene_file::load(&directory.path().join("biased.toml")).expect("a scene");
    assert_eq!(read, *doc(&lab));
    let (compare, window) = (&read.compare, WindowDoc::of(&read));
    assert_eq!(
        (window.arrangement, compare.fairness, window.pair),
        (Arrangement::Wipe, Fairness::Samples, Pair(0, 1))
    );
}

#[test]
fn a_report_is_written_from_the_window() {
    let (mut lab, directory) = biased();
    finished(&mut lab);
    let folder = directory.path().join("report");
    lab.state_mut().request(Command::Chosen(majorant::model::Purpose::ExportReport, folder.clone()));
    let page = folder.join("index.html");
    wait(&mut lab, "the page", |app| app.messages().lines().iter().any(|l| l.text.starts_with("Wrote")));
    let text = std::fs::read_to_string(page).expect("a page");
    assert!(text.contains("the majorant is clamped"));
    assert!(folder.join("compare.exr").exists() && folder.join("ranking.csv").exists());
    // A folder that cannot be created only causes a message.
    let blocked = directory.path().join("biased.toml").join("report");
    lab.state_mut().request(Command::Chosen(majorant::model::Purpose::ExportReport, blocked));
    wait(&mut lab, "the refusal", |app| {
        app.messages().lines().iter().any(|l| l.text.contains("biased.toml"))
    });
}

#[test]
fn presets_are_two_clicks_away() {
    for preset in PRESETS {
        let first = embedded::SCENES[0].name.to_owned();
        let mut lab = lab_on(Source::Embedded(first));
        click(&mut lab, Role::Button, "Compare");
        click(&mut lab, Role::Button, preset.name);
        assert_eq!(*doc(&lab), preset.doc().expect("a scene"), "{}", preset.name);
        let views = doc(&lab).view_count();
        assert_eq!(lab.state().wall().slots().len(), views);
    }
}
