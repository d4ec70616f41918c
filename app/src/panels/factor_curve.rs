//! Plots of look-ups, variance and bias against the majorant's factor.

use super::Cx;
use crate::model::Command;
use crate::theme::{Palette, UNIT, view_colour};
use crate::widgets::{callout, format_number, hint};
use egui::{Button, CollapsingHeader, Color32, Rangef, RichText, Ui};
use egui_plot::{
    AxisHints, FilledArea, GridInput, GridMark, HLine, Line, Plot, PlotPoints, VLine, uniform_grid_spacer,
};
use majorant_core::bench::{FACTORS, FactorPoint};

const NOTHING: &str = "Nothing to compare: the image is black, or has no noise.";
const HEIGHT: f32 = 120.0;
/// Larger ratios are clipped, because they would compress the plot.
const MOST_RATIO: f64 = 1e3;
const MOST_BIAS: f64 = 20.0;
/// Minimum width of the value axis, so that both plots are aligned.
const AXIS: f32 = 34.0;

/// Shows the plots and the button that starts a measurement.
pub(super) fn factor_curve_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    CollapsingHeader::new(RichText::new("Cost and bias by factor").small()).show_unindented(ui, |ui| {
        let curve = cx.factor_curve;
        ui.horizontal(|ui| {
            let (text, command) = match curve.is_running() {
                true => ("Stop", Command::CancelFactorCurve),
                false => ("Measure", Command::MeasureFactorCurve),
            };
            if ui
                .add(Button::new(text))
                .on_hover_text("Renders a small image of this scene at every factor")
                .clicked()
            {
                cx.commands.push(command);
            }
            let palette = Palette::get(ui);
            let state = match (curve.is_running(), curve.points().len()) {
                (true, 0) => "measuring the reference".to_owned(),
                (true, n) => format!("{n} of {} factors", FACTORS.len()),
                (false, 0) => "not measured yet".to_owned(),
                (false, _) if curve.is_of(cx.draft) => "of this scene, this estimator".to_owned(),
                (false, _) => "of another scene or estimator".to_owned(),
            };
            ui.label(RichText::new(state).small().color(palette.weak));
        });
        if let Some(error) = curve.error() {
            callout(ui, Palette::get(ui).error, error);
        }
        let points = curve.points();
        if !points.is_empty() && !curve.is_of(cx.draft) {
            hint(ui, "The measurement belongs to another scene or estimator, and is shown again with that one. Measure again.");
            return;
        }
        let Some(one) = points.iter().find(|p| p.factor == 1.0) else {
            if points.is_empty() {
                hint(ui, "Above 1, look-ups are spent on null collisions; below 1, noise or bias increases.");
            }
            return;
        };
        // Ratios to zero are undefined.
        if !(one.variance > 0.0 && one.variance.is_finite()) {
            hint(ui, NOTHING);
            return;
        }
        let factor = cx.draft.medium_at(cx.medium).majorant.factor;
        relative_ui(ui, points, one, factor);
        bias_ui(ui, points, factor);
    });
}

fn log2(factor: f32) -> f64 {
    f64::from(factor).log2()
}

/// Creates a small plot over the logarithm of the factor; its legend is shown above. `value` converts a
/// height to the displayed number.
fn plot(id: &str, value: fn(f64) -> f64) -> Plot<'static> {
    Plot::new(id.to_owned())
        .height(HEIGHT)
        .include_x(log2(FACTORS[0]) - 0.2)
        .include_x(log2(FACTORS[FACTORS.len() - 1]) + 0.2)
        // A labelled grid line at every power of two.
        .x_grid_spacer(uniform_grid_spacer(|_| [1.0, 1.0, 1.0]))
        .custom_x_axes(vec![
            AxisHints::new_x()
                .formatter(|mark, _| format!("{}×", 2f64.powf(mark.value.round())))
                .label_spacing(Rangef::new(16.0, 24.0)),
        ])
        .custom_y_axes(vec![
            AxisHints::new_y()
                .formatter(move |mark, _| format_number(value(mark.value)))
                .label_spacing(Rangef::new(9.0, 13.0))
                .min_thickness(AXIS),
        ])
        .show_x(false)
        .allow_scroll(false)
        .allow_drag(false)
        .allow_zoom(false)
}

