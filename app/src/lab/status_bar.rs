//! Status bar: render status, pixel under the pointer, image size and zoom.

use super::LabApp;
use crate::model::stats::{count, duration};
use crate::theme::Palette;
use crate::view::readout;
use crate::view::tone_mapper::PictureId;
use egui::{Align, Color32, Label, Layout, RichText, Sense, Ui, vec2};
use majorant_core::session::{Ending, Status};

impl LabApp {
    pub(super) fn status_ui(&self, ui: &mut Ui) {
        let palette = Palette::get(ui);
        ui.horizontal_centered(|ui| {
            let (colour, text) = self.activity(palette);
            let (dot, _) = ui.allocate_exact_size(vec2(10.0, 10.0), Sense::hover());
            ui.painter().circle_filled(dot.center(), 4.0, colour);
            ui.add(Label::new(RichText::new(text).color(palette.text)).selectable(false));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let film = self.doc().film.clone();
                let view = format!("{} × {}   {:.0} %", film.width, film.height, 100.0 * self.zoom);
                ui.add(Label::new(RichText::new(view).color(palette.weak)).selectable(false))
                    .on_hover_text("Image size and zoom: F fits, 1 is 100 %, the wheel zooms");
                ui.add_space(12.0);
                let text = match self.pixel.and_then(|(picture, at)| self.pixel_text(picture, at)) {
                    Some(text) => RichText::new(text).monospace().color(palette.strong),
                    None => RichText::new("Drag orbits, wheel zooms, ? lists all keys").color(palette.weak),
                };
                ui.add(Label::new(text).truncate().selectable(false)).on_hover_text(
                    "Linear radiance of the pixel under the pointer ± standard error of its mean",
                );
            });
        });
    }

    /// Radiance, standard error and map value of the pixel under the pointer.
    fn pixel_text(&self, picture: PictureId, at: [usize; 2]) -> Option<String> {
        let uploaded = self.wall.uploaded(picture)?;
        let snapshot = uploaded.snapshot.as_ref()?;
        let text = readout::describe(snapshot, at)?;
        let map = uploaded.map.as_ref().and_then(|print| {
            let value = print.values.get(at[1] * snapshot.width + at[0])?;
            Some(format!("   {} {}", print.map.name, readout::short(*value)))
        });
        Some(text + &map.unwrap_or_default())
    }

    /// Render status as a colour and a short text.
    fn activity(&self, palette: &Palette) -> (Color32, String) {
        let stats = &self.stats;
        let rate = stats.spp_per_second.map_or_else(String::new, |r| format!("   {} spp/s", count(r)));
        let paused = self.wall.is_paused();
        match &self.state.status {
            Status::Empty => (palette.weak, "Nothing to render".into()),
            Status::Building => {
                let text = self.state.loading.as_ref().map_or_else(
                    || "Building the scene".into(),
                    |l| format!("Reading {}   {:.0} %", l.file, 100.0 * l.fraction),
                );
                (palette.accent, text)
            }
            Status::Rendering => {
                let limit = self.doc().render.spp.map_or_else(String::new, |n| format!(" of {n}"));
                (palette.accent, format!("Rendering   {}{limit} spp{rate}", stats.spp))
            }
            Status::Paused => (palette.warning, format!("Paused at {} spp", stats.spp)),
            Status::Finished if self.state.ending.and_then(Ending::warning).is_some() => {
                let what = if self.state.ending == Some(Ending::Black) { "black" } else { "not finite" };
                let text = format!("Stopped   all {what} after {} spp: no relative error", stats.spp);
                (palette.warning, text)
            }
            // Other views may not have finished.
            Status::Finished if paused => (
                palette.warning,
                format!("Paused   finished, {} spp in {}", stats.spp, duration(stats.seconds)),
            ),
            Status::Finished => {
                (palette.good, format!("Finished   {} spp in {}", stats.spp, duration(stats.seconds)))
            }
            Status::Failed(_) => (palette.error, "The scene cannot be rendered".into()),
        }
    }
}
