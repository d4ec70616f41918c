//! Plot of a spectrum: curve, control points, and the majorant over an extinction.

use super::axes::Axes;
use super::{SpectrumField, grip, model};
use crate::theme::Palette;
use egui::{Id, Pos2, Role, Sense, Shape, Stroke, Ui, WidgetInfo, vec2};
use majorant_core::scene::MajorantDoc;
use majorant_core::spectrum::{ControlPoint, LAMBDA_MAX_NM, LAMBDA_MIN_NM, Outside, Spectrum, SpectrumDoc};

/// Height of the plot's frame, in points.
const FRAME: f32 = 104.0;

/// Draws the plot, on which points are added, dragged and removed.
pub(super) fn plot_ui(ui: &mut Ui, field: &SpectrumField<'_>, doc: &mut SpectrumDoc) {
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
        let ((lambda, value), [least, most]) = (axes.value(p), field.values());
        ControlPoint { lambda_nm: lambda.round(), value: tidy(value, axes.top).clamp(least, most) }
    };
    let mut edit: Option<(Vec<ControlPoint>, Outside)> = None;
    // A preceding click turns the double click into a triple click.
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
            dragging |= grip::grip_ui(ui, field, &axes, id.with(("grip", index)), &mut edited, index, &at);
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

/// Top of the value axis. It is fixed while a point is dragged, because rescaling would move the point.
fn plot_top(ui: &Ui, id: Id, field: &SpectrumField<'_>, doc: &SpectrumDoc, spectrum: &Spectrum) -> f32 {
    if let Some(held) = ui.data(|d| d.get_temp::<f32>(id)) {
        return held;
    }
    if let Some(max) = field.max() {
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

/// Rounds to the resolution of the mouse: the power of ten below a three hundredth of the axis.
fn tidy(value: f32, top: f32) -> f32 {
    let exponent = (top / 300.0).log10().floor();
    // Division by an integer is exact for decimals, multiplication by 0.1 is not.
    let inverse = 10_f32.powf(-exponent);
    if exponent < 0.0 {
        (value * inverse).round() / inverse
    } else {
        let step = inverse.recip();
        (value / step).round() * step
    }
}

/// Draws the majorant in the unit of the extinction, at the maximum of the density.
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
