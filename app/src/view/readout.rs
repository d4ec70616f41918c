//! Pixel values as text, in the status line and on enlarged pixels.

use super::image_view::ImageView;
use egui::{Align2, Color32, FontId, Painter, Rect, Vec2, pos2};
use majorant_core::film::{Snapshot, display::DisplayTransform};
use majorant_core::scene::ViewDoc;

/// Minimum zoom at which values are printed on pixels, screen points per pixel.
const PRINTED_FROM: f32 = 56.0;

/// Formats a value with a few digits, short enough for a pixel.
#[must_use]
pub fn short(value: f32) -> String {
    let magnitude = value.abs();
    if !value.is_finite() {
        return if value.is_nan() { "NaN".into() } else { "∞".into() };
    }
    match magnitude {
        0.0 => "0".into(),
        m if !(1e-3..1e4).contains(&m) => format!("{value:.1e}"),
        m if m < 1.0 => format!("{value:.4}"),
        m if m < 100.0 => format!("{value:.3}"),
        _ => format!("{value:.1}"),
    }
}

/// Formats a pixel as `(412, 77)  R 0.213 ± 0.004  …`, without standard errors that are not finite.
#[must_use]
pub fn describe(snapshot: &Snapshot, [x, y]: [usize; 2]) -> Option<String> {
    let index = y * snapshot.width + x;
    let (mean, error) = (snapshot.mean.get(index)?, snapshot.standard_error.get(index)?);
    let channels: Vec<String> = ["R", "G", "B"]
        .iter()
        .zip(mean.iter().zip(error))
        .map(|(name, (m, e))| {
            let e = if e.is_finite() { format!(" ± {}", short(*e)) } else { String::new() };
            format!("{name} {}{e}", short(*m))
        })
        .collect();
    Some(format!("({x}, {y})   {}", channels.join("   ")))
}

/// Prints linear values on every visible pixel if the zoom is large enough.
pub fn paint_values(
    painter: &Painter,
    view: ImageView,
    canvas: Rect,
    snapshot: &Snapshot,
    display: &ViewDoc,
) {
    let image = Vec2::new(snapshot.width as f32, snapshot.height as f32);
    let zoom = view.zoom(canvas, image);
    if zoom < PRINTED_FROM {
        return;
    }
    let transform = DisplayTransform::new(display);
    let font = FontId::monospace((zoom / 6.5).min(15.0));
    let [x0, y0, x1, y1] = view.visible_pixels(canvas, image);
    for (y, x) in (y0..y1).flat_map(|y| (x0..x1).map(move |x| (y, x))) {
        let Some(mean) = snapshot.mean.get(y * snapshot.width + x) else { continue };
        let middle = view.screen_from_image(canvas, image, pos2(x as f32 + 0.5, y as f32 + 0.5));
        let [r, g, b] = transform.encode(*mean).map(f32::from);
        let bright = 0.3 * r + 0.6 * g + 0.1 * b > 120.0;
        let ink = if bright { Color32::from_black_alpha(230) } else { Color32::from_white_alpha(230) };
        for (line, value) in (-1_i8..).zip(mean) {
            let at = middle + Vec2::new(0.0, f32::from(line) * font.size * 1.25);
            painter.text(at, Align2::CENTER_CENTER, short(*value), font.clone(), ink);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_stay_short() {
        assert_eq!(short(0.0), "0");
        assert_eq!(short(0.25), "0.2500");
        assert_eq!(short(12.5), "12.500");
        assert_eq!(short(1234.5), "1234.5");
        assert_eq!(short(1.0e-5), "1.0e-5");
        assert_eq!(short(f32::NAN), "NaN");
        assert_eq!(short(f32::INFINITY), "∞");
    }
}
