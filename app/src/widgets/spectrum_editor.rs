//! Edits a spectrum: kind, points on a plot, exact numbers, presets.

use super::choice::segmented;
use super::row::row;
use super::spectrum_model::{self as model, Kind};
use super::spectrum_plot::Axes;
use super::text::buffered_text;
use super::value::{Value, format_number};
use super::{callout, hint};
use crate::theme::Palette;
use egui::containers::menu::MenuButton;
use egui::{
    Button, CursorIcon, EventFilter, Id, Key, Pos2, Rect, Response, RichText, Role, Sense, Shape, Stroke, Ui,
    Vec2, WidgetInfo, vec2,
};
use majorant_core::scene::MajorantDoc;
use majorant_core::spectrum::{
    ControlPoint, LAMBDA_MAX_NM, LAMBDA_MIN_NM, Outside, Quantity, Spectrum, SpectrumDoc, presets,
};

/// Height of the plot's frame.
const FRAME: f32 = 104.0;
/// Diameter of the area that takes hold of a point.
const GRIP: f32 = 16.0;

/// What the edited spectrum stands for.
pub struct SpectrumField<'a> {
    /// Its name, which starts the names of all its widgets.
    pub name: &'a str,
    /// Unit of its values.
    pub unit: &'a str,
    /// Greatest value, if there is one.
    pub max: Option<f32>,
    /// What it means.
    pub tip: &'a str,
    /// The spectrum when the scene was opened or saved.
    pub opened: &'a SpectrumDoc,
    /// What it is a spectrum of; decides how RGB becomes one.
    pub quantity: Quantity,
    /// The majorant that is drawn over an extinction.
    pub majorant: Option<&'a MajorantDoc>,
}

/// Shows the editor.
pub fn spectrum_editor(ui: &mut Ui, field: &SpectrumField<'_>, doc: &mut SpectrumDoc) {
    ui.push_id(field.name, |ui| {
        kind_ui(ui, field, doc);
        match doc {
            SpectrumDoc::Constant(value) => constant_ui(ui, field, value),
            SpectrumDoc::Rgb(rgb) => rgb_ui(ui, field, rgb),
            SpectrumDoc::Points { .. } | SpectrumDoc::Preset(_) => {}
        }
        plot_ui(ui, field, doc);
        if let SpectrumDoc::Preset(id) = doc {
            let summary = presets::find(id).map_or("", |p| p.summary);
            hint(ui, &format!("Preset {id}: {summary}. Drag a point to make it your own."));
        }
        if matches!(doc, SpectrumDoc::Points { .. }) {
            points_ui(ui, field, doc);
        }
    });
}

fn kind_ui(ui: &mut Ui, field: &SpectrumField<'_>, doc: &mut SpectrumDoc) {
    ui.horizontal(|ui| {
        let mut kind = model::kind(doc);
        let options = [
            (Kind::Constant, "Constant", "The same value at every wavelength"),
            (Kind::Points, "Points", "Control points, linear between"),
            (Kind::Rgb, "RGB", "Linear sRGB components, upsampled to a smooth spectrum"),
        ];
        ui.scope(|ui| {
            ui.set_max_width(ui.available_width() - 78.0);
            if segmented(ui, field.name, &mut kind, &options) {
                *doc = model::converted(doc, kind);
            }
        });
        let button = Button::new("Presets").min_size(vec2(ui.available_width(), 0.0));
        let (response, _) = MenuButton::from_button(button).ui(ui, |ui| {
            for preset in presets::PRESETS {
                let chosen = *doc == SpectrumDoc::Preset(preset.id.into());
                if ui.selectable_label(chosen, preset.id).on_hover_text(preset.summary).clicked() {
                    *doc = SpectrumDoc::Preset(preset.id.into());
                    ui.close();
                }
            }
            ui.separator();
            if ui.button("As opened").on_hover_text("Take all edits of this spectrum back").clicked() {
                *doc = field.opened.clone();
                ui.close();
            }
        });
        response.accessible_name(format!("{} presets", field.name));
    });
}

