//! Radiance along one row of pixels, in all views and the reference.

use super::plots::{legend, plot};
use super::{Cx, Tab, empty};
use crate::theme::{Palette, view_colour};
use crate::view::tone_mapper::PictureId;
use egui::{RichText, Ui};
use egui_plot::{FilledArea, Line, PlotPoints, VLine};
use majorant_core::compare::label;
use std::fmt::Write;

/// Tab of a row of pixels.
pub struct Scanline;

/// Row of an image: mean over the channels, and its standard error where it is known.
struct Row {
    name: String,
    view: Option<usize>,
    grey: Vec<f64>,
    error: Vec<f64>,
}

fn average(rgb: &[f32; 3]) -> f64 {
    rgb.iter().map(|x| f64::from(*x)).sum::<f64>() / 3.0
}

/// Index of the picked row, or of the middle row.
fn row(cx: &Cx<'_>) -> usize {
    cx.wall.picked.map_or(cx.doc.film.height as usize / 2, |[_, y]| y)
}

fn rows(cx: &Cx<'_>) -> Vec<Row> {
    let y = row(cx);
    let experiment = cx.wall.experiment();
    let mut rows = Vec::new();
    let line = |pixels: &[[f32; 3]], width: usize| -> Option<Vec<f64>> {
        Some(pixels.get(y * width..(y + 1) * width)?.iter().map(average).collect())
    };
    for (number, view) in &experiment.views {
        let s = &view.snapshot;
        if let (Some(grey), Some(error)) = (line(&s.mean, s.width), line(&s.standard_error, s.width)) {
            rows.push(Row { name: label(*number), view: Some(*number), grey, error });
        }
    }
    if cx.wall.pictures_shown().contains(&PictureId::Reference)
        && let Some(reference) = &experiment.reference
        && let Some(grey) = line(reference.mean(), reference.width)
    {
        rows.push(Row { name: "reference".into(), view: None, grey, error: Vec::new() });
    }
    rows
}

impl Tab for Scanline {
    fn id(&self) -> &'static str {
        "scanline"
    }
    fn title(&self) -> &'static str {
        "Scanline"
    }
    fn for_one_view(&self) -> bool {
        true
    }
    fn csv(&self, cx: &mut Cx<'_>) -> Option<String> {
        let rows = rows(cx);
        let mut text = String::from("view,y,x,grey,standard_error\n");
        for line in &rows {
            for (x, value) in line.grey.iter().enumerate() {
                let error = line.error.get(x).copied().unwrap_or(0.0);
                // Writing to a string cannot fail.
                let _ = writeln!(text, "{},{},{x},{value},{error}", line.name, row(cx));
            }
        }
        (!rows.is_empty()).then_some(text)
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        let rows = rows(cx);
        if rows.is_empty() {
            return empty(ui, "The first samples are being rendered.");
        }
        let palette = Palette::get(ui);
        let text = format!(
            "Row {}; click a pixel to choose another. Mean over channels, ± one standard error.",
            row(cx)
        );
        ui.label(RichText::new(text).small().color(palette.weak));
        let picked = cx.wall.picked;
        plot("scanline", ui, ("column", "radiance"), (false, false)).legend(legend()).show(ui, |plot| {
            for line in &rows {
                let colour = line.view.map_or(palette.strong, view_colour);
                let xs: Vec<f64> = (0..line.grey.len()).map(|x| x as f64 + 0.5).collect();
                if line.error.iter().all(|e| e.is_finite()) && !line.error.is_empty() {
                    let bound = |sign: f64| {
                        line.grey.iter().zip(&line.error).map(|(g, e)| g + sign * e).collect::<Vec<f64>>()
                    };
                    let band = FilledArea::new(line.name.clone(), &xs, &bound(-1.0), &bound(1.0));
                    plot.add(band.fill_color(colour.gamma_multiply(0.15)).allow_hover(false));
                }
                let points: PlotPoints<'_> = xs.iter().zip(&line.grey).map(|(x, y)| [*x, *y]).collect();
                plot.line(Line::new(line.name.clone(), points).color(colour).width(1.4));
            }
            if let Some([x, _]) = picked {
                plot.vline(VLine::new("", x as f64 + 0.5).color(palette.weak).allow_hover(false));
            }
        });
    }
}
