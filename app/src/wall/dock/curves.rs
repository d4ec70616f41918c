//! Error curves: error against samples, CPU seconds or look-ups.

use super::plots::{legend, plot};
use super::{Cx, Tab, empty};
use crate::theme::{Palette, view_colour};
use crate::wall::analysis::settled_law;
use egui::{RichText, Ui};
use egui_plot::{FilledArea, Line, LineStyle, PlotPoint, PlotPoints, Points};
use majorant_core::compare::curve::{Axis, Point, PowerLaw};
use majorant_core::compare::label;
use majorant_core::scene::ReferenceDoc;
use std::fmt::Write;

/// Tab of the error curves.
pub struct Curves;

impl Tab for Curves {
    fn id(&self) -> &'static str {
        "curves"
    }
    fn title(&self) -> &'static str {
        "Error curves"
    }
    fn csv(&self, cx: &mut Cx<'_>) -> Option<String> {
        let analysis = cx.wall.analysis();
        let measure = analysis.measure?;
        let mut text = format!("view,spp,cpu_seconds,lookups_per_pixel,{},error\n", measure.id);
        for curve in &analysis.curves {
            for p in &curve.points {
                let [spp, seconds, lookups] = p.along;
                // Writing to a string cannot fail.
                let _ =
                    writeln!(text, "{},{spp},{seconds},{lookups},{},{}", label(curve.view), p.value, p.error);
            }
        }
        analysis.curves.iter().any(|c| !c.points.is_empty()).then_some(text)
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        let analysis = cx.wall.analysis().clone();
        let usable = |p: &&Point| p.value > 0.0 && p.along.iter().all(|x| *x > 0.0);
        let curves: Vec<(usize, Vec<Point>)> = analysis
            .curves
            .iter()
            .map(|c| (c.view, c.points.iter().filter(usable).copied().collect::<Vec<_>>()))
            .filter(|(_, points)| !points.is_empty())
            .collect();
        let Some(measure) = analysis.measure.filter(|_| !curves.is_empty()) else {
            let text = match cx.doc.compare.reference {
                ReferenceDoc::None => "Errors need a reference: choose one above.",
                ReferenceDoc::Pooled => {
                    "No errors yet: the other unbiased views are too noisy, or there is none."
                }
                _ => "The reference has no image yet.",
            };
            return empty(ui, text);
        };
        let id = ui.unique_id().with("axis");
        let mut axis = ui.data(|d| d.get_temp::<Axis>(id)).unwrap_or_default();
        ui.horizontal(|ui| {
            ui.label(RichText::new("Against").small().color(Palette::get(ui).weak));
            for option in Axis::ALL {
                if ui.selectable_label(axis == option, RichText::new(option.name()).small()).clicked() {
                    axis = option;
                }
            }
            let note =
                "Bands: 95 % confidence from the scatter over pixels. Dashed: slope of unbiased estimates.";
            ui.label(RichText::new(note).small().color(Palette::get(ui).weak));
        });
        ui.data_mut(|d| d.insert_temp(id, axis));
        let palette = Palette::get(ui);
        plot("curves", ui, (axis.name(), measure.name), (true, true)).legend(legend()).show(ui, |plot| {
            for (view, points) in &curves {
                let colour = view_colour(*view);
                let law = settled_law(points, axis);
                let slope = law.map_or_else(String::new, |l: PowerLaw| format!("  slope {:+.2}", l.slope));
                let name = format!("{}{slope}", label(*view));
                let xs: Vec<f64> = points.iter().map(|p| p.at(axis).log10()).collect();
                let bound = |sign: f64| -> Vec<f64> {
                    points
                        .iter()
                        .map(|p| (p.value + sign * 1.96 * p.error).max(0.1 * p.value).log10())
                        .collect()
                };
                if points.iter().all(|p| p.error.is_finite()) && points.len() > 1 {
                    let band = FilledArea::new(name.clone(), &xs, &bound(-1.0), &bound(1.0));
                    plot.add(band.fill_color(colour.gamma_multiply(0.22)).allow_hover(false));
                }
                let line: PlotPoints<'_> =
                    points.iter().map(|p| [p.at(axis).log10(), p.value.log10()]).collect();
                plot.line(Line::new(name.clone(), line).color(colour).width(1.8));
                let dots: PlotPoints<'_> =
                    points.iter().map(|p| [p.at(axis).log10(), p.value.log10()]).collect();
                plot.points(Points::new(name, dots).color(colour).radius(2.5).allow_hover(false));
            }
            if let Some(guide) = guide(&curves, axis, measure.slope) {
                let line = PlotPoints::Owned(guide);
                let style = LineStyle::dashed_loose();
                let name = format!("guide, slope {}", measure.slope);
                plot.line(Line::new(name, line).color(palette.weak).style(style).allow_hover(false));
            }
        });
    }
}

/// Line with the slope of unbiased estimates, through the end of the first curve.
fn guide(curves: &[(usize, Vec<Point>)], axis: Axis, slope: f64) -> Option<Vec<PlotPoint>> {
    let all = || curves.iter().flat_map(|(_, points)| points).map(|p| p.at(axis).log10());
    let (from, to) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
    let last = curves.first()?.1.last()?;
    let at = |x: f64| PlotPoint::new(x, last.value.log10() + slope * (x - last.at(axis).log10()));
    Some(vec![at(from), at(to)])
}
