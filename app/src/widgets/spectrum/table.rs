//! Table of the control points, as numbers and as text.

use super::{SpectrumField, model};
use crate::theme::Palette;
use crate::widgets::callout;
use crate::widgets::choice::segmented;
use crate::widgets::number::{format_number, parse_number};
use crate::widgets::row::row;
use crate::widgets::text::buffered_text;
use egui::{Button, RichText, Ui, vec2};
use majorant_core::spectrum::{ControlPoint, Outside, SpectrumDoc};

/// Draws the extrapolation mode, the table of points, and the points as text.
pub(super) fn points_ui(ui: &mut Ui, field: &SpectrumField<'_>, doc: &mut SpectrumDoc) {
    let SpectrumDoc::Points { points, outside } = doc else { return };
    row(ui, "Beyond the ends", "Value of the spectrum outside of the first and last point", |ui, _| {
        let options =
            [(Outside::Hold, "Hold", "Value of the nearest end point"), (Outside::Zero, "Zero", "Zero")];
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
                number(ui, half, &mut point.value, field.key.unit, 0.01, &format!("{name} value"));
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
                model::shift(points, index, point, field.values());
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
        .custom_parser(|text| parse_number(text, unit))
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
        let [least, most] = field.values();
        match SpectrumDoc::parse_points(&text) {
            Ok(parsed) if parsed.iter().all(|p| (least..=most).contains(&p.value)) => *points = parsed,
            Ok(_) => {
                let message = format!("values must lie between {least} and {most}");
                ui.data_mut(|d| d.insert_temp(problem, message));
            }
            Err(message) => {
                ui.data_mut(|d| d.insert_temp(problem, message));
            }
        }
    }
    if let Some(message) = ui.data(|d| d.get_temp::<String>(problem)) {
        callout(ui, Palette::get(ui).error, &message);
    }
}