fn constant_ui(ui: &mut Ui, field: &SpectrumField<'_>, value: &mut f32) {
    let opened = match field.opened {
        SpectrumDoc::Constant(opened) => *opened,
        _ => *value,
    };
    let default = field.max.unwrap_or(1.0);
    let number = Value::new("Value", value, default).opened(opened).unit(field.unit).tip(field.tip);
    let number = match field.max {
        Some(max) => number.range(0.0..=f64::from(max)).speed(0.004),
        None => number.range(0.0..=f64::from(f32::MAX)).logarithmic(),
    };
    number.named(format!("{} value", field.name)).show(ui);
}

fn rgb_ui(ui: &mut Ui, field: &SpectrumField<'_>, rgb: &mut [f32; 3]) {
    row(ui, "Colour", field.tip, |ui, _| {
        // The picker rounds through HSV: only what it really changed may reach the document.
        let mut picked = *rgb;
        let button = ui.color_edit_button_rgb(&mut picked);
        let button = button.accessible_name(format!("{} colour", field.name));
        if button.changed() {
            *rgb = picked;
        }
        hint(ui, "linear sRGB");
    });
    for (channel, value) in ["Red", "Green", "Blue"].iter().zip(rgb) {
        let opened = *value;
        let max = f64::from(field.max.unwrap_or(f32::MAX));
        let number = Value::new(channel, value, 1.0).opened(opened).range(0.0..=max).tip(field.tip);
        number.named(format!("{} {}", field.name, channel.to_lowercase())).show(ui);
    }
}

fn plot_ui(ui: &mut Ui, field: &SpectrumField<'_>, doc: &mut SpectrumDoc) {
    let id = ui.make_persistent_id("plot");
    let size = vec2(ui.available_width(), Axes::height(FRAME));
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let spectrum = Spectrum::new(doc, field.quantity);
    let axes = Axes::within(rect, plot_top(ui, id, field, doc, &spectrum));
    let background = ui.interact(axes.frame, id, Sense::click());
    background.widget_info(|| WidgetInfo::labeled(Role::Image, true, format!("{} plot", field.name)));
    let painter = ui.painter_at(rect);
    axes.paint(ui, &painter);
    let palette = Palette::get(ui);
    axes.paint_curve(&painter.with_clip_rect(axes.frame), &spectrum, palette.strong);
    if let Some(majorant) = field.majorant {
        paint_majorant(ui, &painter, &axes, &spectrum, majorant);
    }

    let at = |p: Pos2| {
        let (lambda, value) = axes.value(p);
        ControlPoint { lambda_nm: lambda.round(), value: tidy(value.max(0.0), axes.top) }
    };
    let mut edit: Option<(Vec<ControlPoint>, Outside)> = None;
    // A click just before makes it a triple click.
    let doubled = background.double_clicked() || background.triple_clicked();
    if doubled && let Some(p) = background.interact_pointer_pos() {
        let (mut points, outside) = model::points_of(doc);
        if model::add(&mut points, at(p)).is_some() {
            edit = Some((points, outside));
        }
    }
    if let Some((points, outside)) = doc.control_points() {
        let mut edited = points.clone();
        let mut dragging = false;
        for index in 0..points.len() {
            dragging |= grip_ui(ui, field, &axes, id.with(("grip", index)), &mut edited, index, &at);
        }
        ui.data_mut(|d| {
            d.remove::<f32>(id);
            if dragging {
                d.insert_temp(id, axes.top);
            }
        });
        if edited != points {
            edit = Some((edited, outside));
        }
    }
    if let Some((points, outside)) = edit {
        *doc = SpectrumDoc::Points { points, outside };
    }
    background.on_hover_text("Double-click adds a point. Drag a point; right-click or Delete removes it.");
}

