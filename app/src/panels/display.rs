//! Conversion of linear radiance to display colours; does not affect the estimate.

use super::{Column, Cx, Panel};
use crate::widgets::{Value, key, optional_key, row_of, segmented};
use egui::Ui;
use majorant_core::scene::ToneCurve;

/// Panel of exposure and tone mapping.
pub struct Display;

impl Panel for Display {
    fn id(&self) -> &'static str {
        "display"
    }
    fn title(&self) -> &'static str {
        "Display"
    }
    fn column(&self) -> Column {
        Column::Method
    }
    fn summary(&self, cx: &Cx<'_>) -> String {
        format!("{:+.1} EV", cx.draft.view.exposure_ev)
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        let view = &mut cx.draft.view;
        Value::of(key("view.exposure_ev"), &mut view.exposure_ev)
            .opened(cx.opened.view.exposure_ev)
            .within(-16.0..=16.0)
            .speed(0.02)
            .show(ui);
        row_of(ui, key("view.tone"), |ui, _| {
            let options = [
                (ToneCurve::Linear, "Linear", "Clips at 1, otherwise shows the computed radiance"),
                (ToneCurve::Reinhard, "Reinhard", "x / (1 + x), by luminance"),
                (ToneCurve::Filmic, "Filmic", "Soft shoulder and toe: Narkowicz's fit of ACES"),
            ];
            segmented(ui, "Tone curve", &mut view.tone, &options);
        });
        let gamma = (&mut view.gamma, cx.opened.view.gamma);
        optional_key(ui, key("view.gamma"), gamma, 2.2, "sRGB curve", |v| v.within(0.2..=5.0));
    }
}
