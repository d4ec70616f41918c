//! Settings of the estimator, and the measurement of the majorant factor.

use super::harness::{click, doc, lab, open, wait};
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};
use majorant::model::Command;
use majorant_core::bench::FACTORS;
use majorant_core::estimator::{Axis, REGISTRY};
use majorant_core::light::LightSelection;
use majorant_core::scene::{
    Absorption, Bookkeeping, DirectionSampling, DistanceSampling, Heuristic, LightSampling, LightWalk,
    SceneDoc,
};
use majorant_core::session::Status;

#[test]
fn every_axis_is_chosen_by_name() {
    let (mut lab, _directory) = lab();
    open(&mut lab, "Estimator");
    click(&mut lab, Role::Button, "Distances: Split");
    click(&mut lab, Role::Button, "Absorption: Roulette");
    click(&mut lab, Role::Button, "Lights: Power");
    click(&mut lab, Role::Button, "Aim: Product");
    click(&mut lab, Role::Button, "Light walk: Separate");
    click(&mut lab, Role::Button, "Directions: Product");
    open(&mut lab, "Combination");
    click(&mut lab, Role::Button, "Heroes: Power");
    click(&mut lab, Role::Button, "Techniques: Max");
    click(&mut lab, Role::Button, "Weights: f64");
    let e = &doc(&lab).estimator;
    assert_eq!(
        (e.distances, e.absorption, e.lights),
        (DistanceSampling::Decomposition, Absorption::Roulette, LightSelection::Power)
    );
    assert_eq!((e.heuristics.components, e.heuristics.techniques), (Heuristic::Power, Heuristic::Maximum));
    assert_eq!(e.light_walk, LightWalk::Separate);
    assert_eq!((e.light_sampling, e.directions), (LightSampling::Product, DirectionSampling::Product));
    assert_eq!(e.bookkeeping, Bookkeeping::ApartF64);
    let generation = lab.state().state().generation;
    wait(&mut lab, "a picture of all that", |app| {
        app.shown().is_some_and(|s| s.generation >= generation && s.spp >= 1)
    });
}

#[test]
fn a_choice_that_an_estimator_does_not_have_is_greyed_out() {
    let (mut lab, _directory) = lab();
    open(&mut lab, "Estimator");
    for entry in REGISTRY {
        click(&mut lab, Role::RadioButton, entry.name);
        for (axis, label) in [
            (Axis::Distances, "Distances: Split"),
            (Axis::Lights, "Lights: Power"),
            (Axis::LightWalk, "Light walk: Separate"),
        ] {
            let node = lab.get_by_role_and_label(Role::Button, label);
            assert_eq!(
                node.accesskit_node().is_disabled(),
                entry.unused(axis).is_some(),
                "{} {label}",
                entry.id
            );
        }
    }
}

#[test]
fn the_curve_of_the_factor_is_measured_and_says_of_what() {
    let (mut lab, _directory) = lab();
    open(&mut lab, "Majorant");
    open(&mut lab, "Cost and bias by factor");
    // A thin medium, so that the many paths are short.
    let mut thin = doc(&lab).clone();
    thin.medium_mut().scale = 0.02;
    lab.state_mut().request(Command::Edit(Box::new(thin)));
    wait(&mut lab, "the thin scene", |app| app.state().status == Status::Finished);
    lab.run_steps(12);
    click(&mut lab, Role::Button, "Measure");
    let scene = doc(&lab).clone();
    assert!(lab.state().factor_curve().is_of(&scene), "the button was missed");
    wait(&mut lab, "the curve", |app| !app.factor_curve().is_running());
    let curve = lab.state().factor_curve();
    assert_eq!((curve.points().len(), curve.error()), (FACTORS.len(), None));
    assert!(curve.is_of(doc(&lab)));
    click(&mut lab, Role::Button, "Absorption: Analogue");
    assert!(!lab.state().factor_curve().is_of(doc(&lab)));

    // A black image has no relative noise: a message replaces the plot.
    let black = SceneDoc { lights: Vec::new(), ..doc(&lab).clone() };
    lab.state_mut().request(Command::Edit(Box::new(black)));
    // The notice moves the panels; a click on a moving button would miss.
    wait(&mut lab, "the notice", |app| !app.state().notices.is_empty());
    lab.run_steps(12);
    click(&mut lab, Role::Button, "Measure");
    let scene = doc(&lab).clone();
    assert!(lab.state().factor_curve().is_of(&scene), "the button was missed");
    wait(&mut lab, "the curve of nothing", |app| !app.factor_curve().is_running());
    lab.run_steps(2);
    assert!(lab.state().factor_curve().is_of(doc(&lab)));
    assert!(lab.query_by_label_contains("Nothing to compare").is_some());
}
