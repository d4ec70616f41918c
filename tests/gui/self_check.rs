//! The dialog *Help ▸ Self-check*.

use super::harness::{Lab, click, doc, lab, lab_on, wait};
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;
use majorant::lab::self_check::Ending;
use majorant::model::Command;
use majorant::model::Source;
use majorant_core::check::Verdict;
use majorant_core::estimator::REGISTRY;

fn opened(lab: &mut Lab) {
    click(lab, Role::Button, "Help");
    click(lab, Role::Button, "Self-check…");
    assert!(lab.state().self_check().open);
}

#[test]
fn this_scene_is_checked_estimator_against_estimator() {
    let (mut lab, _directory) = lab();
    opened(&mut lab);
    lab.get_by_label("half-space");
    lab.check_accessibility();
    click(&mut lab, Role::Button, "What to check: This scene");
    lab.get_by_label_contains("pair by pair");
    click(&mut lab, Role::Button, "Run");
    wait(&mut lab, "the check", |app| app.self_check().ending().is_some());
    let check = lab.state().self_check();
    assert!(matches!(check.ending(), Some(Ending::Finished(_))), "{:?}", check.ending());
    // Mitsuba 2's volpath has infinite variance in a homogeneous medium of this colour.
    let all = REGISTRY.len() - 1;
    assert_eq!(check.rows().len(), all);
    assert!(check.rows().iter().all(|row| row.verdict == Verdict::Agrees), "{:?}", check.rows());
    lab.run_steps(2);
    lab.get_by_label_contains(&format!("{all} of {all} agree"));
    lab.check_accessibility();
    click(&mut lab, Role::Button, "Close");
    assert!(!lab.state().self_check().open);
    // The results are kept when the dialog is opened again, and cleared when the scene has changed.
    opened(&mut lab);
    assert_eq!(lab.state().self_check().rows().len(), all);
    click(&mut lab, Role::Button, "Close");
    let mut edited = doc(&lab).clone();
    edited.medium_mut().scale = 2.0;
    lab.state_mut().request(Command::Edit(Box::new(edited)));
    lab.run_steps(2);
    opened(&mut lab);
    assert!(lab.state().self_check().rows().is_empty() && lab.state().self_check().ending().is_none());
}

#[test]
fn closing_cancels() {
    let (mut lab, _directory) = lab();
    opened(&mut lab);
    click(&mut lab, Role::Button, "Effort: Deep");
    click(&mut lab, Role::Button, "Run");
    wait(&mut lab, "the first rows", |app| !app.self_check().rows().is_empty());
    assert!(lab.state().self_check().is_running());
    click(&mut lab, Role::Button, "Close");
    let check = lab.state().self_check();
    assert!(!check.is_running() && check.ending() == Some(&Ending::Cancelled));
}

#[test]
fn what_is_biased_by_choice_is_not_compared() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("clamped.toml");
    let text = "majorant = 1\nfilm = { width = 8, height = 8 }\n[medium]\ndensity = { kind = \"grid\", file = \"embedded:cloud.vdb\" }\n[medium.majorant]\nfactor = 0.5\nwhen_exceeded = \"clamp\"";
    std::fs::write(&path, text).expect("a scene file");
    let mut lab = lab_on(Source::File(path));
    opened(&mut lab);
    click(&mut lab, Role::Button, "What to check: This scene");
    lab.get_by_label_contains("biased by choice: the majorant is clamped");
    click(&mut lab, Role::Button, "Run");
    wait(&mut lab, "the check", |app| app.self_check().ending().is_some());
    assert!(lab.state().self_check().rows().is_empty());
    lab.run_steps(2);
    lab.get_by_label_contains("no estimator is unbiased for it: the majorant is clamped");
}
