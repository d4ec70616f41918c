//! The axes of an estimate: choices that any estimator combines with, but for those it has no use for.

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

/// All of them.
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

/// A choice as it is, or greyed out with the reason where the estimator does not have it.
fn open_ui(ui: &mut Ui, doc: &mut EstimatorDoc, axis: Axis, choice: impl FnOnce(&mut Ui, &mut EstimatorDoc)) {
    let entry = estimator::find(&doc.id);
    let why = entry.and_then(|entry| entry.unused(axis));
    let scope = ui.add_enabled_ui(why.is_none(), |ui| choice(ui, doc));
    if let (Some(why), Some(entry)) = (why, entry) {
        scope.response.on_hover_text(format!("Nothing to choose under {}: {why}.", entry.name));
    }
}

fn components_ui(ui: &mut Ui, doc: &mut EstimatorDoc) {
    row_of(ui, key("estimator.mode"), |ui, _| {
        let options = [
            (Mode::Spectral, "Spectral", "Wavelengths from 360 to 830 nm, seen by the CIE 1931 observer"),
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
                    "Often where the sensor responds: less colour noise",
                ),
                (WavelengthSampling::Uniform, "Uniform", "Evenly from 360 to 830 nm, as in the report"),
            ];
            segmented(ui, "Wavelengths", &mut doc.wavelengths, &options);
        });
    }
}

fn absorption_ui(ui: &mut Ui, doc: &mut EstimatorDoc) {
    row_of(ui, key("estimator.absorption"), |ui, _| {
        let options = [
            (Absorption::Weighted, "Weighted", "Never drawn; scattering carries the albedo as a weight"),
            (Absorption::Analogue, "Analogue", "An event that ends the path, as in Miller et al. 2019"),
            (Absorption::Roulette, "Roulette", "Weighted, and ended by roulette after light was connected"),
        ];
        segmented(ui, "Absorption", &mut doc.absorption, &options);
    });
    hint(
        ui,
        match doc.absorption {
            Absorption::Weighted => "Each scattering multiplies the path by the albedo: P(real) = σt / μ.",
            Absorption::Analogue => "A path ends with P(absorb) = σa / μ and otherwise keeps its weight.",
            Absorption::Roulette => {
                "A path goes on with P = albedo, decided after light was connected: the report's cost, less noise."
            }
        },
    );
}

fn distances_ui(ui: &mut Ui, doc: &mut EstimatorDoc) {
    row_of(ui, key("estimator.distances"), |ui, _| {
        let options = [
            (DistanceSampling::Delta, "Delta", "Real with P = σt / μ: the fewest weights"),
            (
                DistanceSampling::WeightedDelta,
                "Weighted",
                "Real with P = √(σt / μ): fewer look-ups per event, weights that vary",
            ),
            (
                DistanceSampling::Decomposition,
                "Split",
                "Decomposition: collisions with the local minimum are real and cost no look-up",
            ),
        ];
        segmented(ui, "Distances", &mut doc.distances, &options);
    });
}

fn lights_ui(ui: &mut Ui, doc: &mut EstimatorDoc) {
    row_of(ui, key("estimator.lights"), |ui, _| {
        let options = [
            (LightSelection::Uniform, "Uniform", "Any, with the same probability"),
            (LightSelection::Power, "Power", "In proportion to what each emits"),
            (LightSelection::Contribution, "Nearby", "In proportion to what would arrive from each"),
        ];
        segmented(ui, "Lights", &mut doc.lights, &options);
    });
    row_of(ui, key("estimator.light_sampling"), |ui, _| {
        let options = [
            (LightSampling::Emitter, "Light", "Anywhere, evenly: as in the papers"),
            (
                LightSampling::Product,
                "Product",
                "Where the phase function scatters to: wins beside large lights, for sharply forward scattering",
            ),
        ];
        segmented(ui, "Aim", &mut doc.light_sampling, &options);
    });
}

fn light_walk_ui(ui: &mut Ui, doc: &mut EstimatorDoc) {
    row_of(ui, key("estimator.light_walk"), |ui, _| {
        let options = [
            (LightWalk::Fused, "Fused", "The one that goes on to the next vertex"),
            (LightWalk::Separate, "Separate", "One of its own along the same ray, as the report prints it"),
        ];
        segmented(ui, "Light walk", &mut doc.light_walk, &options);
    });
}

