//! The window, driven through its accessibility tree: no display, no GPU. Every check looks at the
//! document or the session, not at labels alone.

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use majorant::lab::{LabApp, LabOptions};
use majorant::model::Source;
use majorant::panels::PANELS;
use majorant_core::estimator::REGISTRY;
use majorant_core::scene::{DensityDoc, SceneDoc};
use majorant_core::session::Status;
use majorant_core::spectrum::SpectrumDoc;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

type Lab = Harness<'static, LabApp>;

const SCENE: &str = r#"
majorant = 1
title = "Test"
film = { width = 32, height = 18 }
medium = { extinction = "430:8, 540:40, 572:8" }
lights = [{ kind = "environment" }]
render = { spp = 4 }
"#;

/// The window on a small scene in a file of its own.
fn lab() -> (Lab, tempfile::TempDir) {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("test.toml");
    std::fs::write(&path, SCENE).expect("a scene file");
    (lab_on(Source::File(path)), directory)
}

fn lab_on(source: Source) -> Lab {
    let options = LabOptions { open: Some(source), native_dialogs: false, ..LabOptions::default() };
    let mut lab = Harness::builder()
        // High enough that no panel has to be scrolled to.
        .with_size(vec2(1600.0, 3600.0))
        .with_step_dt(1.0 / 60.0)
        .build_eframe(move |cc| LabApp::new(cc, &options).expect("threads"));
    lab.run_steps(3);
    lab
}

/// Steps until something is true; the session works on threads of its own.
fn wait(lab: &mut Lab, what: &str, done: impl Fn(&LabApp) -> bool) {
    let deadline = Instant::now() + Duration::from_secs(20);
    while !done(lab.state()) {
        assert!(Instant::now() < deadline, "{what} did not happen; state: {:?}", lab.state().state());
        std::thread::sleep(Duration::from_millis(5));
        lab.step();
    }
}

fn click(lab: &mut Lab, role: Role, label: &str) {
    lab.get_by_role_and_label(role, label).click();
    lab.run_steps(3);
}

/// Opens a panel that starts closed.
fn open(lab: &mut Lab, title: &str) {
    let header = lab.get_by_role_and_label(Role::DisclosureTriangle, title);
    if header.accesskit_node().data().is_expanded() != Some(true) {
        click(lab, Role::DisclosureTriangle, title);
        // Opening is animated.
        lab.run_steps(12);
    }
}

fn drag(lab: &mut Lab, from: Pos2, to: Pos2, button: PointerButton, modifiers: Modifiers) {
    let press = |pos, pressed| Event::PointerButton { pos, button, pressed, modifiers };
    lab.event(Event::ModifiersChanged(modifiers));
    lab.event(Event::PointerMoved(from));
    lab.event(press(from, true));
    for i in 1..=8_u8 {
        lab.event(Event::PointerMoved(from + (to - from) * (f32::from(i) / 8.0)));
    }
    lab.event(press(to, false));
    lab.event(Event::ModifiersChanged(Modifiers::NONE));
    lab.run_steps(2);
}

fn undo(lab: &mut Lab) {
    lab.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    lab.run_steps(2);
}

fn redo(lab: &mut Lab) {
    lab.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    lab.run_steps(2);
}

fn doc(lab: &Lab) -> &SceneDoc {
    lab.state().doc()
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }
    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|e| e.to_string())
    }
}

fn drop_file(lab: &mut Lab, path: PathBuf) {
    lab.input_mut().dropped_files.push(Arc::new(Dropped(path)));
    lab.run_steps(2);
}

#[test]
fn every_panel_opens_and_names_its_widgets() {
    let (mut lab, _directory) = lab();
    for panel in PANELS {
        open(&mut lab, panel.title());
        lab.check_accessibility();
    }
    assert_eq!(*doc(&lab), *doc(&lab_on_default_equivalent()), "opening panels must not edit");
}

/// The same scene, untouched.
fn lab_on_default_equivalent() -> Lab {
    lab().0
}

#[test]
fn a_picture_comes_and_stops_at_the_limit() {
    let (mut lab, _directory) = lab();
    wait(&mut lab, "finishing", |app| app.state().status == Status::Finished);
    wait(&mut lab, "showing it", |app| app.shown().is_some_and(|s| s.spp == 4));
    let mean = lab.state().shown().expect("a picture").mean_colour();
    assert!(mean.iter().all(|c| *c > 0.01), "{mean:?}");
}

#[test]
fn the_estimator_is_switched_by_its_name() {
    let (mut lab, _directory) = lab();
    for entry in REGISTRY {
        let before = lab.state().state().generation;
        let was = doc(&lab).estimator.id.clone();
        click(&mut lab, Role::RadioButton, entry.name);
        assert_eq!(doc(&lab).estimator.id, entry.id);
        lab.step();
        assert_eq!(lab.state().state().generation > before, was != entry.id);
    }
}

