//! Tabs for paths, rays, contributions and noise, compared with direct computations.

use super::harness::{Lab, click, doc, lab, open, wait};
use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;
use majorant::lab::LabApp;
use majorant::model::Command;
use majorant::wall::dock::TABS;
use majorant_core::compare::Verdict;
use majorant_core::scene::{Absorption, Fault};
use majorant_core::session::Status;

/// Opens a finished image with a picked pixel and a tab.
fn picked(tab: &'static str) -> (Lab, tempfile::TempDir) {
    let (mut lab, directory) = lab();
    wait(&mut lab, "finishing", |app| app.state().status == Status::Finished);
    lab.state_mut().request(Command::ShowTab(tab));
    lab.state_mut().request(Command::Pick([16, 9]));
    lab.run_steps(4);
    (lab, directory)
}

fn replayed(lab: &mut Lab, what: &str) {
    lab.run_steps(2);
    wait(lab, what, |app: &LabApp| !app.inspector().path.query.is_running());
    lab.run_steps(3);
}

#[test]
fn a_pixels_paths_are_listed_replayed_and_stepped_through() {
    let (mut lab, _directory) = picked("path");
    wait(&mut lab, "the samples", |app| app.inspector().path.sample.is_some());
    replayed(&mut lab, "the path");
    lab.check_accessibility();
    // The brightest of four samples is chosen.
    let probe = lab.state().state().probe.clone().expect("a probe");
    let samples = probe.samples((16, 9), 0..4, majorant_core::transport::CancelToken::NEVER);
    let grey = |i: u64| samples[i as usize].rgb.iter().sum::<f32>();
    let chosen = lab.state().inspector().path.sample.expect("a sample");
    assert!((0..4).all(|i| grey(i) <= grey(chosen)), "{chosen} of {samples:?}");
    click(&mut lab, Role::Button, "Next event");
    assert_eq!(lab.state().inspector().path.step, 1);
    // The path weights of the selected event are shown for every component.
    for name in ["f", "p uni", "p nee", "majorant"] {
        assert!(lab.query_all_by_label(name).next().is_some(), "{name}");
    }
    // The keys step through the events and have no other effect.
    for (key, step) in [(Key::CloseBracket, 2), (Key::CloseBracket, 3), (Key::OpenBracket, 2)] {
        lab.key_press(key);
        lab.run_steps(2);
        assert_eq!(lab.state().inspector().path.step, step);
        assert!(lab.query_by_label("Scene").is_some() && lab.query_by_label("Method").is_some());
    }
    lab.key_press(Key::OpenBracket);
    lab.run_steps(2);
    click(&mut lab, Role::Button, "Previous event");
    assert_eq!(lab.state().inspector().path.step, 0);
    // Another sample, and another pixel.
    let other = (0..4).find(|i| *i != chosen).expect("four");
    click(&mut lab, Role::Button, &format!("Sample {other}"));
    assert_eq!(lab.state().inspector().path.sample, Some(other));
    replayed(&mut lab, "the other path");
    lab.state_mut().request(Command::Pick([3, 3]));
    lab.run_steps(3);
    wait(&mut lab, "the other pixel", |app| app.inspector().path.pixel == Some([3, 3]));
}

#[test]
fn an_outlier_is_found_when_nothing_is_picked() {
    let (mut lab, _directory) = lab();
    wait(&mut lab, "finishing", |app| app.state().status == Status::Finished);
    lab.key_press(Key::I);
    lab.run_steps(4);
    click(&mut lab, Role::Button, "Take the brightest outlier");
    assert!(lab.state().wall().picked.is_some());
}

#[test]
fn a_ray_is_measured_through_the_medium_and_through_shapes() {
    let (mut lab, _directory) = picked("ray");
    let measured = |lab: &mut Lab| {
        lab.run_steps(2);
        wait(lab, "the ray", |app| !app.inspector().ray.query.is_running());
        lab.run_steps(3);
        assert!(lab.query_by_label_contains("look-ups each").is_some());
    };
    measured(&mut lab);
    lab.check_accessibility();
    for shape in ["constant", "ramp", "gaussian", "cosine", "hole"] {
        click(&mut lab, Role::Button, &format!("Through {shape}"));
        measured(&mut lab);
    }
    let truth = majorant_core::transmittance::Shape::Hole.integral(1.0);
    let text = format!("T = {:.5}", (-3.0 * truth).exp());
    assert!(lab.query_by_label_contains(&text).is_some(), "{text}");
    click(&mut lab, Role::Button, "Another");
    measured(&mut lab);
}

