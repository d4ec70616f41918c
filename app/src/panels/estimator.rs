//! How light transport is estimated: the registry as one-click choices, and what they share.

use super::{Column, Cx, Panel};
use crate::theme::Palette;
use crate::widgets::{callout, hint, optional, row, segmented};
use egui::{Color32, CornerRadius, Frame, Label, Margin, RichText, Role, Sense, Stroke, Ui, WidgetInfo};
use majorant_core::estimator::{self, Entry, REGISTRY};
use majorant_core::math::SamplerKind;
use majorant_core::scene::{Absorption, DirectionSampling, EstimatorDoc, Mode};
use majorant_core::spectrum::WavelengthSampling;

/// See the [module](self).
pub struct Estimator;

impl Panel for Estimator {
    fn id(&self) -> &'static str {
        "estimator"
    }
    fn title(&self) -> &'static str {
        "Estimator"
    }
    fn column(&self) -> Column {
        Column::Method
    }
    fn starts_open(&self) -> bool {
        true
    }
    fn summary(&self, cx: &Cx<'_>) -> String {
        let id = &cx.draft.estimator.id;
        estimator::find(id).map_or_else(|| format!("{id}?"), |entry| entry.name.to_owned())
    }
    fn alert(&self, cx: &Cx<'_>, palette: &Palette) -> Option<Color32> {
        estimator::find(&cx.draft.estimator.id).is_none().then_some(palette.error)
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        let doc = &mut cx.draft.estimator;
        if estimator::find(&doc.id).is_none() {
            let text = format!("The scene asks for `{}`, which does not exist. Choose one of these.", doc.id);
            callout(ui, Palette::get(ui).error, &text);
        }
        for entry in REGISTRY {
            if entry_ui(ui, entry, doc.id == entry.id) {
                entry.id.clone_into(&mut doc.id);
            }
        }
        // Below the cards, which stay where they are: one may click back and forth to compare.
        if let Some(entry) = estimator::find(&doc.id) {
            hint(ui, entry.reference);
        }
        ui.add_space(crate::theme::UNIT);
        row(ui, "Components", "What a path carries", |ui, _| {
            let options = [
                (Mode::Spectral, "Spectral", "Wavelengths from 360 to 830 nm, seen by the CIE 1931 observer"),
                (Mode::Rgb, "RGB", "Three fixed components: red, green, blue"),
            ];
            segmented(ui, "Components", &mut doc.mode, &options);
        });
        if doc.mode == Mode::Spectral {
            row(
                ui,
                "Wavelengths",
                "How the hero's wavelength is drawn; the others are rotations of it",
                |ui, _| {
                    let options = [
                        (
                            WavelengthSampling::Sensor,
                            "By sensor",
                            "Often where the sensor responds: less colour noise",
                        ),
                        (
                            WavelengthSampling::Uniform,
                            "Uniform",
                            "Evenly from 360 to 830 nm, as in the report",
                        ),
                    ];
                    segmented(ui, "Wavelengths", &mut doc.wavelengths, &options);
                },
            );
        }
        row(ui, "Absorption", "What happens at a collision that may absorb", |ui, _| {
            let options = [
                (Absorption::Weighted, "Weighted", "Never drawn; scattering carries the albedo as a weight"),
                (Absorption::Analogue, "Analogue", "An event that ends the path, as in Miller et al. 2019"),
            ];
            segmented(ui, "Absorption", &mut doc.absorption, &options);
        });
        hint(
            ui,
            match doc.absorption {
                Absorption::Weighted => {
                    "Each scattering multiplies the path by the albedo: P(real) = σt / μ."
                }
                Absorption::Analogue => "A path ends with P(absorb) = σa / μ and otherwise keeps its weight.",
            },
        );
        sampling_ui(ui, doc);
        path_length_ui(ui, doc, &cx.opened.estimator);
    }
}

