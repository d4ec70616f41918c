//! Files in the window: opening, saving, dropping, and errors.

use super::harness::{click, doc, drop_file, lab, lab_on, open, undo, wait};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use majorant::lab::LabApp;
use majorant::model::Source;
use majorant_core::scene::{DensityDoc, LightDoc, SceneDoc};
use majorant_core::session::Status;
use majorant_tests::volumes::write::{TinyGrid, vdb};

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
    assert_eq!(saved.medium().majorant.factor, 3.0);
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
    wait(&mut lab, "filling", |app| matches!(app.doc().medium().density, DensityDoc::Grid(_)));
    let grid = doc(&lab).medium().density.grid().expect("a grid").clone();
    assert_eq!(grid.file, "plume.vdb", "relative to the scene file");
    assert_eq!(doc(&lab).medium().placement.fit, Some(1.0));
    wait(&mut lab, "rendering it", |app| {
        app.state().scene.as_ref().is_some_and(|s| s.medium(0).is_some_and(|m| m.grid_size.is_some()))
    });
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

#[test]
fn a_scene_that_cannot_be_saved_stays_unsaved() {
    let (mut lab, directory) = lab();
    lab.key_press(Key::E);
    lab.run_steps(2);
    lab.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    lab.run_steps(3);
    let path = directory.path().join("absent/mine.toml");
    lab.get_by_label("Path").set_text_value_accesskit(&path.to_string_lossy());
    lab.run_steps(3);
    click(&mut lab, Role::Button, "Save");
    let line = lab.state().messages().lines().last().expect("a line").text.clone();
    assert!(line.contains("not saved") && line.contains("mine.toml"), "{line}");
    assert!(lab.state().is_modified());
}

#[test]
fn a_new_environment_map_asks_for_its_picture() {
    let (mut lab, directory) = lab();
    open(&mut lab, "Lights");
    click(&mut lab, Role::Button, "+  Add light");
    click(&mut lab, Role::Button, "Environment map");
    let path = directory.path().join("sky.exr");
    lab.get_by_label("Path").set_text_value_accesskit(&path.to_string_lossy());
    lab.run_steps(3);
    click(&mut lab, Role::Button, "Open");
    let LightDoc::EnvironmentMap { file, .. } = &doc(&lab).lights[1] else {
        panic!("{:?}", doc(&lab).lights)
    };
    assert_eq!(file, "sky.exr");
}

#[test]
fn the_grid_that_was_chosen_is_told() {
    let (mut lab, directory) = lab();
    let grid = |name| TinyGrid { name, ..TinyGrid::default() };
    let path = directory.path().join("smoke.vdb");
    std::fs::write(&path, vdb(224, false, &[grid("temperature"), grid("Density")])).expect("a file");
    drop_file(&mut lab, path);
    wait(&mut lab, "the notice", |app| !app.state().notices.is_empty());
    let notice = lab.state().state().notices[0].clone();
    assert!(notice.contains("\"Density\" is read as the density"), "{notice}");
    wait(&mut lab, "rendering it", |app| app.state().status == Status::Finished);
    lab.run_steps(3);
    assert!(lab.query_by_label_contains("\"Density\" is read as the density").is_some());
    open(&mut lab, "Density");
    lab.run_steps(6);
    assert!(lab.query_by_value("by default: Density").is_some());

    // A file without a density is refused, and nothing changes.
    let before = doc(&lab).clone();
    let path = directory.path().join("hot.vdb");
    std::fs::write(&path, vdb(224, false, &[grid("temperature")])).expect("a file");
    drop_file(&mut lab, path);
    let refusal = |app: &LabApp| {
        let lines = app.messages().lines().iter();
        lines.map(|line| line.text.clone()).find(|text| text.contains("hot.vdb"))
    };
    wait(&mut lab, "hot.vdb", |app| refusal(app).is_some());
    let line = refusal(lab.state()).expect("it was waited for");
    assert!(line.contains("medium.density.grid") && line.contains("\"temperature\""), "{line}");
    assert_eq!(*doc(&lab), before);
}
