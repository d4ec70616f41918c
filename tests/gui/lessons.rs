//! Lessons, from the first step to the last by keyboard.

use super::harness::{Lab, doc, lab, wait};
use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};
use majorant::lessons::embedded;
use majorant::model::Command;

/// Moves the focus with Tab from the first answer to the one with a label, and chooses it with Space.
fn choose(lab: &mut Lab, label: &str) {
    for _ in 0..6 {
        if lab.get_by_role_and_label(Role::RadioButton, label).accesskit_node().is_focused() {
            lab.key_press(Key::Space);
            lab.run_steps(2);
            return;
        }
        lab.key_press(Key::Tab);
        lab.run_steps(2);
    }
    panic!("{label} cannot be reached by the keyboard");
}

#[test]
fn every_lesson_is_played_through_by_keyboard() {
    let (mut lab, _directory) = lab();
    for lesson in embedded() {
        lab.state_mut().request(Command::OpenLesson(lesson.id.clone()));
        lab.run_steps(3);
        for (i, step) in lesson.steps.iter().enumerate() {
            let what = format!("{}, step {}", lesson.id, i + 1);
            let player = lab.state().lesson().unwrap_or_else(|| panic!("{what} is not open"));
            assert_eq!((player.lesson.id.as_str(), player.step), (lesson.id.as_str(), i), "{what}");
            assert_eq!(*doc(&lab), lesson.scene_at(i).expect("a scene"), "{what}");
            assert!(!lab.state().is_modified(), "{what}: a lesson makes no unsaved change");
            lab.check_accessibility();
            if let Some(right) = step.stop.choices.get(step.stop.right) {
                lab.key_press(Key::PageDown);
                lab.run_steps(2);
                assert_eq!(lab.state().lesson().map(|p| p.step), Some(i), "{what}: predict first");
                choose(&mut lab, right);
                assert!(lab.query_by_label_contains("Correct. The next step shows it.").is_some(), "{what}");
            }
            lab.key_press(Key::PageDown);
            lab.run_steps(3);
        }
        assert!(lab.state().lesson().is_none(), "{} is finished", lesson.id);
    }
}

#[test]
fn equations_are_set_and_have_their_tex_as_accessible_name() {
    let (mut lab, _directory) = lab();
    lab.state_mut().request(Command::OpenLesson(embedded()[1].id.clone()));
    lab.run_steps(3);
    let shown = |tex: &str| lab.query_all_by_role_and_label(Role::Image, tex).count();
    assert!(shown(r"\bar\mu") >= 2, "inline equations");
    assert_eq!(
        lab.query_all_by_role(Role::Image)
            .filter(|node| node.accesskit_node().label().is_some_and(|tex| tex.starts_with(r"t = -\frac")))
            .count(),
        1,
        "one display equation"
    );
}

#[test]
fn a_narrow_window_has_room_for_the_lesson_and_the_pictures() {
    let (mut lab, _directory) = lab();
    lab.set_size(egui::vec2(1280.0, 720.0));
    lab.run_steps(2);
    let method = |lab: &Lab| lab.query_by_label("how it is estimated").is_some();
    assert!(method(&lab));
    lab.state_mut().request(Command::OpenLesson(embedded()[0].id.clone()));
    lab.run_steps(3);
    assert!(!method(&lab));
    lab.key_press(Key::F3);
    lab.run_steps(2);
    assert!(method(&lab));
    lab.state_mut().request(Command::CloseLesson);
    lab.run_steps(2);
    assert!(method(&lab));
}

#[test]
fn numbers_in_a_lesson_are_those_of_the_lab() {
    let (mut lab, _directory) = lab();
    lab.state_mut().request(Command::OpenLesson(embedded()[0].id.clone()));
    lab.run_steps(3);
    lab.state_mut().request(Command::AnswerLesson(2));
    lab.state_mut().request(Command::StepLesson(1));
    lab.run_steps(3);
    wait(&mut lab, "the ray", |app| {
        let bench = app.inspector().ray.query.newest();
        bench.is_some_and(|bench| (bench.truth() - (-2.0f64).exp()).abs() < 1e-6)
    });
    lab.run_steps(3);
    let truth = format!("ends at {:.4}", (-2.0f64).exp());
    assert!(lab.query_by_label_contains(&truth).is_some(), "{truth}");
    lab.state_mut().request(Command::CloseLesson);
    lab.run_steps(2);
    assert!(lab.state().lesson().is_none());
}
