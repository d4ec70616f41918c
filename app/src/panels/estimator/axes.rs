//! Axes of an estimate: settings that estimators share, except those that an estimator does not use.

use crate::widgets::{hint, key, optional_key, row_of, segmented};
use egui::{RichText, Ui};
use majorant_core::estimator::{self, Axis};
use majorant_core::math::SamplerKind;
use majorant_core::scene::{
    Absorption, Bookkeeping, DirectionSampling, DistanceSampling, EstimatorDoc, Heuristic, Heuristics,
    LightSampling, LightSelection, LightWalk, Mode, Tracking,
};
use majorant_core::spectrum::WavelengthSampling;
use majorant_core::transmittance::TransmittanceKind;

/// Shows all axes.
pub(super) fn ui(ui: &mut Ui, doc: &mut EstimatorDoc, opened: &EstimatorDoc) {
    components_ui(ui, doc);
    open_ui(ui, doc, Axis::Absorption, absorption_ui);
    sampling_ui(ui, doc);
    open_ui(ui, doc, Axis::Distances, distances_ui);
    open_ui(ui, doc, Axis::Lights, lights_ui);
    open_ui(ui, doc, Axis::Transmittance, transmittance_ui);
    open_ui(ui, doc, Axis::LightWalk, light_walk_ui);
    combination_ui(ui, doc);
    path_length_ui(ui, doc, opened);
}

/// Shows a setting, disabled with the reason if the estimator does not use it.
fn open_ui(ui: &mut Ui, doc: &mut EstimatorDoc, axis: Axis, choice: impl FnOnce(&mut Ui, &mut EstimatorDoc)) {
    let entry = estimator::find(&doc.id);
    let why = entry.and_then(|entry| entry.unused(axis));
    let scope = ui.add_enabled_ui(why.is_none(), |ui| choice(ui, doc));
    if let (Some(why), Some(entry)) = (why, entry) {
        scope.response.on_hover_text(format!("Not available for {}: {why}.", entry.name));
    }
}

fn components_ui(ui: &mut Ui, doc: &mut EstimatorDoc) {
    row_of(ui, key("estimator.mode"), |ui, _| {
        let options = [
            (Mode::Spectral, "Spectral", "Wavelengths from 360 to 830 nm, with the CIE 1931 observer"),
            (Mode::Rgb, "RGB", "Three fixed components: red, green, blue"),
        ];
        segmented(ui, "Components", &mut doc.mode, &options);
    });
    if doc.mode == Mode::Spectral {
        row_of(ui, key("estimator.wavelengths"), |ui, _| {
            let options = [
                (
                    WavelengthSampling::Sensor,
                    "By sensor",
                    "In proportion to the sensor's response: less colour noise",
                ),
                (WavelengthSampling::Uniform, "Uniform", "Uniform from 360 to 830 nm, as in the report"),
            ];
            segmented(ui, "Wavelengths", &mut doc.wavelengths, &options);
        });
    }
}

fn absorption_ui(ui: &mut Ui, doc: &mut EstimatorDoc) {
    row_of(ui, key("estimator.absorption"), |ui, _| {
        let options = [
            (Absorption::Weighted, "Weighted", "No absorption events; scattering is weighted by the albedo"),
            (Absorption::Analogue, "Analogue", "An event that terminates the path, as in Miller et al. 2019"),
            (Absorption::Roulette, "Roulette", "Weighted, with Russian roulette after each connection"),
        ];
        segmented(ui, "Absorption", &mut doc.absorption, &options);
    });
    hint(
        ui,
        match doc.absorption {
            Absorption::Weighted => {
                "Each scattering event multiplies the throughput by the albedo: P(real) = σt / μ."
            }
            Absorption::Analogue => {
                "A path terminates with P(absorb) = σa / μ and otherwise keeps its throughput."
            }
            Absorption::Roulette => {
                "A path survives with P = albedo, decided after each connection: the cost of the report with less noise."
            }
        },
    );
}

