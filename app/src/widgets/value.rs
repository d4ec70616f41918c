//! A number that can be dragged, typed with its unit, and set back.
//!
//! "Back" is to the scene as it was opened or saved, so that a button shows only where something was
//! changed; the default is in the menu of a right click.

use super::number::{format_number, format_within, parse_number};
use super::row::row;
use crate::theme::Palette;
use egui::{
    Align, Button, DragValue, Id, Layout, Rect, Response, RichText, TextStyle, Ui, UiBuilder, emath::Numeric,
    pos2, vec2,
};
use majorant_core::scene::keys::Key;
use std::ops::RangeInclusive;

/// Width of the reset button, at the end of the label column.
const SLOT: f32 = 18.0;

/// A row with one number.
pub struct Value<'a, N> {
    label: &'a str,
    value: &'a mut N,
    name: Option<String>,
    unit: &'a str,
    /// If it is finite at both ends, a bar shows where the value lies in it.
    range: RangeInclusive<f64>,
    speed: f64,
    logarithmic: bool,
    default: N,
    opened: N,
    tip: &'a str,
}

impl<'a, N: Numeric + PartialEq> Value<'a, N> {
    /// A number with its label and its default.
    pub fn new(label: &'a str, value: &'a mut N, default: N) -> Self {
        Self {
            label,
            value,
            name: None,
            unit: "",
            range: N::MIN.to_f64()..=N::MAX.to_f64(),
            speed: if N::INTEGRAL { 0.25 } else { 0.01 },
            logarithmic: false,
            default,
            opened: default,
            tip: "",
        }
    }

    /// A number of a key: with its label, unit, meaning, default, and exactly the values that it allows.
    pub fn of(key: &'static Key, value: &'a mut N) -> Self {
        let default = key.default_value().and_then(|v| v.as_float().or(v.as_integer().map(|n| n as f64)));
        let default = default.map_or(*value, N::from_f64);
        let mut field = Self::new(key.label, value, default).unit(key.unit).tip(key.tip);
        if let Some(range) = key.range() {
            field.range = range.inner();
        }
        field
    }

    /// A default of its own, where it is not that of a key.
    #[must_use]
    pub fn defaulting_to(mut self, default: N) -> Self {
        (self.default, self.opened) = (default, default);
        self
    }

    /// A label of its own.
    #[must_use]
    pub fn labelled(mut self, label: &'a str) -> Self {
        self.label = label;
        self
    }

    /// The part of the allowed range that dragging and typing reach; never more than that.
    #[must_use]
    pub fn within(mut self, range: RangeInclusive<f64>) -> Self {
        let (low, high) = (range.start().max(*self.range.start()), range.end().min(*self.range.end()));
        self.range = low..=high;
        self
    }

    /// The value that the scene had when it was opened or saved: what the reset button goes back to.
    #[must_use]
    pub fn opened(mut self, opened: N) -> Self {
        self.opened = opened;
        self
    }

    /// The unit, shown behind the number.
    #[must_use]
    pub fn unit(mut self, unit: &'a str) -> Self {
        self.unit = unit;
        self
    }

    /// Change per point of dragging.
    #[must_use]
    pub fn speed(mut self, speed: f64) -> Self {
        self.speed = speed;
        self
    }

    /// Dragging multiplies: as fine at 0.01 as at 100.
    #[must_use]
    pub fn logarithmic(mut self) -> Self {
        self.logarithmic = true;
        self
    }

    /// What the number means, preferably with the equation that it stands in.
    #[must_use]
    pub fn tip(mut self, tip: &'a str) -> Self {
        self.tip = tip;
        self
    }