/// How connections estimate transmittance, from the registry.
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
        hint(ui, "Biased: the step is never small enough.");
    }
}

/// How the ways in which a path could have been made share it.
fn combination_ui(ui: &mut Ui, doc: &mut EstimatorDoc) {
    const BALANCE: (Heuristic, &str, &str) =
        (Heuristic::Balance, "Balance", "In proportion to the densities");
    const POWER: (Heuristic, &str, &str) = (Heuristic::Power, "Power", "In proportion to their squares");
    const MAXIMUM: (Heuristic, &str, &str) = (Heuristic::Maximum, "Max", "All to the largest density");
    egui::CollapsingHeader::new(RichText::new("Combination").small()).show_unindented(ui, |ui| {
        open_ui(ui, doc, Axis::Components, |ui, doc| {
            row_of(ui, key("estimator.heuristics.components"), |ui, _| {
                let none = (Heuristic::HeroOnly, "None", "Only the hero is used: colour noise returns");
                let options = [BALANCE, POWER, MAXIMUM, none];
                segmented(ui, "Heroes", &mut doc.heuristics.components, &options);
            });
        });
        open_ui(ui, doc, Axis::Techniques, |ui, doc| {
            row_of(ui, key("estimator.heuristics.techniques"), |ui, _| {
                segmented(ui, "Techniques", &mut doc.heuristics.techniques, &[BALANCE, POWER, MAXIMUM]);
            });
        });
        open_ui(ui, doc, Axis::Bookkeeping, books_ui);
        open_ui(ui, doc, Axis::Tracking, |ui, doc| {
            row_of(ui, key("estimator.tracking"), |ui, _| {
                let options = [
                    (Tracking::Maximum, "Max", "The largest coefficient over components"),
                    (Tracking::Average, "Average", "Their average"),
                    (Tracking::History, "History", "Their average by what the path is worth at each"),
                ];
                segmented(ui, "Tracking", &mut doc.tracking, &options);
            });
        });
    });
}

/// How random decisions are spread, and where directions come from: the same mean, another variance.
fn sampling_ui(ui: &mut Ui, doc: &mut EstimatorDoc) {
    row_of(ui, key("estimator.sampler"), |ui, _| {
        let options = [
            (SamplerKind::Independent, "Random", "Not at all: error bars are exact"),
            (
                SamplerKind::Lattice,
                "Lattice",
                "Spread evenly over the first decisions of a path: least noise",
            ),
            (SamplerKind::Sobol, "Sobol", "Owen-scrambled Sobol points for the first decisions of a path"),
        ];
        segmented(ui, "Samples", &mut doc.sampler, &options);
    });
    row_of(ui, key("estimator.directions"), |ui, _| {
        let options = [
            (DirectionSampling::Phase, "Phase", "The phase function, as in the papers"),
            (
                DirectionSampling::TowardsLights,
                "Guided",
                "Also from broad lobes towards the lights: wins for light from the side through forward scattering",
            ),
            (
                DirectionSampling::Product,
                "Product",
                "Also from the part of the phase function that can meet the lights: wins beside lights in view",
            ),
        ];
        segmented(ui, "Directions", &mut doc.directions, &options);
    });
    if doc.sampler != SamplerKind::Independent {
        hint(ui, "Error bars overstate the error: samples that are spread evenly hang together.");
    }
}

fn books_ui(ui: &mut Ui, doc: &mut EstimatorDoc) {
    row_of(ui, key("estimator.bookkeeping"), |ui, _| {
        let options = [
            (Bookkeeping::Rescaled, "p/P", "Quotients by the density that made the path: no overflow"),
            (
                Bookkeeping::ApartF32,
                "f32",
                "f and p apart, as the report prints them: overflow in dense media",
            ),
            (Bookkeeping::ApartF64, "f64", "f and p apart in double precision: overflow later"),
            (Bookkeeping::Pairwise, "p/f", "Miller's quotients of all pairs: the balance heuristic only"),
        ];
        segmented(ui, "Weights", &mut doc.bookkeeping, &options);
    });
    let overflows = doc.bookkeeping == Bookkeeping::ApartF32;
    let balanced = doc.heuristics == Heuristics::default();
    if overflows {
        hint(ui, "Samples that overflow are counted, located and left out: the mean is then wrong.");
    } else if doc.bookkeeping == Bookkeeping::Pairwise && !balanced {
        hint(ui, "Of quotients of pairs only the balance heuristic can be formed.");
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