#[test]
fn dragging_the_majorant_is_one_step_and_renders_again() {
    let (mut lab, _directory) = lab();
    let before = lab.state().state().generation;
    let at = lab.get_by_role_and_label(Role::SpinButton, "Majorant factor").rect().center();
    drag(&mut lab, at, at + vec2(60.0, 0.0), PointerButton::Primary, Modifiers::NONE);
    let dragged = doc(&lab).medium.majorant.factor;
    assert!(dragged > 1.2, "{dragged}");
    lab.step();
    assert!(lab.state().state().generation > before);
    undo(&mut lab);
    assert_eq!(doc(&lab).medium.majorant.factor, 1.0);
    assert!(!lab.state().is_modified());
    redo(&mut lab);
    assert_eq!(doc(&lab).medium.majorant.factor, dragged);
    click(&mut lab, Role::Button, "Reset Majorant factor");
    assert_eq!(doc(&lab).medium.majorant.factor, 1.0);
}

#[test]
fn numbers_are_typed_with_their_unit() {
    let (mut lab, _directory) = lab();
    open(&mut lab, "Camera");
    lab.get_by_role_and_label(Role::SpinButton, "Field of view").click();
    lab.run_steps(2);
    lab.get_by_label("Field of view").type_text("20 °");
    lab.key_press(Key::Enter);
    lab.run_steps(3);
    assert_eq!(doc(&lab).camera.fov_deg, 20.0);
}

#[test]
fn a_spectrum_point_is_dragged_added_and_removed() {
    let (mut lab, _directory) = lab();
    let points = |lab: &Lab| match &doc(lab).medium.extinction {
        SpectrumDoc::Points { points, .. } => points.clone(),
        other => panic!("{other:?}"),
    };
    let at = lab.get_by_label("Extinction point 2").rect().center();
    drag(&mut lab, at, at + vec2(0.0, 40.0), PointerButton::Primary, Modifiers::NONE);
    let dragged = points(&lab)[1];
    assert!(dragged.value < 30.0 && dragged.value > 0.0, "{dragged:?}");
    assert!((dragged.lambda_nm - 540.0).abs() <= 2.0, "{dragged:?}");
    undo(&mut lab);
    assert_eq!(points(&lab)[1].value, 40.0);

    lab.get_by_label("Extinction point 2").click_secondary();
    lab.run_steps(3);
    assert_eq!(points(&lab).len(), 2);
    let plot = lab.get_by_label("Extinction plot").rect();
    let free = plot.left_center() + vec2(0.8 * plot.width(), 0.0);
    for _ in 0..2 {
        lab.event(Event::PointerMoved(free));
        for pressed in [true, false] {
            let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
            lab.event(Event::PointerButton { pos: free, button, pressed, modifiers });
        }
    }
    lab.run_steps(3);
    assert_eq!(points(&lab).len(), 3);
    assert!(points(&lab)[2].lambda_nm > 700.0);
}

#[test]
fn lights_are_added_duplicated_and_removed() {
    let (mut lab, _directory) = lab();
    open(&mut lab, "Lights");
    click(&mut lab, Role::Button, "+  Add light");
    click(&mut lab, Role::Button, "Sphere");
    assert_eq!(doc(&lab).lights[1].kind_name(), "Sphere");
    lab.check_accessibility();
    click(&mut lab, Role::Button, "Duplicate light 2");
    assert_eq!(doc(&lab).lights.len(), 3);
    for _ in 0..3 {
        click(&mut lab, Role::Button, "Remove light 1");
    }
    assert!(doc(&lab).lights.is_empty());
    lab.get_by_label("No light: the image is black. Add one.");
    undo(&mut lab);
    assert!(!doc(&lab).lights.is_empty());
}

#[test]
fn rendering_pauses_steps_and_starts_over() {
    let (mut lab, _directory) = lab();
    open(&mut lab, "Limits, threads, seed");
    click(&mut lab, Role::CheckBox, "Stop at on");
    assert_eq!(doc(&lab).render.spp, None);
    wait(&mut lab, "rendering", |app| app.state().snapshot.as_ref().is_some_and(|s| s.spp > 4));
    click(&mut lab, Role::Button, "Pause");
    wait(&mut lab, "pausing", |app| app.state().status == Status::Paused);
    std::thread::sleep(Duration::from_millis(50));
    lab.run_steps(2);
    let spp = |app: &LabApp| app.state().snapshot.as_ref().map_or(0, |s| s.spp);
    let paused_at = spp(lab.state());
    click(&mut lab, Role::Button, "Step");
    wait(&mut lab, "stepping", |app| spp(app) > paused_at);
    std::thread::sleep(Duration::from_millis(50));
    lab.run_steps(2);
    assert_eq!(spp(lab.state()), paused_at + 1);
    let generation = lab.state().state().generation;
    click(&mut lab, Role::Button, "Restart");
    wait(&mut lab, "starting over", |app| app.state().generation > generation);
}