    /// A name for screen readers where the label alone would be ambiguous.
    #[must_use]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.name = Some(name.into());
        self
    }

    /// Shows the row.
    pub fn show(self, ui: &mut Ui) -> Response {
        row(ui, self.label, self.tip, |ui, label| self.field(ui, label))
    }

    pub(super) fn field(self, ui: &mut Ui, label: Id) -> Response {
        let speed = if self.logarithmic { (self.value.to_f64().abs() * 0.012).max(1e-4) } else { self.speed };
        let response = drag(ui, self.value, &self.range, speed, self.unit, ui.available_width());
        paint_bar(ui, &response, self.value.to_f64(), &self.range, self.logarithmic);
        let response = match &self.name {
            Some(name) => response.accessible_name(name.clone()),
            None => response.labelled_by(label),
        };
        let response = if self.tip.is_empty() { response } else { response.on_hover_text(self.tip) };
        reset_menu(&response, self.value, self.opened, self.default, |v| format_number(v.to_f64()));
        let changed = *self.value != self.opened;
        let name = self.name.as_deref().unwrap_or(self.label);
        if changed && reset_button(ui, &response, name, &format_number(self.opened.to_f64())) {
            *self.value = self.opened;
        }
        response
    }
}

/// A number that is dragged or typed, as wide as it is told to be: long numbers are shortened, and the
/// whole value is kept unless it is changed.
pub(super) fn drag<N: Numeric>(
    ui: &mut Ui,
    value: &mut N,
    range: &RangeInclusive<f64>,
    speed: f64,
    unit: &str,
    width: f32,
) -> Response {
    let suffix = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    let before = *value;
    let mut drag = DragValue::new(value)
        .speed(speed)
        .range(range.clone())
        // A file may hold a value outside; showing it must not change it.
        .clamp_existing_to_range(false)
        .update_while_editing(false)
        .min_size(vec2(width, ui.spacing().interact_size.y))
        .custom_parser(|text| parse_number(text, unit));
    let font = TextStyle::Monospace.resolve(ui.style());
    let glyph = ui.fonts_mut(|fonts| fonts.glyph_width(&font, '0')).max(1.0);
    let inner = width - 2.0 * ui.spacing().button_padding.x;
    let room = (inner / glyph) as usize - suffix.chars().count().min((inner / glyph) as usize);
    let text = |value: f64| format_within(value, room);
    if !N::INTEGRAL {
        drag = drag.custom_formatter(move |value, _| text(value));
    }
    let response = ui.add(drag.suffix(suffix));
    // Leaving the field with its text untouched must not round the value to that text.
    let untouched = !N::INTEGRAL && text(before.to_f64()) == text(value.to_f64());
    if untouched && response.lost_focus() {
        *value = before;
    }
    response
}

/// A whole number of a key without a row of its own, named by the key; dragging and typing reach `most`.
pub fn whole(ui: &mut Ui, key: &'static Key, value: &mut u32, most: u32, width: f32) {
    let range = Value::of(key, value).within(0.0..=f64::from(most)).range;
    let drag = DragValue::new(value)
        .range(*range.start() as u32..=*range.end() as u32)
        .speed(2.0)
        .update_while_editing(false)
        .min_size(vec2(width, ui.spacing().interact_size.y));
    ui.add(drag).accessible_name(key.label);
}

/// A hairline at the foot of the field that shows where the value lies in its range.
fn paint_bar(ui: &Ui, response: &Response, value: f64, range: &RangeInclusive<f64>, logarithmic: bool) {
    let (low, high) = (*range.start(), *range.end());
    if response.has_focus() || high - low > 1e5 {
        return;
    }
    let fraction = match logarithmic && low > 0.0 {
        true => (value.max(low) / low).ln() / (high / low).ln(),
        false => (value - low) / (high - low),
    };
    let rect = response.rect;
    let width = rect.width() * fraction.clamp(0.0, 1.0) as f32;
    let bar = Rect::from_min_size(rect.left_bottom() - vec2(0.0, 2.0), vec2(width, 2.0));
    ui.painter().with_clip_rect(ui.clip_rect().intersect(rect)).rect_filled(
        bar,
        1.0,
        Palette::get(ui).accent.gamma_multiply(0.75),
    );
}

