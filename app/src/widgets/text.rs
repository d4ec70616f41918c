//! Text field that commits when it loses focus, so that incomplete text is never applied to the document.

use egui::{Id, Response, TextEdit, Ui};

/// Draws an editable text. `text` changes on Enter or loss of focus, not while typing; Escape discards edits.
pub fn buffered_text(
    ui: &mut Ui,
    id: Id,
    name: &str,
    hint: &str,
    text: &mut String,
    rows: usize,
) -> Response {
    let mut buffer = ui.data(|d| d.get_temp::<String>(id)).unwrap_or_else(|| text.clone());
    let edit = match rows {
        1 => TextEdit::singleline(&mut buffer),
        _ => TextEdit::multiline(&mut buffer).desired_rows(rows),
    };
    let edit = edit.id(id).hint_text(hint.to_owned()).desired_width(f32::INFINITY);
    let mut response = ui.add(edit).accessible_name(name);
    if response.has_focus() {
        ui.data_mut(|d| d.insert_temp(id, buffer));
        return response;
    }
    if response.lost_focus() {
        let escaped = ui.input(|i| i.key_pressed(egui::Key::Escape));
        if !escaped && buffer != *text {
            *text = buffer;
            response.mark_changed();
        }
    }
    ui.data_mut(|d| d.remove::<String>(id));
    response
}