/// Shows a legend: names in the colours of their lines.
fn names(ui: &mut Ui, names: &[(&str, Color32)]) {
    ui.add_space(UNIT);
    ui.horizontal_wrapped(|ui| {
        for (name, colour) in names {
            ui.label(RichText::new(*name).small().color(*colour));
        }
    });
}

/// Grid marks at 1, 2 and 5 times the powers of ten, for an axis of logarithms.
fn one_two_five(input: GridInput) -> Vec<GridMark> {
    let mark = |power: i32, digit: f64| GridMark {
        value: (digit * 10f64.powi(power)).log10(),
        step_size: if digit == 1.0 { 1.0 } else { 0.3 },
    };
    let (from, to) = input.bounds;
    let marks = (-3..=3).flat_map(|power| [1.0, 2.0, 5.0].map(|digit| mark(power, digit)));
    marks.filter(|mark| (from..=to).contains(&mark.value)).collect()
}

/// Plots look-ups, variance and their product, relative to factor 1.
fn relative_ui(ui: &mut Ui, points: &[FactorPoint], one: &FactorPoint, factor: f32) {
    type Quantity = (&'static str, fn(&FactorPoint) -> f64);
    const QUANTITIES: [Quantity; 3] = [
        ("look-ups", |p| p.lookups_per_path),
        ("variance", |p| p.variance),
        ("their product", |p| p.lookups_per_path * p.variance),
    ];
    let weak = Palette::get(ui).weak;
    let [a, b, c] = QUANTITIES.map(|(name, _)| name);
    names(ui, &[(a, view_colour(5)), (b, view_colour(4)), (c, view_colour(2)), ("relative to 1×", weak)]);
    plot("factor cost", |height| 10f64.powf(height)).y_grid_spacer(one_two_five).show(ui, |plot| {
        for ((name, of), colour) in QUANTITIES.into_iter().zip([5, 4, 2].map(view_colour)) {
            let at = |p: &FactorPoint| {
                [log2(p.factor), (of(p) / of(one)).clamp(1.0 / MOST_RATIO, MOST_RATIO).log10()]
            };
            let line: PlotPoints<'_> = points.iter().map(at).collect();
            plot.line(Line::new(name, line).color(colour).width(1.8));
        }
        plot.vline(VLine::new("now", log2(factor)).color(weak));
    });
}

/// Plots the error of the mean, with the band that contains 95 % of unbiased estimates.
fn bias_ui(ui: &mut Ui, points: &[FactorPoint], factor: f32) {
    let palette = Palette::get(ui);
    let (weak, error) = (palette.weak, palette.error);
    names(ui, &[("bias of the mean, %", error), ("95 % by chance", weak)]);
    plot("factor bias", |height| height).show(ui, |plot| {
        let xs: Vec<f64> = points.iter().map(|p| log2(p.factor)).collect();
        let band = |sign: f64| -> Vec<f64> {
            points.iter().map(|p| sign * (196.0 * p.bias_error).min(MOST_BIAS)).collect()
        };
        if points.len() > 1 {
            let area = FilledArea::new("chance", &xs, &band(-1.0), &band(1.0));
            plot.add(area.fill_color(weak.gamma_multiply(0.25)).allow_hover(false));
        }
        let line: PlotPoints<'_> =
            points.iter().map(|p| [log2(p.factor), (100.0 * p.bias).clamp(-MOST_BIAS, MOST_BIAS)]).collect();
        plot.line(Line::new("bias", line).color(error).width(1.8));
        plot.hline(HLine::new("zero", 0.0).color(weak).allow_hover(false));
        plot.vline(VLine::new("now", log2(factor)).color(weak));
    });
}