/// The two ways back, on a right click.
pub(super) fn reset_menu<T: PartialEq + Copy>(
    response: &Response,
    value: &mut T,
    opened: T,
    default: T,
    text: impl Fn(T) -> String,
) {
    response.context_menu(|ui| {
        if ui.button(format!("As opened: {}", text(opened))).clicked() {
            *value = opened;
            ui.close();
        }
        if default != opened && ui.button(format!("Default: {}", text(default))).clicked() {
            *value = default;
            ui.close();
        }
    });
}

/// A small button at the end of the label column, left of a changed field.
pub(super) fn reset_button(ui: &mut Ui, field: &Response, name: &str, opened: &str) -> bool {
    let right = field.rect.left() - ui.spacing().item_spacing.x + 2.0;
    let rect = Rect::from_min_max(pos2(right - SLOT, field.rect.top()), pos2(right, field.rect.bottom()));
    let text = RichText::new("↺").color(Palette::get(ui).accent);
    let mut slot = ui.new_child(UiBuilder::new().max_rect(rect).layout(Layout::left_to_right(Align::Center)));
    slot.spacing_mut().button_padding = vec2(2.0, 0.0);
    let button = slot.add(Button::new(text).frame(false).min_size(rect.size()));
    button.on_hover_text(format!("Back to {opened}")).accessible_name(format!("Reset {name}")).clicked()
}

/// A row with the optional number of a key, given with what it was when opened. `off` stands for its absence.
pub fn optional_key<N: Numeric + PartialEq>(
    ui: &mut Ui,
    key: &'static Key,
    (value, opened): (&mut Option<N>, Option<N>),
    initial: N,
    off: &str,
    style: impl FnOnce(Value<'_, N>) -> Value<'_, N>,
) {
    optional(ui, key.label, (value, opened), initial, off, key.tip, |v| {
        let Value { value, .. } = v;
        style(Value::of(key, value).named(key.label))
    });
}

/// A row with an optional number, given with what it was when opened: a switch, and the number while it
/// is on.
fn optional<N: Numeric + PartialEq>(
    ui: &mut Ui,
    label: &str,
    (value, opened): (&mut Option<N>, Option<N>),
    initial: N,
    off: &str,
    tip: &str,
    style: impl FnOnce(Value<'_, N>) -> Value<'_, N>,
) {
    row(ui, label, tip, |ui, _| {
        let mut on = value.is_some();
        let checkbox = ui.checkbox(&mut on, "").accessible_name(format!("{label} on"));
        let checkbox = if tip.is_empty() { checkbox } else { checkbox.on_hover_text(tip) };
        if checkbox.changed() {
            *value = on.then(|| opened.unwrap_or(initial));
        }
        match value {
            Some(number) => {
                // The reset button is the switch's; the number has only its menu.
                let mut field = style(Value::new(label, number, initial).tip(tip).named(label));
                field.opened = *field.value;
                field.default = opened.unwrap_or(initial);
                field.field(ui, Id::NULL);
            }
            None => {
                ui.weak(off);
            }
        }
        let text = opened.map_or_else(|| off.to_owned(), |n| format_number(n.to_f64()));
        if *value != opened && reset_button(ui, &checkbox, label, &text) {
            *value = opened;
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use majorant_core::scene::keys::{self, Type};

    /// What a field reaches is what validation allows, and narrowing it never widens it.
    #[test]
    fn fields_reach_what_their_keys_allow_and_no_more() {
        let mut fields = 0;
        for key in keys::all() {
            let Some(range) = key.range().filter(|_| matches!(key.value, Type::Number(_))) else { continue };
            let mut value = 0.0f32;
            let field = Value::of(key, &mut value);
            for reached in [field.range.clone(), field.within(f64::MIN..=f64::MAX).range] {
                for end in [*reached.start(), *reached.end()] {
                    assert!(range.holds(end as f32), "{}: {end}", key.path);
                }
            }
            let middle = 0.5 * (range.min.max(-1.0) + range.max.min(1.0));
            let narrow = Value::of(key, &mut value).within(middle..=1e12).range;
            assert!(*narrow.start() >= middle && *narrow.end() <= range.max, "{}", key.path);
            fields += 1;
        }
        assert!(fields > 20, "{fields}");
    }
}