#[test]
fn raising_the_limit_keeps_the_samples() {
    let (mut lab, _directory) = lab();
    wait(&mut lab, "finishing", |app| app.state().status == Status::Finished);
    let generation = lab.state().state().generation;
    open(&mut lab, "Limits, threads, seed");
    lab.get_by_role_and_label(Role::SpinButton, "Stop at").set_value_accesskit(9.0);
    lab.run_steps(3);
    assert_eq!(doc(&lab).render.spp, Some(9));
    wait(&mut lab, "going on", |app| app.state().snapshot.as_ref().is_some_and(|s| s.spp == 9));
    assert_eq!(lab.state().state().generation, generation);
}

#[test]
fn display_settings_never_render_again() {
    let (mut lab, _directory) = lab();
    let generation = lab.state().state().generation;
    lab.key_press(Key::E);
    lab.run_steps(2);
    lab.key_press_modifiers(Modifiers::SHIFT, Key::E);
    lab.key_press_modifiers(Modifiers::SHIFT, Key::E);
    lab.run_steps(2);
    assert_eq!(doc(&lab).view.exposure_ev, -0.5);
    open(&mut lab, "Display");
    click(&mut lab, Role::Button, "Tone curve: Linear");
    assert_eq!(lab.state().state().generation, generation);
}

#[test]
fn the_camera_follows_the_mouse_as_one_step() {
    let (mut lab, _directory) = lab();
    let before = doc(&lab).camera.clone();
    let middle = lab.get_by_label("Rendered image").rect().center();
    drag(&mut lab, middle, middle + vec2(80.0, 20.0), PointerButton::Primary, Modifiers::NONE);
    let orbited = doc(&lab).camera.clone();
    assert!(orbited.origin != before.origin && orbited.target == before.target);
    drag(&mut lab, middle, middle + vec2(80.0, 0.0), PointerButton::Primary, Modifiers::SHIFT);
    assert!(doc(&lab).camera.target != before.target);
    undo(&mut lab);
    assert_eq!(doc(&lab).camera, orbited);
    undo(&mut lab);
    assert_eq!(doc(&lab).camera, before);
}

#[test]
fn an_embedded_scene_opens_from_the_menu() {
    let (mut lab, _directory) = lab();
    click(&mut lab, Role::Button, "File");
    click(&mut lab, Role::Button, "Embedded scenes");
    click(&mut lab, Role::Button, "furnace");
    let furnace = majorant_core::io::embedded::find("furnace").expect("an embedded scene");
    let expected = majorant_core::io::scene_file::parse(furnace.toml, "furnace").expect("it parses");
    assert_eq!(*doc(&lab), expected);
}

#[test]
fn unsaved_changes_are_asked_about() {
    let (mut lab, _directory) = lab();
    lab.key_press(Key::E);
    lab.run_steps(2);
    assert!(lab.state().is_modified());
    lab.key_press_modifiers(Modifiers::COMMAND, Key::N);
    lab.run_steps(3);
    assert_eq!(doc(&lab).title, "Test");
    click(&mut lab, Role::Button, "Cancel");
    assert_eq!(doc(&lab).title, "Test");
    lab.key_press_modifiers(Modifiers::COMMAND, Key::N);
    lab.run_steps(3);
    click(&mut lab, Role::Button, "Discard");
    assert_eq!(doc(&lab).title, SceneDoc::default().title);
}

#[test]
fn saving_first_goes_on_with_what_was_asked() {
    let (_, directory) = lab();
    let mut lab = lab_on(Source::Embedded("furnace".into()));
    lab.key_press(Key::E);
    lab.run_steps(2);
    lab.key_press_modifiers(Modifiers::COMMAND, Key::N);
    lab.run_steps(3);
    click(&mut lab, Role::Button, "Save");
    let path = directory.path().join("mine.toml");
    let field = lab.get_by_label("Path");
    field.set_text_value_accesskit(&path.to_string_lossy());
    lab.run_steps(3);
    click(&mut lab, Role::Button, "Save");
    assert!(path.exists());
    assert_eq!(doc(&lab).title, SceneDoc::default().title);
}