/// The top of the value axis; it rests while a point is dragged, or the point would run away.
fn plot_top(ui: &Ui, id: Id, field: &SpectrumField<'_>, doc: &SpectrumDoc, spectrum: &Spectrum) -> f32 {
    if let Some(held) = ui.data(|d| d.get_temp::<f32>(id)) {
        return held;
    }
    if let Some(max) = field.max {
        return max;
    }
    let mut largest = 0.0_f32;
    let mut lambda = LAMBDA_MIN_NM;
    while lambda <= LAMBDA_MAX_NM {
        largest = largest.max(spectrum.at(lambda));
        lambda += 5.0;
    }
    for point in doc.control_points().map(|(points, _)| points).unwrap_or_default() {
        largest = largest.max(point.value);
    }
    let factor = field.majorant.map_or(1.0, |m| m.factor.clamp(1.0, 1.6));
    model::plot_top(largest * factor)
}

/// Rounds to what a mouse can mean: the power of ten below a three hundredth of the axis.
fn tidy(value: f32, top: f32) -> f32 {
    let exponent = (top / 300.0).log10().floor();
    // Dividing by a whole number keeps decimals exact where multiplying by 0.1 would not.
    let inverse = 10_f32.powf(-exponent);
    if exponent < 0.0 {
        (value * inverse).round() / inverse
    } else {
        let step = inverse.recip();
        (value / step).round() * step
    }
}

/// The majorant in the unit of the extinction: what free flights are sampled from where density is largest.
fn paint_majorant(
    ui: &Ui,
    painter: &egui::Painter,
    axes: &Axes,
    spectrum: &Spectrum,
    majorant: &MajorantDoc,
) {
    let palette = Palette::get(ui);
    let lambdas: Vec<f32> = (0..=94_u16).map(|i| LAMBDA_MIN_NM + 5.0 * f32::from(i)).collect();
    let values: Vec<f32> = lambdas.iter().map(|l| spectrum.at(*l)).collect();
    let largest = values.iter().copied().fold(0.0, f32::max);
    let line: Vec<Pos2> = lambdas
        .iter()
        .zip(&values)
        .map(|(l, v)| axes.point(*l, majorant.factor * if majorant.shared { largest } else { *v }))
        .collect();
    let colour = if majorant.factor < 1.0 { palette.warning } else { palette.accent };
    let clipped = painter.with_clip_rect(axes.frame);
    clipped.extend(Shape::dashed_line(&line, Stroke::new(1.2, colour), 5.0, 4.0));
    let at = axes.frame.right_top() + vec2(-5.0, 2.0);
    let font = egui::FontId::proportional(11.5);
    clipped.text(at, egui::Align2::RIGHT_TOP, "- - majorant μ", font, colour);
}

/// One point on the plot; returns whether it is being dragged.
fn grip_ui(
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
    let max = field.max.unwrap_or(f32::MAX);
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }
    if response.dragged()
        && let Some(p) = response.interact_pointer_pos()
    {
        let to = at(p);
        let to = ControlPoint { value: to.value.min(axes.top), ..to };
        model::shift(points, index, to, max);
    }
    let delete = response.has_focus()
        && ui.input_mut(|i| {
            i.consume_key(egui::Modifiers::NONE, Key::Delete)
                || i.consume_key(egui::Modifiers::NONE, Key::Backspace)
        });
    if response.secondary_clicked() || delete {
        model::remove(points, index);
    } else if response.has_focus() {
        nudge(ui, &response, axes, points, index, max);
    }
    paint_grip(ui, &response, centre);
    let text = format!("{} nm: {}", format_number(point.lambda_nm.into()), format_number(point.value.into()));
    let dragged = response.dragged();
    response.on_hover_and_drag_cursor(CursorIcon::Move).on_hover_text(text);
    dragged
}

/// Arrow keys move a focused point; Shift makes it ten times finer.
fn nudge(ui: &Ui, response: &Response, axes: &Axes, points: &mut [ControlPoint], index: usize, max: f32) {
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
        model::shift(points, index, to, max);
    }
}

