//! Samples of one pixel in every view: histogram and convergence of the mean.
//!
//! Samples are retraced, not stored: random numbers are a function of (seed, pixel, sample).

use super::plots::{legend, plot};
use super::{Cx, Tab, empty};
use crate::theme::{Palette, view_colour};
use egui::{RichText, Ui};
use egui_plot::{Bar, BarChart, FilledArea, Line, PlotPoints};
use majorant_core::compare::label;
use majorant_core::session::PixelSample;
use std::fmt::Write;

/// Tab of the samples of a pixel.
pub struct Pixel;

fn grey(sample: &PixelSample) -> f64 {
    sample.rgb.iter().map(|x| f64::from(*x)).sum::<f64>() / 3.0
}

impl Tab for Pixel {
    fn id(&self) -> &'static str {
        "pixel"
    }
    fn title(&self) -> &'static str {
        "Pixel"
    }
    fn for_one_view(&self) -> bool {
        true
    }
    fn csv(&self, cx: &mut Cx<'_>) -> Option<String> {
        let (at, views) = cx.wall.analysis().pixel.clone()?;
        let mut text = String::from("view,x,y,sample,r,g,b,lookups\n");
        for view in &views {
            for (i, s) in view.samples.iter().enumerate() {
                let [r, g, b] = s.rgb;
                // Writing to a string cannot fail.
                let _ =
                    writeln!(text, "{},{},{},{i},{r},{g},{b},{}", label(view.view), at[0], at[1], s.lookups);
            }
        }
        Some(text)
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        let analysis = cx.wall.analysis().clone();
        let picked = cx.wall.picked;
        let found = analysis
            .pixel
            .as_ref()
            .filter(|(at, views)| Some(*at) == picked && views.iter().any(|v| !v.samples.is_empty()));
        let Some((at, views)) = found else {
            let text = if picked.is_some() {
                "The samples of the pixel are being retraced."
            } else {
                "Click a pixel of an image to retrace its samples, identical to those of the image."
            };
            return empty(ui, text);
        };
        ui.horizontal(|ui| {
            let palette = Palette::get(ui);
            ui.label(RichText::new(format!("Pixel ({}, {})", at[0], at[1])).small().color(palette.strong));
            for view in views {
                let (mean, error, largest) = summary(&view.samples);
                let text =
                    format!("{}  {mean:.4} ± {error:.4}, largest {largest:.1} × mean", label(view.view));
                ui.label(
                    RichText::new(text)
                        .small()
                        .color(view_colour(view.view).lerp_to_gamma(palette.strong, 0.35)),
                );
            }
        });
        let height = ui.available_height();
        ui.columns(2, |columns| {
            for column in columns.iter_mut() {
                column.set_height(height);
            }
            histogram_ui(&mut columns[0], views);
            history_ui(&mut columns[1], views);
        });
    }
}

/// Mean, standard error of the mean, and ratio of the largest sample to the mean.
fn summary(samples: &[PixelSample]) -> (f64, f64, f64) {
    let n = samples.len() as f64;
    let mean = samples.iter().map(grey).sum::<f64>() / n;
    let variance = samples.iter().map(|s| (grey(s) - mean).powi(2)).sum::<f64>() / (n - 1.0);
    let largest = samples.iter().map(grey).fold(0.0, f64::max);
    (mean, (variance / n).sqrt(), if mean > 0.0 { largest / mean } else { 0.0 })
}

/// Histogram bins per decade.
const PER_DECADE: f64 = 5.0;

/// Draws a histogram of the samples, both axes logarithmic: a heavy tail decays slowly to the right.
fn histogram_ui(ui: &mut Ui, views: &[crate::wall::analysis::PixelSamples]) {
    plot("histogram", ui, ("sample (grey)", "share"), (true, true)).legend(legend()).show(ui, |plot| {
        for view in views {
            let total = view.samples.len().max(1) as f64;
            let mut bins = std::collections::BTreeMap::<i64, u32>::new();
            let mut zeros = 0;
            for value in view.samples.iter().map(grey) {
                if value > 0.0 && value.is_finite() {
                    *bins.entry((value.log10() * PER_DECADE).floor() as i64).or_default() += 1;
                } else {
                    zeros += 1;
                }
            }
            let floor = -(total.log10()) - 0.3;
            let name = format!("{}, {:.0} % zero", label(view.view), 100.0 * f64::from(zeros) / total);
            let bars = bins.iter().map(|(bin, n)| {
                let share = (f64::from(*n) / total).log10();
                let middle = (*bin as f64 + 0.5) / PER_DECADE;
                Bar::new(middle, share - floor).base_offset(floor).width(0.9 / PER_DECADE)
            });
            let colour = view_colour(view.view);
            plot.bar_chart(BarChart::new(name, bars.collect()).color(colour.gamma_multiply(0.55)));
        }
    });
}

/// Draws the running means with their standard errors.
fn history_ui(ui: &mut Ui, views: &[crate::wall::analysis::PixelSamples]) {
    plot("history", ui, ("samples", "mean ± SE"), (true, false)).legend(legend()).show(ui, |plot| {
        for view in views {
            let (mut n, mut mean, mut m2, mut next) = (0.0f64, 0.0f64, 0.0f64, 1.0f64);
            let (mut xs, mut ys, mut errors) = (Vec::new(), Vec::new(), Vec::new());
            for value in view.samples.iter().map(grey).filter(|v| v.is_finite()) {
                n += 1.0;
                let delta = value - mean;
                mean += delta / n;
                m2 += delta * (value - mean);
                if n >= next {
                    next = (n * 1.05).max(n + 1.0);
                    xs.push(n.log10());
                    ys.push(mean);
                    errors.push(if n > 1.0 { (m2 / (n * (n - 1.0))).sqrt() } else { 0.0 });
                }
            }
            let colour = view_colour(view.view);
            let name = label(view.view);
            let bound = |sign: f64| ys.iter().zip(&errors).map(|(y, e)| y + sign * e).collect::<Vec<f64>>();
            if xs.len() > 1 {
                let band = FilledArea::new(name.clone(), &xs, &bound(-1.0), &bound(1.0));
                plot.add(band.fill_color(colour.gamma_multiply(0.18)).allow_hover(false));
            }
            let points: PlotPoints<'_> = xs.iter().zip(&ys).map(|(x, y)| [*x, *y]).collect();
            plot.line(Line::new(name, points).color(colour).width(1.8));
        }
    });
}
