//! Samples of a pixel sorted by radiance, and the search for an outlier pixel.

use super::super::Cx;
use crate::theme::Palette;
use crate::wall::Wall;
use egui::{Button, RichText, ScrollArea, Ui};
use majorant_core::film::Snapshot;

/// Maximum number of listed samples.
const LISTED: usize = 400;

/// Indices and mean radiances of the selected view's samples of a pixel, brightest first.
pub(super) fn sorted(wall: &Wall, pixel: [usize; 2]) -> Vec<(u64, f32)> {
    let analysis = wall.analysis();
    let Some((at, views)) = &analysis.pixel else { return Vec::new() };
    let view = views.iter().find(|v| *at == pixel && v.view == wall.selected());
    let Some(view) = view else { return Vec::new() };
    let grey = |rgb: [f32; 3]| rgb.iter().sum::<f32>() / 3.0;
    let mut samples: Vec<_> = view.samples.iter().enumerate().map(|(i, s)| (i as u64, grey(s.rgb))).collect();
    samples.sort_by(|a, b| b.1.total_cmp(&a.1));
    samples.truncate(LISTED);
    samples
}

pub(super) fn list_ui(ui: &mut Ui, cx: &mut Cx<'_>, pixel: [usize; 2], samples: &[(u64, f32)], chosen: u64) {
    let palette = Palette::get(ui);
    ui.label(RichText::new("brightest first").small().color(palette.weak));
    let height = ui.text_style_height(&egui::TextStyle::Small) + 4.0;
    ScrollArea::vertical().auto_shrink(false).show_rows(ui, height, samples.len(), |ui, rows| {
        for (sample, grey) in &samples[rows] {
            let text = format!("{sample:>5} {grey:>9.4}");
            let on = *sample == chosen;
            let colour = if on { palette.strong } else { palette.text };
            let button = Button::selectable(on, RichText::new(text).small().monospace().color(colour));
            let response = ui.add(
                button
                    .wrap_mode(egui::TextWrapMode::Extend)
                    .min_size(egui::vec2(ui.available_width(), height)),
            );
            response.widget_info(|| {
                egui::WidgetInfo::selected(egui::Role::Button, true, on, format!("Sample {sample}"))
            });
            if response.clicked() {
                cx.inspector.path.choose(pixel, *sample);
            }
        }
    });
}

/// Pixel of the selected view that exceeds the median of its eight neighbours by most.
pub(super) fn outlier(wall: &Wall) -> Option<[usize; 2]> {
    outlier_of(wall.selected_slot()?.picture()?)
}

fn outlier_of(snapshot: &Snapshot) -> Option<[usize; 2]> {
    let (width, height) = (snapshot.width, snapshot.height);
    let grey = |x: usize, y: usize| snapshot.mean[y * width + x].iter().sum::<f32>();
    let mut largest = (0.0f32, None);
    for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
        let mut around = Vec::with_capacity(8);
        for (dy, dx) in (0..3usize).flat_map(|dy| (0..3usize).map(move |dx| (dy, dx))) {
            let (near_x, near_y) = ((x + dx).checked_sub(1), (y + dy).checked_sub(1));
            if let (Some(near_x), Some(near_y)) = (near_x, near_y)
                && (near_x, near_y) != (x, y)
                && near_x < width
                && near_y < height
            {
                around.push(grey(near_x, near_y));
            }
        }
        around.sort_by(f32::total_cmp);
        let median = around.get(around.len() / 2).copied().unwrap_or(0.0);
        let beyond = grey(x, y) - median;
        if beyond > largest.0 {
            largest = (beyond, Some([x, y]));
        }
    }
    largest.1
}
