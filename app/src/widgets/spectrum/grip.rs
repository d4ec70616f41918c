//! Handle of a control point: dragging, arrow keys, removal.

use super::axes::Axes;
use super::{SpectrumField, model};
use crate::theme::Palette;
use crate::widgets::number::format_number;
use egui::{
    CursorIcon, EventFilter, Id, Key, Pos2, Rect, Response, Sense, Stroke, TextStyle, Ui, Vec2, WidgetInfo,
    pos2, vec2,
};
use majorant_core::spectrum::ControlPoint;

/// Size of the interactive area of a point, in points of the screen.
const GRIP: f32 = 16.0;

/// Draws a control point and handles its input; returns whether it is being dragged.
pub(super) fn grip_ui(
    ui: &Ui,
    field: &SpectrumField<'_>,
    axes: &Axes,
    id: Id,
    points: &mut Vec<ControlPoint>,
    index: usize,
    at: &impl Fn(Pos2) -> ControlPoint,
) -> bool {
    let Some(point) = points.get(index).copied() else { return false };
    let centre = axes.point(point.lambda_nm, point.value.min(axes.top));
    let rect = Rect::from_center_size(centre, Vec2::splat(GRIP));
    let response = ui.interact(rect, id, Sense::click_and_drag());
    let name = format!("{} point {}", field.name, index + 1);
    response.widget_info(|| WidgetInfo::slider(true, f64::from(point.value), &name));
    let range = field.values();
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }
    if response.dragged()
        && let Some(p) = response.interact_pointer_pos()
    {
        let to = at(p);
        let to = ControlPoint { value: to.value.min(axes.top), ..to };
        model::shift(points, index, to, range);
    }
    let delete = response.has_focus()
        && ui.input_mut(|i| {
            i.consume_key(egui::Modifiers::NONE, Key::Delete)
                || i.consume_key(egui::Modifiers::NONE, Key::Backspace)
        });
    if response.secondary_clicked() || delete {
        model::remove(points, index);
    } else if response.has_focus() {
        nudge(ui, &response, axes, points, index, range);
    }
    paint_grip(ui, &response, centre);
    let text = format!("{} nm: {}", format_number(point.lambda_nm.into()), format_number(point.value.into()));
    let dragged = response.dragged();
    if dragged {
        // Tooltips are hidden while the button is down.
        paint_value(ui, axes, centre, &text);
    }
    response.on_hover_and_drag_cursor(CursorIcon::Move).on_hover_text(text);
    dragged
}

/// Moves a focused point with the arrow keys, in steps ten times smaller with Shift.
fn nudge(
    ui: &Ui,
    response: &Response,
    axes: &Axes,
    points: &mut [ControlPoint],
    index: usize,
    range: [f32; 2],
) {
    let filter = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|m| m.set_focus_lock_filter(response.id, filter));
    let (step, pressed) = ui.input(|i| {
        let step = if i.modifiers.shift { 0.1 } else { 1.0 };
        let sign = |plus, minus| f32::from(i8::from(i.key_pressed(plus)) - i8::from(i.key_pressed(minus)));
        (step, vec2(sign(Key::ArrowRight, Key::ArrowLeft), sign(Key::ArrowUp, Key::ArrowDown)))
    });
    if pressed != Vec2::ZERO
        && let Some(point) = points.get(index).copied()
    {
        let to = ControlPoint {
            lambda_nm: point.lambda_nm + pressed.x * step,
            value: point.value + pressed.y * step * axes.top / 100.0,
        };
        model::shift(points, index, to, range);
    }
}

/// Draws the coordinates of a point, on the side that has room.
fn paint_value(ui: &Ui, axes: &Axes, at: Pos2, text: &str) {
    let palette = Palette::get(ui);
    let font = TextStyle::Small.resolve(ui.style());
    let galley = ui.painter().layout_no_wrap(text.to_owned(), font, palette.strong);
    let gap = vec2(12.0, -0.5 * galley.size().y);
    let right = at.x < axes.frame.center().x;
    let x = if right { at.x + gap.x } else { at.x - gap.x - galley.size().x };
    let y = (at.y + gap.y).clamp(axes.frame.top() + 2.0, axes.frame.bottom() - galley.size().y - 2.0);
    let back = Rect::from_min_size(pos2(x, y), galley.size()).expand2(vec2(4.0, 1.0));
    ui.painter().rect_filled(back, 3.0, palette.bar.gamma_multiply(0.9));
    ui.painter().galley(pos2(x, y), galley, palette.strong);
}

fn paint_grip(ui: &Ui, response: &Response, centre: Pos2) {
    let palette = Palette::get(ui);
    let hot = response.hovered() || response.dragged();
    let radius = if hot { 5.5 } else { 4.5 };
    let fill = if hot || response.has_focus() { palette.accent } else { palette.well };
    ui.painter().circle(centre, radius, fill, Stroke::new(1.6, palette.accent));
}
