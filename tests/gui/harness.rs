//! The window without a display, and helpers for its tests.

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use majorant::lab::{LabApp, LabOptions};
use majorant::model::Source;
use majorant_core::scene::SceneDoc;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

pub type Lab = Harness<'static, LabApp>;

const SCENE: &str = r#"
majorant = 1
title = "Test"
film = { width = 32, height = 18 }
medium = { extinction = "430:8, 540:40, 572:8" }
lights = [{ kind = "environment" }]
render = { spp = 4 }
"#;

/// Opens the window with a small scene in a temporary file.
pub fn lab() -> (Lab, tempfile::TempDir) {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("test.toml");
    std::fs::write(&path, SCENE).expect("a scene file");
    (lab_on(Source::File(path)), directory)
}

pub fn lab_on(source: Source) -> Lab {
    let options = LabOptions { open: Some(source), native_dialogs: false, ..LabOptions::default() };
    let mut lab = Harness::builder()
        // High enough to show all panels without scrolling.
        .with_size(vec2(1600.0, 3600.0))
        .with_step_dt(1.0 / 60.0)
        .build_eframe(move |cc| LabApp::new(cc, &options).expect("threads"));
    lab.run_steps(3);
    lab
}

/// Time limit for waiting, long enough when many tests share two slow cores.
const PATIENCE: Duration = Duration::from_secs(120);

/// Steps until a condition holds; the session works on other threads.
pub fn wait(lab: &mut Lab, what: &str, done: impl Fn(&LabApp) -> bool) {
    let deadline = Instant::now() + PATIENCE;
    while !done(lab.state()) {
        assert!(Instant::now() < deadline, "{what} did not happen; {:?}", lab.state().state().status);
        std::thread::sleep(Duration::from_millis(5));
        lab.step();
    }
}

pub fn click(lab: &mut Lab, role: Role, label: &str) {
    lab.get_by_role_and_label(role, label).click();
    lab.run_steps(3);
}

/// Opens a panel if it is closed.
pub fn open(lab: &mut Lab, title: &str) {
    let header = lab.get_by_role_and_label(Role::DisclosureTriangle, title);
    if header.accesskit_node().data().is_expanded() != Some(true) {
        click(lab, Role::DisclosureTriangle, title);
        // The opening is animated.
        lab.run_steps(12);
    }
}

pub fn drag(lab: &mut Lab, from: Pos2, to: Pos2, button: PointerButton, modifiers: Modifiers) {
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

pub fn undo(lab: &mut Lab) {
    lab.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    lab.run_steps(2);
}

pub fn redo(lab: &mut Lab) {
    lab.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    lab.run_steps(2);
}

pub fn doc(lab: &Lab) -> &SceneDoc {
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

pub fn drop_file(lab: &mut Lab, path: PathBuf) {
    lab.input_mut().dropped_files.push(Arc::new(Dropped(path)));
    lab.run_steps(2);
}
