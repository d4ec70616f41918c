//! Progress bar over the views while a file is read.

use super::LabApp;
use crate::theme::Palette;
use egui::{Align2, Area, Context, Frame, Id, Margin, Order, ProgressBar, Rect, RichText};
use majorant_core::session::Status;
use std::time::{Duration, Instant};

/// Delay before the bar is shown, so that short reads do not make it flicker.
const PATIENCE: Duration = Duration::from_millis(150);
/// Interval between progress updates.
const LOOK_AGAIN: Duration = Duration::from_millis(40);
const WIDTH: f32 = 280.0;

impl LabApp {
    /// Shows a bar with the name of the file after a delay.
    pub(super) fn loading_ui(&mut self, ctx: &Context, pictures: Rect) {
        if self.state.status != Status::Building {
            self.building_since = None;
            return;
        }
        ctx.request_repaint_after(LOOK_AGAIN);
        let since = *self.building_since.get_or_insert_with(Instant::now);
        let Some(loading) = self.state.loading.as_ref().filter(|_| since.elapsed() >= PATIENCE) else {
            return;
        };
        let palette = Palette::of(ctx.theme());
        let file = loading.file.rsplit(['/', '\\']).next().unwrap_or(&loading.file);
        let area = Area::new(Id::unique("loading")).order(Order::Foreground).interactable(false);
        area.pivot(Align2::CENTER_CENTER).fixed_pos(pictures.center()).show(ctx, |ui| {
            let frame = Frame::NONE.fill(palette.panel).corner_radius(6.0).inner_margin(Margin::same(14));
            frame.stroke((1.0, palette.line)).show(ui, |ui| {
                ui.set_width(WIDTH);
                ui.label(RichText::new(format!("Reading {file}")).color(palette.text));
                ui.add(ProgressBar::new(loading.fraction as f32).show_percentage().desired_width(WIDTH));
            });
        });
    }
}
