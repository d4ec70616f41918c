//! The majorant, from which free flights are sampled. It affects cost and noise, and bias only if exceeded.

use super::factor_curve::factor_curve_ui;
use super::{Column, Cx, Panel};
use crate::model::Command;
use crate::theme::Palette;
use crate::widgets::{
    Value, badge, callout, format_number, hint, key, optional_key, row, row_of, segmented, switch,
};
use egui::{Color32, Sense, Slider, Ui, vec2};
use majorant_core::scene::{MajorantDoc, WhenExceeded};

/// Panel of the majorant.
pub struct Majorant;

impl Panel for Majorant {
    fn id(&self) -> &'static str {
        "majorant"
    }
    fn title(&self) -> &'static str {
        "Majorant"
    }
    fn column(&self) -> Column {
        Column::Method
    }
    fn starts_open(&self) -> bool {
        true
    }
    fn is_of_medium(&self) -> bool {
        true
    }
    fn summary(&self, cx: &Cx<'_>) -> String {
        let majorant = &cx.draft.medium_at(cx.medium).majorant;
        let shared = if majorant.shared { ", shared" } else { "" };
        let cells = majorant.resolution.or(cx.medium_info().and_then(|i| i.majorant_cells).map(|n| n as u32));
        let cells = cells.map_or_else(String::new, |n| format!(", {n}³"));
        format!("{} × max σt{cells}{shared}", format_number(f64::from(majorant.factor)))
    }
    fn alert(&self, cx: &Cx<'_>, palette: &Palette) -> Option<Color32> {
        verdict(&cx.draft.medium_at(cx.medium).majorant, palette).map(|(colour, _, _)| colour)
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        let cells = cx.medium_info().and_then(|info| info.majorant_cells);
        let majorant = &mut cx.draft.medium_at_mut(cx.medium).majorant;
        Value::of(key("medium.majorant.factor"), &mut majorant.factor)
            .opened(cx.opened.medium_at(cx.medium).majorant.factor)
            .within(0.1..=16.0)
            .logarithmic()
            .named("Majorant factor")
            .show(ui);
        let automatic = cells.map_or_else(|| "automatic".into(), |n| format!("automatic: {n}³"));
        let (resolution, opened) =
            (&mut majorant.resolution, cx.opened.medium_at(cx.medium).majorant.resolution);
        let initial = cells.unwrap_or(16) as u32;
        let resolution = (resolution, opened);
        optional_key(ui, key("medium.majorant.resolution"), resolution, initial, &automatic, |v| {
            v.logarithmic()
        });
        if let Some(info) = cx.medium_info() {
            tightness_ui(ui, info.tightness);
        }
        if let Some(lookups) = cx.stats.lookups_per_path {
            row(
                ui,
                "Look-ups",
                "Look-ups of the medium per path, which tighter majorants reduce",
                |ui, _| {
                    ui.monospace(format!("{lookups:.2} per path"));
                },
            );
        }
        if let Some(exceeded) = cx.stats.exceeded.filter(|share| *share > 0.0) {
            row(ui, "Exceeded", "Fraction of look-ups at which σt exceeded μ", |ui, _| {
                let colour = Palette::get(ui).warning;
                ui.colored_label(
                    colour,
                    egui::RichText::new(format!("{:.2} %", 100.0 * exceeded)).monospace(),
                );
            });
        }
        if let Some(violations) = cx.state.probe.as_ref().and_then(|probe| probe.violations(cx.medium)) {
            let count = violations.exceeded_cells();
            if count > 0 {
                let tip = "Cells in which a flight has found σt > μ since μ was set or raised. M shows them";
                row(ui, "Violations", tip, |ui, _| {
                    let all = violations.cells().pow(3);
                    ui.colored_label(
                        Palette::get(ui).warning,
                        egui::RichText::new(format!("{count} of {all} cells")).monospace(),
                    );
                });
            }
        }
        slice_ui(ui, cx.settings.majorant_slice, cells.is_some(), cx.commands);
        let majorant = &mut cx.draft.medium_at_mut(cx.medium).majorant;
        let shared = key("medium.majorant.shared");
        switch(ui, shared.label, "Shared majorant", &mut majorant.shared, "by all wavelengths", shared.tip);
        row_of(ui, key("medium.majorant.when_exceeded"), |ui, _| {
            let options = [
                (WhenExceeded::Weighted, "Weighted", "σn = μ − σt becomes negative; weights remain unbiased"),
                (WhenExceeded::Clamp, "Clamp", "σn is clamped to 0: a common mistake, biased"),
                (
                    WhenExceeded::Progressive,
                    "Raise",
                    "Clamped, and bounds are raised to the extinctions found, after 1, 2, 4, 8, … samples: the error vanishes",
                ),
            ];
            segmented(ui, "Where exceeded", &mut majorant.when_exceeded, &options);
        });
        match verdict(majorant, Palette::get(ui)) {
            Some((colour, word, text)) => {
                ui.add_space(crate::theme::UNIT);
                ui.horizontal(|ui| {
                    badge(ui, colour, word);
                });
                callout(ui, colour, text);
            }
            None => hint(
                ui,
                "Null collisions fill σt up to μ: σn = μ − σt. They change the cost, not the expected image.",
            ),
        }
        factor_curve_ui(ui, cx);
    }
}