#[test]
fn an_image_is_split_into_contributions_in_every_way() {
    let (mut lab, _directory) = picked("parts");
    for split in ["technique", "scattering order", "null collisions", "hero"] {
        click(&mut lab, Role::Button, &format!("By {split}"));
        lab.run_steps(2);
        wait(&mut lab, "the contributions", |app| !app.inspector().parts.query.is_running());
        lab.run_steps(3);
        let parts = lab.state().inspector().parts.hung_of.clone().expect("contributions");
        assert_eq!(parts.split.name(), split);
        assert!(!parts.layers.is_empty());
        lab.check_accessibility();
    }
    click(&mut lab, Role::Button, "Contributions as weights");
    assert!(lab.state().inspector().parts.hung_as_shares);
    click(&mut lab, Role::Button, "Play");
    assert!(lab.state().inspector().parts.playing.is_some());
}

#[test]
fn noise_is_analysed_and_a_suggestion_adds_a_view() {
    let (mut lab, _directory) = picked("noise");
    click(&mut lab, Role::Button, "Absorption: Analogue");
    wait(&mut lab, "the new picture", |app| app.state().status == Status::Finished);
    lab.run_steps(2);
    wait(&mut lab, "the evidence", |app| !app.inspector().noise.is_running());
    lab.run_steps(3);
    lab.check_accessibility();
    assert!(lab.query_by_label_contains("absorption is sampled as an event").is_some());
    // The samples with the largest contributions are listed, and can be replayed.
    let heaviest = {
        let evidence = lab.state().inspector().noise.newest().expect("evidence");
        evidence.heaviest.named.first().expect("a sample").at
    };
    let name = format!("({}, {}) #{}", heaviest.x, heaviest.y, heaviest.sample);
    click(&mut lab, Role::Link, &name);
    lab.run_steps(2);
    wait(&mut lab, "its path", |app| app.inspector().path.pixel.is_some());
    let path = &lab.state().inspector().path;
    assert_eq!(path.pixel, Some([heaviest.x as usize, heaviest.y as usize]));
    assert_eq!(path.sample, Some(heaviest.sample));
    lab.state_mut().request(Command::ShowTab("noise"));
    lab.run_steps(3);
    wait(&mut lab, "the evidence", |app| !app.inspector().noise.is_running());
    lab.run_steps(3);
    click(&mut lab, Role::Button, "Try advice 1");
    lab.run_steps(3);
    let docs = doc(&lab).view_docs();
    assert_eq!(docs.len(), 2);
    assert_eq!(
        (docs[0].estimator.absorption, docs[1].estimator.absorption),
        (Absorption::Analogue, Absorption::Weighted)
    );
    assert!(docs[0].render.seed != docs[1].render.seed);
}

#[test]
fn a_fault_is_announced_compared_with_the_correct_image_and_found() {
    let (mut lab, _directory) = lab();
    open(&mut lab, "What goes wrong");
    let choose = |lab: &mut Lab, name: &str| {
        // The message about the previous fault moves the panels.
        wait(lab, "the picture", |app| app.state().status == Status::Finished);
        lab.run_steps(12);
        click(lab, Role::RadioButton, name);
    };
    for entry in Fault::ALL.iter().filter_map(|fault| fault.entry()) {
        choose(&mut lab, entry.name);
        assert_eq!(doc(&lab).estimator.fault.entry().map(|e| e.name), Some(entry.name));
        assert!(lab.query_by_label_contains("Deliberate fault").is_some());
        lab.check_accessibility();
    }
    choose(&mut lab, "Algorithm 4 as printed");
    lab.state_mut().request(Command::CompareWithCorrect);
    lab.run_steps(3);
    let ids: Vec<_> =
        doc(&lab).view_docs().iter().map(|d| (d.estimator.id.clone(), d.estimator.fault)).collect();
    let right = Fault::None;
    let expected = [("uni-nee-mis", Fault::PhaseInBoth), ("uni-nee-mis", right), ("nee", right)];
    assert_eq!(ids, expected.map(|(id, fault)| (id.to_owned(), fault)));
    // The limit of four samples is raised until the verdict is significant.
    let mut longer = doc(&lab).clone();
    longer.render.spp = Some(256);
    lab.state_mut().request(Command::Edit(Box::new(longer)));
    wait(&mut lab, "the verdict", |app| {
        let analysis = app.wall().analysis();
        let verdict =
            |label: &str| analysis.standing(label).and_then(|s| s.agreement.as_ref().map(|a| a.verdict));
        verdict("A") == Some(Verdict::Differs) && verdict("B") == Some(Verdict::Agrees)
    });
    click(&mut lab, Role::Button, "Remove it");
    assert_eq!(doc(&lab).estimator.fault, right);
    assert!(lab.query_by_label_contains("Deliberate fault").is_none());
}

#[test]
fn tabs_about_one_view_are_there_for_one_and_for_several() {
    let (mut lab, _directory) = lab();
    assert_eq!(doc(&lab).view_count(), 1);
    for count in [1, 2] {
        click(&mut lab, Role::Button, &format!("{count} views"));
        for tab in TABS.iter().filter(|tab| count > 1 || tab.for_one_view()) {
            lab.state_mut().request(Command::ShowTab(tab.id()));
            lab.run_steps(3);
            lab.check_accessibility();
        }
    }
}