fn distances_ui(ui: &mut Ui, doc: &mut EstimatorDoc) {
    row_of(ui, key("estimator.distances"), |ui, _| {
        let options = [
            (DistanceSampling::Delta, "Delta", "Real with P = σt / μ: no additional weights"),
            (
                DistanceSampling::WeightedDelta,
                "Weighted",
                "Real with P = √(σt / μ): fewer look-ups per event, but varying weights",
            ),
            (
                DistanceSampling::Decomposition,
                "Split",
                "Decomposition tracking: collisions with the local minimum are real and need no look-up",
            ),
        ];
        segmented(ui, "Distances", &mut doc.distances, &options);
    });
}

fn lights_ui(ui: &mut Ui, doc: &mut EstimatorDoc) {
    row_of(ui, key("estimator.lights"), |ui, _| {
        let options = [
            (LightSelection::Uniform, "Uniform", "All with the same probability"),
            (LightSelection::Power, "Power", "In proportion to the emitted power"),
            (
                LightSelection::Contribution,
                "Nearby",
                "In proportion to the unoccluded illuminance at the point",
            ),
        ];
        segmented(ui, "Lights", &mut doc.lights, &options);
    });
    row_of(ui, key("estimator.light_sampling"), |ui, _| {
        let options = [
            (LightSampling::Emitter, "Light", "Uniform over the light, as in the papers"),
            (
                LightSampling::Product,
                "Product",
                "Product of phase function and light: best near large lights with strong forward scattering",
            ),
        ];
        segmented(ui, "Aim", &mut doc.light_sampling, &options);
    });
}

fn light_walk_ui(ui: &mut Ui, doc: &mut EstimatorDoc) {
    row_of(ui, key("estimator.light_walk"), |ui, _| {
        let options = [
            (LightWalk::Fused, "Fused", "The walk that continues to the next vertex"),
            (LightWalk::Separate, "Separate", "A separate walk along the same ray, as in the report"),
        ];
        segmented(ui, "Light walk", &mut doc.light_walk, &options);
    });
}

/// Shows the transmittance estimators of the registry.
fn transmittance_ui(ui: &mut Ui, doc: &mut EstimatorDoc) {
    let chosen = TransmittanceKind::find(&doc.transmittance).map(|kind| kind.entry());
    row_of(ui, key("estimator.transmittance"), |ui, _| {
        let text = chosen.map_or(doc.transmittance.as_str(), |entry| entry.name).to_owned();
        let combo = egui::ComboBox::from_id_salt("transmittance").width(ui.available_width()).truncate();
        let combo = combo.selected_text(text).show_ui(ui, |ui| {
            for kind in TransmittanceKind::all() {
                let entry = kind.entry();
                let selected = doc.transmittance == entry.id;
                let tip = format!("{}\n\n{}\n{}", entry.summary, entry.formula, entry.reference);
                if ui.selectable_label(selected, entry.name).on_hover_text(tip).clicked() {
                    entry.id.clone_into(&mut doc.transmittance);
                }
            }
        });
        combo.response.accessible_name("Transmittance");
    });
    if chosen.is_some_and(|entry| !entry.unbiased) {
        hint(ui, "Biased for every step size.");
    }
}

/// Shows the combination of components and techniques.
fn combination_ui(ui: &mut Ui, doc: &mut EstimatorDoc) {
    const BALANCE: (Heuristic, &str, &str) =
        (Heuristic::Balance, "Balance", "Balance heuristic: in proportion to the densities");
    const POWER: (Heuristic, &str, &str) =
        (Heuristic::Power, "Power", "Power heuristic: in proportion to the squared densities");
    const MAXIMUM: (Heuristic, &str, &str) =
        (Heuristic::Maximum, "Max", "Maximum heuristic: only the largest density");
    egui::CollapsingHeader::new(RichText::new("Combination").small()).show_unindented(ui, |ui| {
        open_ui(ui, doc, Axis::Components, |ui, doc| {
            row_of(ui, key("estimator.heuristics.components"), |ui, _| {
                let none = (Heuristic::HeroOnly, "None", "Uses only the hero wavelength: more colour noise");
                let options = [BALANCE, POWER, MAXIMUM, none];
                segmented(ui, "Heroes", &mut doc.heuristics.components, &options);
            });
        });
        open_ui(ui, doc, Axis::Techniques, |ui, doc| {
            row_of(ui, key("estimator.heuristics.techniques"), |ui, _| {
                segmented(ui, "Techniques", &mut doc.heuristics.techniques, &[BALANCE, POWER, MAXIMUM]);
            });
        });
        open_ui(ui, doc, Axis::Bookkeeping, path_weights_ui);
        open_ui(ui, doc, Axis::Tracking, |ui, doc| {
            row_of(ui, key("estimator.tracking"), |ui, _| {
                let options = [
                    (Tracking::Maximum, "Max", "The largest coefficient over components"),
                    (Tracking::Average, "Average", "Their average"),
                    (
                        Tracking::History,
                        "History",
                        "Their average, weighted by the path throughput of each component",
                    ),
                ];
                segmented(ui, "Tracking", &mut doc.tracking, &options);
            });
        });
    });
}