/// How random decisions are spread, and where directions come from: the same mean, another variance.
fn sampling_ui(ui: &mut Ui, doc: &mut EstimatorDoc) {
    row(ui, "Samples", "How the samples of a pixel relate to each other", |ui, _| {
        let options = [
            (SamplerKind::Independent, "Independent", "Not at all: error bars are exact"),
            (SamplerKind::Lattice, "Lattice", "Spread evenly over the first decisions of a path: less noise"),
        ];
        segmented(ui, "Samples", &mut doc.sampler, &options);
    });
    row(ui, "Directions", "What directions in the medium are drawn from", |ui, _| {
        let options = [
            (DirectionSampling::Phase, "Phase", "The phase function, as in the papers"),
            (
                DirectionSampling::TowardsLights,
                "Guided",
                "Also from broad lobes towards the lights: wins for light from the side through forward scattering",
            ),
        ];
        segmented(ui, "Directions", &mut doc.directions, &options);
    });
    if doc.sampler == SamplerKind::Lattice {
        hint(ui, "Error bars overstate the error: samples of a lattice hang together.");
    }
}

fn path_length_ui(ui: &mut Ui, doc: &mut EstimatorDoc, opened: &EstimatorDoc) {
    egui::CollapsingHeader::new(RichText::new("Path length").small()).show_unindented(ui, |ui| {
        let depth = "Most segments of a path: 1 is emission only, 2 is single scattering";
        optional(ui, "Max depth", (&mut doc.max_depth, opened.max_depth), 8, "unlimited", depth, |v| {
            v.range(1.0..=10_000.0)
        });
        let roulette = "Ends faint paths at random after this many scatterings; unbiased";
        optional(
            ui,
            "Roulette from",
            (&mut doc.roulette_depth, opened.roulette_depth),
            16,
            "never",
            roulette,
            |v| v.range(0.0..=10_000.0),
        );
    });
}

/// One estimator as a card; returns whether it was chosen.
fn entry_ui(ui: &mut Ui, entry: &Entry, selected: bool) -> bool {
    let palette = Palette::get(ui);
    let id = ui.make_persistent_id(entry.id);
    // Colours of this frame come from the pointer's place in the last one.
    let hovered = ui.read_response(id).is_some_and(|r| r.hovered() || r.has_focus());
    let fill = match (selected, hovered) {
        (true, _) => palette.accent_fill.gamma_multiply(0.55),
        (false, true) => palette.header,
        (false, false) => Color32::TRANSPARENT,
    };
    let line = if selected { palette.accent } else { palette.line };
    let frame = Frame::NONE
        .fill(fill)
        .stroke(Stroke::new(1.0, line))
        .corner_radius(CornerRadius::same(5))
        .inner_margin(Margin { left: 10, right: 8, top: 4, bottom: 5 })
        .show(ui, |ui| {
            ui.set_width(ui.available_width());
            ui.spacing_mut().item_spacing.y = 1.0;
            let text = |ui: &mut Ui, text: RichText| ui.add(Label::new(text).wrap().selectable(false));
            ui.horizontal(|ui| {
                radio_dot(ui, selected);
                text(ui, RichText::new(entry.name).color(palette.strong));
            });
            text(ui, RichText::new(entry.summary).small().color(palette.text));
        });
    let response = ui.interact(frame.response.rect, id, Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::RadioButton, true, selected, entry.name));
    let clicked = response.clicked();
    response.on_hover_text(entry.reference);
    clicked && !selected
}

fn radio_dot(ui: &mut Ui, selected: bool) {
    let palette = Palette::get(ui);
    let (rect, _) = ui.allocate_exact_size(egui::vec2(12.0, 12.0), Sense::hover());
    let colour = if selected { palette.accent } else { palette.weak };
    ui.painter().circle_stroke(rect.center(), 5.0, Stroke::new(1.3, colour));
    if selected {
        ui.painter().circle_filled(rect.center(), 2.6, colour);
    }
}
