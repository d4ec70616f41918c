//! A file name that can be typed or chosen.

use super::{row::row, text::buffered_text};
use egui::Ui;

/// A row with a path; returns whether the file chooser was asked for.
pub fn path_field(ui: &mut Ui, label: &str, name: &str, hint: &str, path: &mut String, tip: &str) -> bool {
    row(ui, label, tip, |ui, _| {
        let browse = "…";
        let id = ui.make_persistent_id(("path", name));
        let width = ui.available_width() - 36.0;
        ui.scope(|ui| {
            ui.set_max_width(width.max(60.0));
            let field = buffered_text(ui, id, name, hint, path, 1);
            if !path.is_empty() {
                field.on_hover_text(path.as_str());
            }
        });
        ui.button(browse).on_hover_text("Choose a file").accessible_name(format!("Choose {name}")).clicked()
    })
}