#[test]
fn a_scene_is_saved_and_loaded_again() {
    let (mut lab, directory) = lab();
    lab.get_by_role_and_label(Role::SpinButton, "Majorant factor").set_value_accesskit(3.0);
    lab.run_steps(3);
    lab.key_press_modifiers(Modifiers::COMMAND, Key::S);
    lab.run_steps(3);
    assert!(!lab.state().is_modified());
    let saved = majorant_core::io::scene_file::load(&directory.path().join("test.toml")).expect("it loads");
    assert_eq!(saved, *doc(&lab));
    assert_eq!(saved.medium.majorant.factor, 3.0);
}

#[test]
fn a_bad_dropped_file_is_explained_and_changes_nothing() {
    let (mut lab, directory) = lab();
    let before = doc(&lab).clone();
    for name in ["broken.vdb", "broken.toml", "letter.docx", "absent.vdb"] {
        let path = directory.path().join(name);
        if name != "absent.vdb" {
            std::fs::write(&path, "this is not what it says").expect("a file");
        }
        let lines = lab.state().messages().lines().len();
        drop_file(&mut lab, path);
        wait(&mut lab, name, |app| app.messages().lines().len() > lines);
        let line = lab.state().messages().lines().last().expect("a line").text.clone();
        assert!(line.contains(name), "{line}");
        assert_eq!(*doc(&lab), before);
    }
    lab.get_all_by_role_and_label(Role::Button, "Dismiss").next().expect("a button").click();
    lab.run_steps(3);
    assert_eq!(lab.state().messages().lines().len(), 3);
}

#[test]
fn a_dropped_volume_fills_the_medium() {
    let (mut lab, directory) = lab();
    let path = directory.path().join("plume.vdb");
    let bytes = majorant_core::io::embedded::volume("embedded:plume.vdb").expect("an embedded volume");
    std::fs::write(&path, bytes).expect("a file");
    drop_file(&mut lab, path);
    wait(&mut lab, "filling", |app| matches!(app.doc().medium.density, DensityDoc::Grid(_)));
    let grid = doc(&lab).medium.density.grid().expect("a grid").clone();
    assert_eq!(grid.file, "plume.vdb", "relative to the scene file");
    assert_eq!(doc(&lab).medium.placement.fit, Some(1.0));
    wait(&mut lab, "rendering it", |app| app.state().scene.as_ref().is_some_and(|s| s.grid_size.is_some()));
}

#[test]
fn a_scene_that_cannot_be_built_keeps_picture_and_edits() {
    let (mut lab, directory) = lab();
    wait(&mut lab, "a picture", |app| app.shown().is_some_and(|s| s.spp == 4));
    let sky = directory.path().join("sky.exr");
    std::fs::write(&sky, "not a picture").expect("a file");
    drop_file(&mut lab, sky);
    wait(&mut lab, "failing", |app| matches!(app.state().status, Status::Failed(_)));
    assert_eq!(doc(&lab).lights.len(), 2);
    assert!(lab.state().shown().is_some());
    undo(&mut lab);
    wait(&mut lab, "recovering", |app| app.state().status == Status::Finished);
}

#[test]
fn keys_and_gestures_are_listed() {
    let (mut lab, _directory) = lab();
    lab.key_press(Key::F1);
    lab.run_steps(3);
    lab.get_by_label("Orbit the camera");
    lab.check_accessibility();
    click(&mut lab, Role::Button, "Close");
    assert!(lab.query_by_label("Orbit the camera").is_none());
}

#[test]
fn a_frame_is_cheap_and_an_edit_never_waits() {
    let mut lab = lab_on(Source::first());
    for panel in PANELS {
        open(&mut lab, panel.title());
    }
    let mut seconds = Vec::new();
    for i in 0..60_u8 {
        // Every frame edits: the session builds and cancels all the time.
        lab.get_by_role_and_label(Role::SpinButton, "Majorant factor")
            .set_value_accesskit(1.0 + 0.05 * f64::from(i));
        lab.step();
        seconds.push(lab.state().ui_seconds());
    }
    seconds.sort_by(f32::total_cmp);
    let (median, worst) = (seconds[30], seconds[59]);
    assert!(median < 0.025, "a frame takes {median} s");
    assert!(worst < 0.25, "a frame waited {worst} s");
    wait(&mut lab, "a picture after the last edit", |app| {
        app.state().first_picture_seconds.is_some() && app.shown().is_some()
    });
}

#[test]
fn a_file_over_the_window_is_announced() {
    let (mut lab, _directory) = lab();
    for name in ["a.vdb", "a.toml", "a.exr", "a.txt"] {
        lab.input_mut()
            .hovered_files
            .push(egui::HoveredFile { path: Some(name.into()), mime: String::new() });
    }
    lab.run_steps(2);
    assert!(lab.state().messages().lines().is_empty());
}
