//! Settings that affect speed, and the display of latencies.

use super::harness::{click, doc, lab_on, open, wait};
use egui::Key;
use egui::accesskit::{Role, Toggled};
use egui_kittest::kittest::{NodeT, Queryable};
use majorant::model::Source;
use majorant_core::math::SamplerKind;
use majorant_core::medium::{Interpolation, Precision};
use majorant_core::scene::DirectionSampling;
use majorant_core::spectrum::WavelengthSampling;

#[test]
fn majorant_cells_are_chosen_counted_and_shown() {
    let mut lab = lab_on(Source::first());
    wait(&mut lab, "freezing the scene", |app| app.state().scene.is_some());
    let cells = |app: &majorant::lab::LabApp| {
        app.state().scene.as_ref().and_then(|info| info.medium(0)?.majorant_cells)
    };
    let automatic = cells(lab.state()).expect("a grid");
    assert!(automatic > 1);
    click(&mut lab, Role::CheckBox, "Resolution on");
    assert_eq!(
        doc(&lab).medium().majorant.resolution,
        Some(automatic as u32),
        "it starts at the automatic resolution"
    );
    let lookups = |app: &majorant::lab::LabApp| {
        app.shown().map_or(0.0, |s| s.tally.lookups as f64 / s.tally.paths as f64)
    };
    let at = |lab: &mut super::Lab, n: u32| {
        lab.get_by_role_and_label(Role::SpinButton, "Resolution").set_value_accesskit(f64::from(n));
        lab.run_steps(2);
        assert_eq!(doc(lab).medium().majorant.resolution, Some(n));
        let generation = lab.state().state().generation;
        wait(lab, "pictures of the new cells", |app| {
            app.state().generation >= generation
                && cells(app) == Some(n as usize)
                && app.shown().is_some_and(|s| s.generation >= generation && s.spp >= 1)
        });
        lookups(lab.state())
    };
    let (one, many) = (at(&mut lab, 1), at(&mut lab, 16));
    assert!(one > 2.0 * many, "{one} look-ups a path under one majorant, {many} under 16³");

    let shown = |lab: &super::Lab| {
        let node = lab.get_by_role_and_label(Role::CheckBox, "Show majorant cells");
        node.accesskit_node().toggled() == Some(Toggled::True)
    };
    assert!(!shown(&lab));
    click(&mut lab, Role::CheckBox, "Show majorant cells");
    assert!(shown(&lab) && lab.state().settings().majorant_slice == Some(0.5));
    lab.key_press(Key::M);
    lab.run_steps(3);
    assert!(!shown(&lab) && lab.state().settings().majorant_slice.is_none());
}

#[test]
fn samples_directions_and_storage_are_chosen_by_name() {
    let mut lab = lab_on(Source::first());
    for title in ["Estimator", "Density"] {
        open(&mut lab, title);
    }
    click(&mut lab, Role::Button, "Samples: Lattice");
    click(&mut lab, Role::Button, "Directions: Guided");
    let estimator = &doc(&lab).estimator;
    assert_eq!(
        (estimator.sampler, estimator.directions, estimator.wavelengths),
        (SamplerKind::Lattice, DirectionSampling::TowardsLights, WavelengthSampling::Sensor)
    );
    click(&mut lab, Role::Button, "Wavelengths: Uniform");
    assert_eq!(doc(&lab).estimator.wavelengths, WavelengthSampling::Uniform);
    click(&mut lab, Role::Button, "Precision: 8");
    click(&mut lab, Role::Button, "Interpolation: One sample");
    let medium = doc(&lab).medium();
    assert_eq!((medium.precision, medium.interpolation), (Precision::U8, Interpolation::Stochastic));
    let generation = lab.state().state().generation;
    wait(&mut lab, "saying what eight bits cost", |app| {
        app.state().generation >= generation
            && app.state().scene.as_ref().is_some_and(|s| s.medium(0).is_some_and(|m| m.storage_error > 0.0))
    });
}

#[test]
fn latency_is_measured_and_shown() {
    let mut lab = lab_on(Source::first());
    wait(&mut lab, "a first picture", |app| app.shown().is_some());
    for i in 1..=3_u8 {
        lab.get_by_role_and_label(Role::SpinButton, "Majorant factor")
            .set_value_accesskit(1.0 + f64::from(i));
        lab.run_steps(2);
        let generation = lab.state().state().generation;
        wait(&mut lab, "its picture", |app| app.shown().is_some_and(|s| s.generation >= generation));
    }
    let latency = lab.state().latency();
    let picture = latency.first_picture().expect("edits were answered");
    assert!(picture.median > 0.0 && picture.median <= picture.worst && picture.worst < 20.0, "{picture:?}");
    let cancelled = latency.cancellation().expect("work was cancelled");
    assert!(cancelled.median <= cancelled.worst && cancelled.worst < 20.0, "{cancelled:?}");
    assert!(latency.frames().is_some_and(|frames| frames.median > 0.0));
    open(&mut lab, "Render");
    open(&mut lab, "Latency");
    lab.get_by_label_contains("First image");
}
