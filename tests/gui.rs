//! Tests of the window through its accessibility tree, without display and GPU. Checks inspect the document
//! or the session, not only labels.

#[path = "gui/files.rs"]
mod files;
#[path = "gui/harness.rs"]
mod harness;
#[path = "gui/inspect.rs"]
mod inspect;
#[path = "gui/laboratory.rs"]
mod laboratory;
#[path = "gui/lessons.rs"]
mod lessons;
#[path = "gui/media.rs"]
mod media;
#[path = "gui/objects.rs"]
mod objects;
#[path = "gui/provenance.rs"]
mod provenance;
#[path = "gui/self_check.rs"]
mod self_check;
#[path = "gui/speed.rs"]
mod speed;
#[path = "gui/wall.rs"]
mod wall;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, vec2};
use egui_kittest::kittest::Queryable;
use harness::{Lab, click, doc, drag, lab, lab_on, open, redo, undo, wait};
use majorant::lab::LabApp;
use majorant::model::Source;
use majorant::panels::PANELS;
use majorant_core::estimator::REGISTRY;
use majorant_core::scene::{Angle, CoefficientsDoc, PhaseDoc};
use majorant_core::session::Status;
use majorant_core::spectrum::SpectrumDoc;
use std::time::Duration;

#[test]
fn every_panel_opens_and_names_its_widgets() {
    let (mut lab, _directory) = lab();
    for panel in PANELS {
        open(&mut lab, panel.title());
        lab.check_accessibility();
    }
    assert_eq!(*doc(&lab), *doc(&lab_on_default_equivalent()), "opening panels must not edit the scene");
}

/// The same scene, unedited.
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
    let dragged = doc(&lab).medium().majorant.factor;
    assert!(dragged > 1.2, "{dragged}");
    lab.step();
    assert!(lab.state().state().generation > before);
    undo(&mut lab);
    assert_eq!(doc(&lab).medium().majorant.factor, 1.0);
    assert!(!lab.state().is_modified());
    redo(&mut lab);
    assert_eq!(doc(&lab).medium().majorant.factor, dragged);
    click(&mut lab, Role::Button, "Reset Majorant factor");
    assert_eq!(doc(&lab).medium().majorant.factor, 1.0);
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
    let points = |lab: &Lab| match &doc(lab).medium().extinction {
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
fn every_phase_function_is_picked_and_edited() {
    let (mut lab, _directory) = lab();
    open(&mut lab, "Phase function");
    for template in PhaseDoc::templates() {
        let label = format!("Phase function: {}", template.kind().short);
        click(&mut lab, Role::Button, &label);
        assert_eq!(doc(&lab).medium().phase, template);
        lab.check_accessibility();
        for (index, (parameter, value)) in template.parameters().into_iter().enumerate() {
            let name = format!("Phase {}", parameter.label);
            let to = 0.5 * (value + parameter.range[1]);
            lab.get_by_role_and_label(Role::SpinButton, &name).set_value_accesskit(f64::from(to));
            lab.run_steps(3);
            let now = doc(&lab).medium().phase.parameters()[index].1;
            assert!((now - to).abs() < 1e-3 * to.abs(), "{name}: {now} instead of {to}");
        }
    }
    // The last template is the table.
    click(&mut lab, Role::Button, "First column: cos θ");
    let PhaseDoc::Tabulated { angle: Angle::Cosine, points, .. } = &doc(&lab).medium().phase else {
        panic!("{:?}", doc(&lab).medium().phase)
    };
    assert_eq!(points.last(), Some(&[1.0, 20.0]));
}

#[test]
fn coefficients_given_another_way_are_the_same_medium() {
    let (mut lab, _directory) = lab();
    let before = doc(&lab).medium().clone();
    click(&mut lab, Role::Button, "Coefficients: σa, σs");
    let sums = doc(&lab).medium().coefficients.clone();
    assert!(matches!(sums, Some(CoefficientsDoc::AbsorptionScattering { .. })), "{sums:?}");
    lab.check_accessibility();
    click(&mut lab, Role::Button, "Coefficients: Path, colour");
    let paths = doc(&lab).medium().coefficients.clone();
    assert!(matches!(paths, Some(CoefficientsDoc::MeanFreePathColour { .. })), "{paths:?}");
    lab.check_accessibility();
    let [(t0, a0), (t, a)] = [&before, doc(&lab).medium()].map(|m| m.extinction_and_albedo(0.0));
    for lambda in [430.0, 540.0, 572.0] {
        assert!((t.at(lambda) / t0.at(lambda) - 1.0).abs() < 1e-4, "{lambda}");
        assert!((a.at(lambda) - a0.at(lambda)).abs() < 1e-4, "{lambda}");
    }
    undo(&mut lab);
    undo(&mut lab);
    assert_eq!(doc(&lab).medium(), &before);
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
        // An edit in every frame: the session builds and cancels continuously.
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
fn estimators_stay_where_they_are_while_one_compares_them() {
    let (mut lab, _directory) = lab();
    let place = |lab: &Lab, name: &str| lab.get_by_role_and_label(Role::RadioButton, name).rect();
    let before: Vec<_> = REGISTRY.iter().map(|entry| place(&lab, entry.name)).collect();
    for chosen in REGISTRY {
        click(&mut lab, Role::RadioButton, chosen.name);
        let now: Vec<_> = REGISTRY.iter().map(|entry| place(&lab, entry.name)).collect();
        assert_eq!(now, before, "after choosing {}", chosen.name);
    }
}

#[test]
fn long_numbers_neither_widen_a_column_nor_lose_digits() {
    let (lab, directory) = lab();
    let canvas = lab.get_by_label("Rendered image").rect();
    let mut long = doc(&lab).clone();
    long.camera.origin = [-0.546_713_23, -1.234_567e-6, 123.456_78];
    let path = directory.path().join("long.toml");
    majorant_core::io::scene_file::save(&path, &long).expect("it is written");
    let mut lab = lab_on(Source::File(path));
    open(&mut lab, "Camera");
    assert_eq!(lab.get_by_label("Rendered image").rect(), canvas);
    for axis in ["x", "y", "z"] {
        lab.get_by_role_and_label(Role::SpinButton, &format!("Camera origin {axis}")).click();
        lab.run_steps(2);
        lab.key_press(Key::Enter);
        lab.run_steps(3);
    }
    assert_eq!(doc(&lab).camera, long.camera, "focusing a number must not round it");
}