fn paint_grip(ui: &Ui, response: &Response, centre: Pos2) {
    let palette = Palette::get(ui);
    let hot = response.hovered() || response.dragged();
    let radius = if hot { 5.5 } else { 4.5 };
    let fill = if hot || response.has_focus() { palette.accent } else { palette.well };
    ui.painter().circle(centre, radius, fill, Stroke::new(1.6, palette.accent));
}

/// Exact numbers: a table, the same as text, and what holds beyond the ends.
fn points_ui(ui: &mut Ui, field: &SpectrumField<'_>, doc: &mut SpectrumDoc) {
    let SpectrumDoc::Points { points, outside } = doc else { return };
    row(ui, "Beyond the ends", "What the spectrum is outside its first and last point", |ui, _| {
        let options =
            [(Outside::Hold, "Hold", "The value of the nearest end"), (Outside::Zero, "Zero", "Nothing")];
        segmented(ui, &format!("{} beyond the ends", field.name), outside, &options);
    });
    let title = RichText::new(format!("{} points as numbers", points.len())).small();
    egui::CollapsingHeader::new(title).id_salt("numbers").show_unindented(ui, |ui| {
        let mut removed = None;
        let count = points.len();
        for index in 0..count {
            let Some(mut point) = points.get(index).copied() else { continue };
            let before = point;
            let name = format!("{} point {}", field.name, index + 1);
            ui.horizontal(|ui| {
                let half = (ui.available_width() - 40.0) * 0.5;
                number(ui, half, &mut point.lambda_nm, "nm", 0.5, &format!("{name} wavelength"));
                number(ui, half, &mut point.value, field.unit, 0.01, &format!("{name} value"));
                let button = ui.add_enabled(count > 1, Button::new("×").small());
                if button
                    .on_hover_text("Remove this point")
                    .accessible_name(format!("Remove {name}"))
                    .clicked()
                {
                    removed = Some(index);
                }
            });
            if point != before {
                model::shift(points, index, point, field.max.unwrap_or(f32::MAX));
            }
        }
        if let Some(index) = removed {
            model::remove(points, index);
        }
        points_text_ui(ui, field, points);
    });
}

fn number(ui: &mut Ui, width: f32, value: &mut f32, unit: &str, speed: f64, name: &str) {
    let drag = egui::DragValue::new(value)
        .speed(speed)
        .update_while_editing(false)
        .min_size(vec2(width, ui.spacing().interact_size.y))
        .custom_formatter(|v, _| format_number(v))
        .custom_parser(|text| super::parse_number(text, unit))
        .suffix(format!(" {unit}"));
    ui.add(drag).accessible_name(name);
}

fn points_text_ui(ui: &mut Ui, field: &SpectrumField<'_>, points: &mut Vec<ControlPoint>) {
    let id = ui.make_persistent_id("text");
    let mut text = SpectrumDoc::format_points(points);
    let problem = id.with("problem");
    let response =
        buffered_text(ui, id, &format!("{} points as text", field.name), "430:8, 540:40", &mut text, 1);
    if response.changed() {
        ui.data_mut(|d| d.remove::<String>(problem));
        match SpectrumDoc::parse_points(&text) {
            Ok(parsed) => *points = parsed,
            Err(message) => {
                ui.data_mut(|d| d.insert_temp(problem, message));
            }
        }
    }
    if let Some(message) = ui.data(|d| d.get_temp::<String>(problem)) {
        callout(ui, Palette::get(ui).error, &message);
    }
}

#[cfg(test)]
mod tests {
    use super::tidy;

    #[test]
    fn dragged_values_are_tidy() {
        assert_eq!(tidy(0.123_456, 1.0), 0.123);
        assert_eq!(tidy(39.987, 50.0), 40.0);
        assert_eq!(tidy(1234.0, 5000.0), 1230.0);
    }
}
