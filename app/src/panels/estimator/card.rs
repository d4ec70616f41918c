//! Card of one estimator.

use crate::theme::Palette;
use egui::{Color32, CornerRadius, Frame, Label, Margin, RichText, Role, Sense, Stroke, Ui, WidgetInfo};
use majorant_core::estimator::Entry;

/// Shows the card; returns whether it was chosen.
pub(super) fn ui(ui: &mut Ui, entry: &Entry, selected: bool) -> bool {
    let palette = Palette::get(ui);
    let id = ui.make_persistent_id(entry.id);
    // The colours of this frame follow the hover state of the last one.
    let hovered = ui.read_response(id).is_some_and(|r| r.hovered() || r.has_focus());
    let fill = match (selected, hovered) {
        (true, _) => palette.accent_fill.gamma_multiply(0.55),
        (false, true) => palette.header,
        (false, false) => Color32::TRANSPARENT,
    };
    let line = if selected { palette.accent } else { palette.line };
    let frame = Frame::NONE
        .fill(fill)
        .stroke(Stroke::new(1.0, line))
        .corner_radius(CornerRadius::same(5))
        .inner_margin(Margin { left: 10, right: 8, top: 4, bottom: 5 })
        .show(ui, |ui| {
            ui.set_width(ui.available_width());
            ui.spacing_mut().item_spacing.y = 1.0;
            let text = |ui: &mut Ui, text: RichText| ui.add(Label::new(text).wrap().selectable(false));
            ui.horizontal(|ui| {
                radio_dot(ui, selected);
                text(ui, RichText::new(entry.name).color(palette.strong));
            });
            text(ui, RichText::new(entry.summary).small().color(palette.text));
        });
    let response = ui.interact(frame.response.rect, id, Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::RadioButton, true, selected, entry.name));
    let clicked = response.clicked();
    response.on_hover_text(entry.reference);
    clicked && !selected
}

fn radio_dot(ui: &mut Ui, selected: bool) {
    let palette = Palette::get(ui);
    let (rect, _) = ui.allocate_exact_size(egui::vec2(12.0, 12.0), Sense::hover());
    let colour = if selected { palette.accent } else { palette.weak };
    ui.painter().circle_stroke(rect.center(), 5.0, Stroke::new(1.3, colour));
    if selected {
        ui.painter().circle_filled(rect.center(), 2.6, colour);
    }
}
