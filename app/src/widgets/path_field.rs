//! Input field for a file name.

use super::{row::row, text::buffered_text};
use egui::{Button, Sense, Ui, UiBuilder, vec2};

/// Draws a row with a path and a button; returns whether the button for the file dialog was clicked.
pub fn path_field(ui: &mut Ui, label: &str, name: &str, hint: &str, path: &mut String, tip: &str) -> bool {
    row(ui, label, tip, |ui, _| {
        let id = ui.make_persistent_id(("path", name));
        const BUTTON: f32 = 28.0;
        let width = ui.available_width() - BUTTON - ui.spacing().item_spacing.x;
        let (rect, _) = ui.allocate_exact_size(vec2(width, ui.spacing().interact_size.y), Sense::hover());
        let mut slot = ui.new_child(UiBuilder::new().max_rect(rect));
        let field = buffered_text(&mut slot, id, name, hint, path, 1);
        if !path.is_empty() {
            field.on_hover_text(path.as_str());
        }
        ui.spacing_mut().button_padding.x = 2.0;
        ui.add(Button::new("…").min_size(vec2(BUTTON, 0.0)))
            .on_hover_text("Choose a file")
            .accessible_name(format!("Choose {name}"))
            .clicked()
    })
}
