//! Colour scale of a map.

use super::caption::digits;
use crate::theme::Palette;
use crate::view::tone_mapper::MapImage;
use egui::{Align2, Color32, Rect, Role, Sense, TextStyle, Ui, WidgetInfo, vec2};

/// Height of the scale, in points.
pub(super) const HEIGHT: f32 = 40.0;
/// Minimum width at which the reference is named, in points.
const WIDE: f32 = 760.0;
/// Number of colour steps.
const STEPS: usize = 128;

/// Draws the colour scale with its values.
pub(super) fn legend_ui(ui: &mut Ui, rect: Rect, image: &MapImage) {
    let palette = Palette::get(ui);
    let response = ui.allocate_rect(rect, Sense::hover());
    let (map, range) = (image.map, image.range);
    response.widget_info(|| {
        let text = format!("{}: {} to {}", map.name, range.lo, range.hi);
        WidgetInfo::labeled(Role::Label, true, text)
    });
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 0.0, palette.bar);
    let font = TextStyle::Small.resolve(ui.style());
    let name = painter.text(
        rect.left_center() + vec2(10.0, 0.0),
        Align2::LEFT_CENTER,
        map.name,
        font.clone(),
        palette.strong,
    );
    let mut named = name.right();
    if !image.against.is_empty() && rect.width() > WIDE {
        let against = format!("against {}", image.against);
        let at = name.right_center() + vec2(10.0, 0.0);
        named = painter.text(at, Align2::LEFT_CENTER, against, font.clone(), palette.weak).right();
    }
    let left = (named + 24.0).max(rect.left() + 130.0);
    let bar = Rect::from_min_max(
        egui::pos2(left, rect.top() + 6.0),
        egui::pos2(rect.right() - 40.0, rect.top() + 18.0),
    );
    if bar.width() < 40.0 {
        return;
    }
    for step in 0..STEPS {
        let share = |i: usize| i as f32 / STEPS as f32;
        let [r, g, b] = range.colour(share(step));
        let x = egui::lerp(bar.x_range(), share(step))..=egui::lerp(bar.x_range(), share(step + 1)) + 0.5;
        painter.rect_filled(Rect::from_x_y_ranges(x, bar.y_range()), 0.0, Color32::from_rgb(r, g, b));
    }
    let ticks = if bar.width() > 300.0 { 5_u8 } else { 3 };
    for tick in 0..ticks {
        let at = f32::from(tick) / f32::from(ticks - 1);
        let x = egui::lerp(bar.x_range(), at);
        painter.vline(x, bar.bottom()..=bar.bottom() + 3.0, egui::Stroke::new(1.0, palette.weak));
        let text = digits(range.value(at).into());
        painter.text(egui::pos2(x, bar.bottom() + 4.0), Align2::CENTER_TOP, text, font.clone(), palette.text);
    }
    let against =
        if image.against.is_empty() { String::new() } else { format!("\nCompared with {}.", image.against) };
    response.on_hover_text(format!(
        "{}{against}\nAll views share the range; magenta marks values that are not finite.",
        map.formula
    ));
}
