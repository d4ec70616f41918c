//! Segmented buttons and checkboxes.

use super::row::row;
use crate::theme::Palette;
use egui::{Button, CornerRadius, RichText, Ui, vec2};

/// Draws a row of buttons, one per option, each with the accessible name `name: label`. Returns whether the
/// value changed.
pub fn segmented<T: PartialEq + Copy>(
    ui: &mut Ui,
    name: &str,
    value: &mut T,
    options: &[(T, &str, &str)],
) -> bool {
    let mut changed = false;
    let palette = Palette::get(ui);
    ui.scope(|ui| {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 1.0;
            // The buttons divide the width equally.
            ui.spacing_mut().button_padding.x = 2.0;
            let count = options.len() as f32;
            let width = (ui.available_width() - (count - 1.0)) / count;
            for (index, (option, label, tip)) in options.iter().enumerate() {
                let selected = *value == *option;
                let text = RichText::new(*label).color(if selected { palette.strong } else { palette.text });
                let button = Button::selectable(selected, text)
                    .frame_when_inactive(true)
                    .min_size(vec2(width, 0.0))
                    .corner_radius(ends(index, options.len()));
                let response = ui.add(button).accessible_name(format!("{name}: {label}"));
                let response = if tip.is_empty() { response } else { response.on_hover_text(*tip) };
                if response.clicked() && !selected {
                    *value = *option;
                    changed = true;
                }
            }
        });
    });
    changed
}

/// Corner radii of a button: only the outer corners of the row are rounded.
fn ends(index: usize, count: usize) -> CornerRadius {
    let left = if index == 0 { 4 } else { 0 };
    let right = if index + 1 == count { 4 } else { 0 };
    CornerRadius { nw: left, sw: left, ne: right, se: right }
}

/// Draws a row with a checkbox.
pub fn switch(ui: &mut Ui, label: &str, name: &str, value: &mut bool, text: &str, tip: &str) {
    row(ui, label, tip, |ui, _| {
        let response = ui.checkbox(value, text).accessible_name(name);
        if !tip.is_empty() {
            response.on_hover_text(tip);
        }
    });
}