/// Shows the setting of the cell slice that is drawn over the views.
fn slice_ui(ui: &mut Ui, slice: Option<f32>, there: bool, commands: &mut Vec<Command>) {
    let tip = "Draws a slice of the cells over the image, coloured by tightness  (M)";
    row(ui, "Cells", tip, |ui, _| {
        let mut shown = slice.is_some();
        let text = if there { "show" } else { "show (grids only)" };
        if ui.checkbox(&mut shown, text).accessible_name("Show majorant cells").on_hover_text(tip).clicked() {
            commands.push(Command::ToggleMajorants);
        }
        if let Some(depth) = slice {
            let mut moved = depth;
            ui.spacing_mut().slider_width = (ui.available_width() - 8.0).max(40.0);
            let slider = Slider::new(&mut moved, 0.0..=1.0).show_value(false);
            ui.add(slider).on_hover_text("Depth of the slice, near to far");
            if moved != depth {
                commands.push(Command::ShowMajorants(Some(moved)));
            }
        }
    });
}

/// Warning about a majorant that does not bound the extinction: colour, badge and text.
fn verdict(majorant: &MajorantDoc, palette: &Palette) -> Option<(Color32, &'static str, &'static str)> {
    if majorant.factor >= 1.0 {
        return None;
    }
    Some(match majorant.when_exceeded {
        WhenExceeded::Weighted => (
            palette.warning,
            "weighted: unbiased, noisier",
            "μ is below the largest σt. Where σt > μ, null collisions have negative weight: the mean is correct, the variance increases.",
        ),
        WhenExceeded::Clamp => (
            palette.error,
            "clamp: biased",
            "μ is below the largest σt and null collisions are clamped: the image converges to a wrong result, too bright or too dark.",
        ),
        WhenExceeded::Progressive => (
            palette.warning,
            "raised: consistent",
            "μ is below the largest σt. Cells in which σt > μ was found get a larger μ after 1, 2, 4, 8, … samples per pixel: early samples are biased, but their share vanishes.",
        ),
    })
}

/// Shows the fraction of collisions in the box that are real, as a bar.
fn tightness_ui(ui: &mut Ui, tightness: f32) {
    let tip = "mean σt / mean μ over the box: the fraction of collisions along a straight line that are real; the others are null";
    row(ui, "Tightness", tip, |ui, _| {
        let palette = Palette::get(ui);
        let width = ui.available_width() - 70.0;
        let (rect, response) = ui.allocate_exact_size(vec2(width, 8.0), Sense::hover());
        ui.painter().rect_filled(rect, 4.0, palette.well);
        let filled = rect.with_max_x(egui::lerp(rect.x_range(), tightness.clamp(0.0, 1.0)));
        let colour = if tightness > 1.0 { palette.warning } else { palette.accent };
        ui.painter().rect_filled(filled, 4.0, colour);
        response.on_hover_text(tip);
        ui.monospace(format!("{:.1} %", 100.0 * tightness));
    });
}
