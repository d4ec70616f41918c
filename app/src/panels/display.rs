//! How linear radiance becomes display colour; never part of the estimate.

use super::{Column, Cx, Panel};
use crate::widgets::{Value, optional, row, segmented};
use egui::Ui;
use majorant_core::scene::{ToneCurve, ViewDoc};

/// See the [module](self).
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
        Value::new("Exposure", &mut view.exposure_ev, ViewDoc::default().exposure_ev)
            .opened(cx.opened.view.exposure_ev)
            .unit("EV")
            .range(-16.0..=16.0)
            .speed(0.02)
            .tip("shown = 2^EV · radiance. E and Shift + E move it by half a stop")
            .show(ui);
        row(ui, "Tone curve", "Maps bright radiance into the display's range", |ui, _| {
            let options = [
                (ToneCurve::Linear, "Linear", "Clips at 1: what you see is what was computed"),
                (ToneCurve::Reinhard, "Reinhard", "x / (1 + x) by luminance"),
                (ToneCurve::Filmic, "Filmic", "Soft shoulder and toe, Narkowicz's fit of ACES"),
            ];
            segmented(ui, "Tone curve", &mut view.tone, &options);
        });
        let tip = "Display gamma instead of the sRGB curve";
        optional(ui, "Gamma", (&mut view.gamma, cx.opened.view.gamma), 2.2, "sRGB curve", tip, |v| {
            v.range(0.2..=5.0)
        });
    }
}
