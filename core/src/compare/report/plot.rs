//! Log-log SVG plots of error against samples or seconds.

use super::gather::Gathered;
use super::words;
use crate::compare::curve::{Axis, Point, PowerLaw};
use crate::compare::view_colour;
use plotters::prelude::*;
use serde::Serialize;

/// Colour of a view, by its index.
fn colour(place: usize) -> RGBColor {
    let [r, g, b] = view_colour(place);
    RGBColor(r, g, b)
}

/// Colour of a view in CSS notation.
pub(super) fn css_colour(place: usize) -> String {
    let RGBColor(r, g, b) = colour(place);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Placeholder colours that are replaced by the colours of the page, light or dark.
const INK: RGBColor = RGBColor(1, 2, 3);
const RULE: RGBColor = RGBColor(4, 5, 6);

/// A plot with its legend.
#[derive(Serialize)]
pub(super) struct Plot {
    pub axis: &'static str,
    pub svg: String,
    pub legend: Vec<Entry>,
    /// Description of the dashed line.
    pub guide: String,
}

/// A line of a plot.
#[derive(Serialize)]
pub(super) struct Entry {
    pub label: String,
    pub name: String,
    pub colour: String,
    /// The fitted slope as text.
    pub slope: String,
}

const SIZE: (u32, u32) = (560, 380);

/// Draws the error of every view along an axis; `None` if no curve has two points.
pub(super) fn plot(gathered: &Gathered<'_>, axis: Axis) -> Option<Plot> {
    let curves: Vec<Vec<Point>> = gathered.views.iter().map(|v| v.curve(gathered.measure, axis)).collect();
    if curves.iter().all(|c| c.len() < 2) {
        return None;
    }
    let mut svg = String::new();
    draw(&mut svg, &curves, gathered, axis)?;
    let svg = svg
        .replace("fill=\"#010203\"", "fill=\"currentColor\"")
        .replace("stroke=\"#010203\"", "stroke=\"currentColor\"")
        .replace("stroke=\"#040506\"", "class=\"rule\" stroke=\"#999\"");
    let legend = gathered.views.iter().zip(&curves).zip(&gathered.standings).enumerate();
    let legend = legend.map(|(place, ((_, curve), standing))| Entry {
        label: standing.label.clone(),
        name: standing.name.clone(),
        colour: css_colour(place),
        slope: PowerLaw::fit(curve, axis).map_or_else(|| "–".into(), |law| slope(&law)),
    });
    let guide = format!("slope {}", fixed(gathered.measure.slope));
    Some(Plot { axis: axis.name(), svg, legend: legend.collect(), guide })
}

fn fixed(x: f64) -> String {
    format!("{x:.2}").trim_end_matches('0').trim_end_matches('.').replace('-', "−")
}

fn slope(law: &PowerLaw) -> String {
    let places = if law.slope_error < 0.01 { 3 } else { 2 };
    let error = Some(law.slope_error).filter(|e| e.is_finite());
    let error = error.map_or_else(String::new, |e| format!(" ± {:.places$}", e.max(0.001)));
    format!("{:.places$}{error}", law.slope).replace('-', "−")
}

/// Range of positive values, with a margin.
fn around(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let (lo, hi) = values.fold((f64::INFINITY, 0.0f64), |(lo, hi), x| (lo.min(x), hi.max(x)));
    (lo.is_finite() && hi > 0.0).then(|| {
        let margin = (hi / lo).powf(0.05).max(1.2);
        (lo / margin, hi * margin)
    })
}

/// Ticks of a logarithmic axis: decades, and 2 and 5 in between on short axes.
fn ticks((lo, hi): (f64, f64)) -> Vec<f64> {
    let decades = lo.log10().floor() as i32..=hi.log10().ceil() as i32;
    let few = (hi / lo).log10() < 2.5;
    let steps: &[f64] = if few { &[1.0, 2.0, 5.0] } else { &[1.0] };
    let all = decades.flat_map(|d| steps.iter().map(move |s| s * 10f64.powi(d)));
    all.filter(|x| (lo..=hi).contains(x)).collect()
}

fn draw(svg: &mut String, curves: &[Vec<Point>], gathered: &Gathered<'_>, axis: Axis) -> Option<()> {
    let points = || curves.iter().flatten();
    let (x, y) = (around(points().map(|p| p.at(axis)))?, around(points().map(|p| p.value))?);
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    let mut chart = ChartBuilder::on(&root)
        .margin(8)
        .x_label_area_size(46)
        .y_label_area_size(74)
        .build_cartesian_2d(
            (x.0..x.1).log_scale().with_key_points(ticks(x)),
            (y.0..y.1).log_scale().with_key_points(ticks(y)),
        )
        .ok()?;
    let text = |size: i32| ("sans-serif", size).into_font().color(&INK);
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(RULE)
        .axis_style(INK)
        .label_style(text(14))
        .axis_desc_style(text(15))
        .x_desc(axis.name())
        .y_desc(gathered.measure.name)
        .x_label_formatter(&|x| words::tick(*x))
        .y_label_formatter(&|y| words::tick(*y))
        .draw()
        .ok()?;
    // The guide starts at the first point of the first curve.
    let first = curves.iter().find_map(|c| c.first())?;
    let law = |along: f64| first.value * (along / first.at(axis)).powf(gathered.measure.slope);
    let steps = (0..=60).map(|i| x.0 * (x.1 / x.0).powf(f64::from(i) / 60.0));
    let guide = steps.map(|along| (along, law(along))).filter(|(_, v)| (y.0..=y.1).contains(v));
    chart.draw_series(DashedLineSeries::new(guide, 5, 4, INK.stroke_width(1))).ok()?;
    for (place, curve) in curves.iter().enumerate() {
        let line = curve.iter().map(|p| (p.at(axis), p.value));
        chart.draw_series(LineSeries::new(line.clone(), colour(place).stroke_width(2))).ok()?;
        chart.draw_series(line.map(|at| Circle::new(at, 3, colour(place).filled()))).ok()?;
    }
    drop(chart);
    root.present().ok()?;
    drop(root);
    Some(())
}
