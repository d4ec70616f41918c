//! Hints, callouts and badges.

use crate::theme::{Palette, UNIT};
use egui::{Color32, CornerRadius, Frame, Label, Margin, RichText, Stroke, Ui};

/// Draws a paragraph in small, weak text.
pub fn hint(ui: &mut Ui, text: &str) {
    ui.add(Label::new(RichText::new(text).small().weak()).wrap().selectable(false));
}

/// Draws a paragraph with a coloured edge.
pub fn callout(ui: &mut Ui, colour: Color32, text: &str) {
    let response = Frame::NONE
        .inner_margin(Margin { left: 10, right: 6, top: 4, bottom: 4 })
        .fill(colour.gamma_multiply(0.10))
        .corner_radius(CornerRadius::same(3))
        .show(ui, |ui| {
            ui.set_width(ui.available_width());
            ui.add(Label::new(RichText::new(text).small().color(colour)).wrap());
        })
        .response;
    let edge = response.rect.with_max_x(response.rect.left() + 3.0);
    ui.painter().rect_filled(edge, 1.5, colour);
    ui.add_space(0.5 * UNIT);
}

/// Draws a short text in a coloured outline.
pub fn badge(ui: &mut Ui, colour: Color32, text: &str) -> egui::Response {
    Frame::NONE
        .inner_margin(Margin::symmetric(6, 1))
        .fill(Palette::get(ui).panel.lerp_to_gamma(colour, 0.14))
        .stroke(Stroke::new(1.0, colour.gamma_multiply(0.55)))
        .corner_radius(CornerRadius::same(8))
        .show(ui, |ui| ui.add(Label::new(RichText::new(text).small().color(colour)).selectable(false)))
        .inner
}
