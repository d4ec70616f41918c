//! Input fields for three coordinates.

use super::number::format_number;
use super::row::row;
use super::value::{drag, reset_button, reset_menu};
use egui::Ui;
use majorant_core::scene::keys::Key;
use std::ops::RangeInclusive;

/// Row with three numbers.
pub struct Vector<'a> {
    label: &'a str,
    name: String,
    value: &'a mut [f32; 3],
    default: [f32; 3],
    opened: [f32; 3],
    unit: &'a str,
    speed: f64,
    range: RangeInclusive<f64>,
    tip: &'a str,
}

impl<'a> Vector<'a> {
    /// Creates a row from a label, a name that is unique in the window, a value and its default.
    pub fn new(label: &'a str, name: impl Into<String>, value: &'a mut [f32; 3], default: [f32; 3]) -> Self {
        let range = f64::from(f32::MIN)..=f64::from(f32::MAX);
        Self {
            label,
            name: name.into(),
            value,
            default,
            opened: default,
            unit: "",
            speed: 0.01,
            range,
            tip: "",
        }
    }

    /// Creates a row from a key, with its label, unit, tooltip, default and range.
    pub fn of(key: &'static Key, name: impl Into<String>, value: &'a mut [f32; 3]) -> Self {
        let default = key.default_value().and_then(|v| v.try_into().ok()).unwrap_or(*value);
        let mut field = Self::new(key.label, name, value, default).tip(key.tip);
        if key.unit == "°" {
            field = field.degrees();
        }
        if let Some(range) = key.range() {
            field.range = range.inner();
        }
        field
    }

    /// Replaces the default of the key.
    #[must_use]
    pub fn defaulting_to(mut self, default: [f32; 3]) -> Self {
        (self.default, self.opened) = (default, default);
        self
    }

    /// Sets the value when the scene was opened or saved, which the reset button restores.
    #[must_use]
    pub fn opened(mut self, opened: [f32; 3]) -> Self {
        self.opened = opened;
        self
    }

    /// Sets the unit to degrees.
    #[must_use]
    pub fn degrees(mut self) -> Self {
        (self.unit, self.speed) = ("°", 0.5);
        self
    }

    /// Sets the tooltip.
    #[must_use]
    pub fn tip(mut self, tip: &'a str) -> Self {
        self.tip = tip;
        self
    }

    /// Draws the row.
    pub fn show(self, ui: &mut Ui) {
        let Self { label, name, value, default, opened, unit, speed, range, tip } = self;
        row(ui, label, tip, |ui, _| {
            let gap = 4.0;
            let width = (ui.available_width() - 2.0 * gap) / 3.0;
            let outer = (ui.spacing().item_spacing.x, ui.spacing().button_padding.x);
            // Three fields have the width of one.
            ui.spacing_mut().button_padding.x = 3.0;
            let mut first = None;
            for (axis, i) in ["x", "y", "z"].iter().zip(0..3) {
                ui.spacing_mut().item_spacing.x = gap;
                let field = drag(ui, &mut value[i], &range, speed, unit, width);
                let field = field.accessible_name(format!("{name} {axis}"));
                let exact = format_number(f64::from(value[i]));
                let field = field.on_hover_text(format!("{axis} = {exact}\n{tip}").trim_end());
                reset_menu(&field, value, opened, default, text);
                first.get_or_insert(field);
            }
            (ui.spacing_mut().item_spacing.x, ui.spacing_mut().button_padding.x) = outer;
            if let Some(field) = first
                && *value != opened
                && reset_button(ui, &field, &name, &text(opened))
            {
                *value = opened;
            }
        });
    }
}

fn text(value: [f32; 3]) -> String {
    value.map(|x| format_number(f64::from(x))).join(", ")
}
