//! Labelled rows of a panel: label left, content right, aligned in columns.

use crate::theme::LABEL_WIDTH;
use egui::{Align, Id, Label, Layout, RichText, Sense, Ui, UiBuilder, vec2};
use majorant_core::scene::keys::Key;

/// Draws a row with the label and tooltip of a key.
pub fn row_of<R>(ui: &mut Ui, key: &'static Key, add: impl FnOnce(&mut Ui, Id) -> R) -> R {
    row(ui, key.label, key.tip, add)
}

/// Draws a row; `add` receives the rest of the line, and the label's id, which names its widget.
pub fn row<R>(ui: &mut Ui, label: &str, tip: &str, add: impl FnOnce(&mut Ui, Id) -> R) -> R {
    ui.horizontal(|ui| {
        let height = ui.spacing().interact_size.y;
        let (rect, _) = ui.allocate_exact_size(vec2(LABEL_WIDTH, height), Sense::hover());
        let mut column =
            ui.new_child(UiBuilder::new().max_rect(rect).layout(Layout::left_to_right(Align::Center)));
        let response = column.add(Label::new(RichText::new(label)).truncate().selectable(false));
        let response = if tip.is_empty() { response } else { response.on_hover_text(tip) };
        add(ui, response.id)
    })
    .inner
}
