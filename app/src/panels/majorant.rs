//! The majorant: what free flights are sampled from. It costs or saves time, not truth — unless clamped.

use super::{Column, Cx, Panel};
use crate::theme::Palette;
use crate::widgets::{Value, badge, callout, format_number, hint, row, segmented, switch};
use egui::{Color32, Sense, Ui, vec2};
use majorant_core::scene::{MajorantDoc, WhenExceeded};

/// See the [module](self).
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
    fn summary(&self, cx: &Cx<'_>) -> String {
        let majorant = &cx.draft.medium.majorant;
        let shared = if majorant.shared { ", shared" } else { "" };
        format!("{} × max σt{shared}", format_number(f64::from(majorant.factor)))
    }
    fn alert(&self, cx: &Cx<'_>, palette: &Palette) -> Option<Color32> {
        verdict(&cx.draft.medium.majorant, palette).map(|(colour, _, _)| colour)
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        let default = MajorantDoc::default();
        let majorant = &mut cx.draft.medium.majorant;
        Value::new("Factor", &mut majorant.factor, default.factor)
            .opened(cx.opened.medium.majorant.factor)
            .range(0.1..=16.0)
            .logarithmic()
            .named("Majorant factor")
            .tip("μ(λ) = factor · max over x of σt(x, λ). 1 is tight; above it null collisions are added")
            .show(ui);
        if let Some(info) = cx.state.scene.as_ref() {
            tightness_ui(ui, info.tightness);
        }
        let shared = "Every wavelength gets the largest one's majorant: μ = factor · max over x and λ of σt";
        switch(ui, "Shared", "Shared majorant", &mut majorant.shared, "by all wavelengths", shared);
        row(ui, "Where exceeded", "What happens where σt is larger than μ", |ui, _| {
            let options = [
                (WhenExceeded::Weighted, "Weighted", "σn = μ − σt turns negative; the weights stay right"),
                (WhenExceeded::Clamp, "Clamp", "σn is held at 0: the textbook mistake, biased"),
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
                "Null collisions fill σt up to μ: σn = μ − σt. They change the cost, not the picture.",
            ),
        }
    }
}

/// What is to be said about a majorant that does not bound the extinction.
fn verdict(majorant: &MajorantDoc, palette: &Palette) -> Option<(Color32, &'static str, &'static str)> {
    if majorant.factor >= 1.0 {
        return None;
    }
    Some(match majorant.when_exceeded {
        WhenExceeded::Weighted => (
            palette.warning,
            "weighted: unbiased, noisier",
            "μ is below the largest σt. Where σt > μ, null collisions have negative weight: the mean is right, the variance grows.",
        ),
        WhenExceeded::Clamp => (
            palette.error,
            "clamp: biased",
            "μ is below the largest σt and null collisions are clamped: the picture converges to a wrong, brighter or darker one.",
        ),
    })
}

/// Share of collisions in the box that are real, as a bar.
fn tightness_ui(ui: &mut Ui, tightness: f32) {
    let tip = "mean σt / μ over the box: the share of tentative collisions that are real. The rest is null";
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
