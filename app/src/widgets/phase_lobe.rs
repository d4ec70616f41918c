//! Polar plot of a phase function, for light incident from the left.

use crate::theme::Palette;
use egui::{Align2, FontId, Mesh, Painter, Pos2, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2};
use majorant_core::phase::Phase;
use std::f32::consts::{PI, TAU};

/// Decades of the logarithmic radius.
const DECADES: f32 = 3.0;
const SAMPLES: u16 = 720;

/// Draws the lobe. With `logarithmic`, the radius covers three decades below the largest value.
pub fn phase_lobe(ui: &mut Ui, phase: &Phase, logarithmic: bool) {
    let palette = Palette::get(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 168.0), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Phase function lobe"));
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 2.0, palette.well);
    let values: Vec<(f32, f32)> = (0..=SAMPLES)
        .map(|i| TAU * f32::from(i) / f32::from(SAMPLES))
        .map(|angle| (angle, phase.value(angle.cos())))
        .collect();
    let largest = values.iter().map(|(_, p)| *p).fold(f32::MIN_POSITIVE, f32::max);
    let radius = |p: f32| match logarithmic {
        true => (1.0 + (p / largest).max(1e-9).log10() / DECADES).max(0.0),
        false => p / largest,
    };
    let curve: Vec<_> = values.iter().map(|(a, p)| vec2(a.cos(), -a.sin()) * radius(*p)).collect();
    // The extent includes the lobe, the origin, the isotropic circle and the arrow.
    let round = radius(1.0 / (4.0 * PI)).min(1.0);
    let left = curve.iter().map(|v| v.x).fold(-round, f32::min) - 0.3;
    let right = curve.iter().map(|v| v.x).fold(round, f32::max);
    let half = curve.iter().map(|v| v.y.abs()).fold(round.max(0.05), f32::max);
    // Margins for the lines of text above and below.
    let scale = ((rect.width() - 24.0) / (right - left)).min((rect.height() - 44.0) / (2.0 * half));
    let origin = pos2(rect.center().x - 0.5 * (left + right) * scale, rect.center().y);
    let outline: Vec<Pos2> = curve.iter().map(|v| origin + *v * scale).collect();

    let isotropic = round * scale;
    let circle: Vec<Pos2> = values.iter().map(|(a, _)| origin + vec2(a.cos(), a.sin()) * isotropic).collect();
    painter.extend(Shape::dashed_line(&circle, Stroke::new(1.0, palette.line), 3.0, 3.0));
    fill(&painter, origin, &outline, palette.accent.gamma_multiply(0.22));
    painter.add(Shape::line(outline, Stroke::new(1.6, palette.accent)));
    let tail = pos2(rect.left() + 10.0, origin.y);
    let tip = origin - vec2(5.0, 0.0);
    painter.line_segment([tail, tip], Stroke::new(1.4, palette.text));
    let head = [tip, tip + vec2(-8.0, -3.5), tip + vec2(-8.0, 3.5)];
    painter.add(Shape::convex_polygon(head.to_vec(), palette.text, Stroke::NONE));
    painter.circle_filled(origin, 2.5, palette.strong);
    let text = |at, align, text: String| {
        painter.text(at, align, text, FontId::proportional(12.0), palette.weak);
    };
    text(rect.left_top() + vec2(8.0, 5.0), Align2::LEFT_TOP, "incident light".into());
    let mean = format!("mean cosine {}", signed(phase.mean_cosine()));
    text(rect.right_top() + vec2(-8.0, 5.0), Align2::RIGHT_TOP, mean);
    let peak = format!("largest {largest:.3} /sr");
    text(rect.right_bottom() + vec2(-8.0, -5.0), Align2::RIGHT_BOTTOM, peak);
    text(rect.left_bottom() + vec2(8.0, -5.0), Align2::LEFT_BOTTOM, "dashed: isotropic".into());
    response.on_hover_text("p(cos θ) by direction; its integral over the sphere is 1");
}

/// Formats a number with three decimals and a sign; zero has no sign.
fn signed(value: f32) -> String {
    let text = format!("{value:+.3}");
    if text.ends_with("0.000") { "0".into() } else { text.replace('-', "−") }
}

/// Fills the lobe. It is star-shaped about its origin, so that a triangle fan covers it even if not convex.
fn fill(painter: &Painter, origin: Pos2, outline: &[Pos2], colour: egui::Color32) {
    let mut mesh = Mesh::default();
    mesh.colored_vertex(origin, colour);
    for (i, p) in (1_u32..).zip(outline) {
        mesh.colored_vertex(*p, colour);
        if i > 1 {
            mesh.add_triangle(0, i - 1, i);
        }
    }
    painter.add(mesh);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mean_of_zero_has_no_sign() {
        assert_eq!(signed(-1e-9), "0");
        assert_eq!(signed(0.5), "+0.500");
        assert_eq!(signed(-0.47), "−0.470");
    }
}
