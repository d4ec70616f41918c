//! Axes, curve and colour strip of a spectrum plot.

use crate::theme::Palette;
use crate::widgets::number::format_number;
use egui::{Align2, Color32, FontId, Mesh, Painter, Pos2, Rect, Rgba, Shape, Stroke, Ui, pos2, vec2};
use majorant_core::spectrum::{LAMBDA_MAX_NM, LAMBDA_MIN_NM, Spectrum, wavelength_colour};

/// Height of the colour strip, in points.
const STRIP: f32 = 6.0;
/// Height of the tick labels, in points.
const TICKS: f32 = 15.0;

/// Mapping between spectrum values and screen points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axes {
    /// Frame of the plot, without strip and ticks.
    pub frame: Rect,
    /// Value at the top of the frame.
    pub top: f32,
}

impl Axes {
    /// Total height of a plot whose frame is `frame` points high.
    #[must_use]
    pub fn height(frame: f32) -> f32 {
        frame + STRIP + TICKS
    }

    /// Creates axes inside a rectangle, whose height should be [`Self::height`].
    #[must_use]
    pub fn within(rect: Rect, top: f32) -> Self {
        Self { frame: rect.with_max_y(rect.bottom() - STRIP - TICKS), top }
    }

    /// Screen point of a wavelength and a value.
    #[must_use]
    pub fn point(&self, lambda_nm: f32, value: f32) -> Pos2 {
        let x = (lambda_nm - LAMBDA_MIN_NM) / (LAMBDA_MAX_NM - LAMBDA_MIN_NM);
        // Margin of four points, so that markers at zero and at the top are not clipped.
        let inner = self.frame.shrink2(vec2(0.0, 4.0));
        pos2(
            egui::lerp(self.frame.x_range(), x),
            egui::remap(value, 0.0..=self.top, inner.bottom()..=inner.top()),
        )
    }

    /// Wavelength and value of a screen point.
    #[must_use]
    pub fn value(&self, at: Pos2) -> (f32, f32) {
        let inner = self.frame.shrink2(vec2(0.0, 4.0));
        (
            egui::remap(at.x, self.frame.x_range(), LAMBDA_MIN_NM..=LAMBDA_MAX_NM),
            egui::remap(at.y, inner.bottom()..=inner.top(), 0.0..=self.top),
        )
    }

    /// Draws frame, grid, colour strip and tick labels.
    pub fn paint(&self, ui: &Ui, painter: &Painter) {
        let palette = Palette::get(ui);
        painter.rect_filled(self.frame, 2.0, palette.well);
        let faint = Stroke::new(1.0, palette.line.gamma_multiply(0.7));
        let font = FontId::monospace(10.5);
        for lambda in [400_u16, 500, 600, 700, 800].map(f32::from) {
            let x = self.point(lambda, 0.0).x;
            painter.vline(x, self.frame.y_range(), faint);
            let y = self.frame.bottom() + STRIP + 2.0;
            // The last tick label has the unit and is aligned with the frame.
            let (at, align, text) = match lambda < 800.0 {
                true => (pos2(x, y), Align2::CENTER_TOP, format!("{lambda}")),
                false => (pos2(self.frame.right(), y), Align2::RIGHT_TOP, format!("{lambda} nm")),
            };
            painter.text(at, align, text, font.clone(), palette.weak);
        }
        painter.hline(self.frame.x_range(), self.point(400.0, 0.5 * self.top).y, faint);
        let label = |value: f32, align, y| {
            let text = format_number(f64::from(value));
            painter.text(pos2(self.frame.left() + 4.0, y), align, text, font.clone(), palette.weak);
        };
        label(self.top, Align2::LEFT_TOP, self.frame.top() + 1.0);
        label(0.5 * self.top, Align2::LEFT_BOTTOM, self.point(400.0, 0.5 * self.top).y);
        painter.add(strip(Rect::from_min_size(self.frame.left_bottom(), vec2(self.frame.width(), STRIP))));
    }

    /// Draws the curve of a spectrum, filled below with the colours of the wavelengths.
    pub fn paint_curve(&self, painter: &Painter, spectrum: &Spectrum, colour: Color32) {
        let count = 128_u16;
        let mut mesh = Mesh::default();
        let mut line = Vec::with_capacity(usize::from(count) + 1);
        for i in 0..=count {
            let t = f32::from(i) / f32::from(count);
            let lambda = egui::lerp(LAMBDA_MIN_NM..=LAMBDA_MAX_NM, t);
            let top = self.point(lambda, spectrum.at(lambda).clamp(0.0, self.top * 1.1));
            line.push(top);
            let tint = colour_of(lambda).gamma_multiply(0.28);
            let base = u32::from(i) * 2;
            mesh.colored_vertex(top, tint);
            mesh.colored_vertex(pos2(top.x, self.frame.bottom()), tint);
            if i > 0 {
                mesh.add_triangle(base - 2, base - 1, base);
                mesh.add_triangle(base - 1, base, base + 1);
            }
        }
        painter.add(mesh);
        painter.add(Shape::line(line, Stroke::new(1.6, colour)));
    }
}

/// Display colour of a wavelength.
fn colour_of(lambda_nm: f32) -> Color32 {
    let [r, g, b] = wavelength_colour(lambda_nm);
    Rgba::from_rgb(r, g, b).into()
}

/// Mesh of the colour strip.
fn strip(rect: Rect) -> Mesh {
    let mut mesh = Mesh::default();
    let count = 94_u16;
    for i in 0..=count {
        let t = f32::from(i) / f32::from(count);
        let colour = colour_of(egui::lerp(LAMBDA_MIN_NM..=LAMBDA_MAX_NM, t));
        let x = egui::lerp(rect.x_range(), t);
        let base = u32::from(i) * 2;
        mesh.colored_vertex(pos2(x, rect.top()), colour);
        mesh.colored_vertex(pos2(x, rect.bottom()), colour);
        if i > 0 {
            mesh.add_triangle(base - 2, base - 1, base);
            mesh.add_triangle(base - 1, base, base + 1);
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_are_invertible() {
        let rect = Rect::from_min_size(pos2(10.0, 20.0), vec2(300.0, Axes::height(100.0)));
        let axes = Axes::within(rect, 50.0);
        assert!((axes.frame.height() - 100.0).abs() < 1e-4);
        let (lambda, value) = axes.value(axes.point(540.0, 40.0));
        assert!((lambda - 540.0).abs() < 1e-2 && (value - 40.0).abs() < 1e-2);
    }
}