/// Shows sampler and directions, which change the variance but not the mean.
fn sampling_ui(ui: &mut Ui, doc: &mut EstimatorDoc) {
    row_of(ui, key("estimator.sampler"), |ui, _| {
        let options = [
            (SamplerKind::Independent, "Random", "Independent random numbers: error bars are exact"),
            (
                SamplerKind::Lattice,
                "Lattice",
                "Randomly shifted lattice for the first dimensions of a path: least noise",
            ),
            (SamplerKind::Sobol, "Sobol", "Owen-scrambled Sobol points for the first dimensions of a path"),
        ];
        segmented(ui, "Samples", &mut doc.sampler, &options);
    });
    row_of(ui, key("estimator.directions"), |ui, _| {
        let options = [
            (DirectionSampling::Phase, "Phase", "Phase function sampling, as in the papers"),
            (
                DirectionSampling::TowardsLights,
                "Guided",
                "Mixed with broad lobes towards the lights: best for side light with forward scattering",
            ),
            (
                DirectionSampling::Product,
                "Product",
                "Mixed with the product of phase function and lights: best near lights in view",
            ),
        ];
        segmented(ui, "Directions", &mut doc.directions, &options);
    });
    if doc.sampler != SamplerKind::Independent {
        hint(ui, "Error bars overstate the error, because well-distributed samples are correlated.");
    }
}

fn path_weights_ui(ui: &mut Ui, doc: &mut EstimatorDoc) {
    row_of(ui, key("estimator.bookkeeping"), |ui, _| {
        let options = [
            (Bookkeeping::Rescaled, "p/P", "Densities relative to the density of the path: no overflow"),
            (
                Bookkeeping::ApartF32,
                "f32",
                "f and p stored separately, as in the report: overflows in dense media",
            ),
            (Bookkeeping::ApartF64, "f64", "f and p stored separately in double precision: overflows later"),
            (Bookkeeping::Pairwise, "p/f", "Pairwise quotients of Miller et al.: balance heuristic only"),
        ];
        segmented(ui, "Weights", &mut doc.bookkeeping, &options);
    });
    let overflows = doc.bookkeeping == Bookkeeping::ApartF32;
    let balanced = doc.heuristics == Heuristics::default();
    if overflows {
        hint(ui, "Samples that overflow are counted, located and excluded, which biases the mean.");
    } else if doc.bookkeeping == Bookkeeping::Pairwise && !balanced {
        hint(ui, "Pairwise weights support the balance heuristic only.");
    }
}

fn path_length_ui(ui: &mut Ui, doc: &mut EstimatorDoc, opened: &EstimatorDoc) {
    egui::CollapsingHeader::new(RichText::new("Path length").small()).show_unindented(ui, |ui| {
        let depth = (&mut doc.max_depth, opened.max_depth);
        optional_key(ui, key("estimator.max_depth"), depth, 8, "unlimited", |v| v.within(1.0..=10_000.0));
        let roulette = (&mut doc.roulette_depth, opened.roulette_depth);
        optional_key(ui, key("estimator.roulette_depth"), roulette, 16, "never", |v| {
            v.within(0.0..=10_000.0)
        });
    });
}
