//! Transmittance along a ray: the ray of a pixel or an analytic shape, with any transmittance estimator.

use super::plots::{key_ui, plot};
use super::{Cx, Tab, empty};
use crate::theme::{Palette, view_colour};
use crate::wall::Wall;
use crate::wall::caption::digits;
use crate::wall::inspector::{RayQuestion, RayState, Through};
use egui::{Button, ComboBox, DragValue, RichText, Ui};
use egui_plot::{Bar, BarChart, Line, LineStyle, PlotPoints, Points, VLine};
use glam::Vec2;
use majorant_core::inspect::{Along, BenchPlan, RayBench};
use majorant_core::scene::Mode;
use majorant_core::transmittance::{Shape, TransmittanceKind};
use std::fmt::Write;
use std::sync::Arc;

/// Tab of transmittance along a ray.
pub struct Ray;

/// Number of estimates in the histogram.
const ESTIMATES: u64 = 20_000;
const BINS: usize = 48;

impl Tab for Ray {
    fn id(&self) -> &'static str {
        "ray"
    }

    fn title(&self) -> &'static str {
        "Ray"
    }

    fn share(&self) -> f32 {
        0.52
    }

    fn for_one_view(&self) -> bool {
        true
    }

    fn csv(&self, cx: &mut Cx<'_>) -> Option<String> {
        let bench = bench(cx, None)?;
        let mut text = String::from("estimate\n");
        for estimate in &bench.estimates {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{estimate}");
        }
        Some(text)
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        controls_ui(ui, cx);
        if cx.inspector.ray.through == Through::Pixel && cx.wall.picked.is_none() {
            return empty(ui, "Click a pixel of an image, or choose a shape.");
        }
        let Some(bench) = bench(cx, Some(ui.ctx().clone())) else {
            let built = cx.wall.selected_slot().is_some_and(|slot| slot.probe().is_some());
            let missed = built && !cx.inspector.ray.query.is_running();
            return empty(
                ui,
                if missed { "This ray misses the medium." } else { "The transmittance is being estimated." },
            );
        };
        numbers_ui(ui, &bench);
        let height = ui.available_height();
        // The last tick label extends beyond the axis.
        ui.set_max_width(ui.available_width() - 14.0);
        ui.columns(3, |columns| {
            for column in columns.iter_mut() {
                column.set_height(height);
            }
            extinction_ui(&mut columns[0], &bench);
            transmittance_ui(&mut columns[1], &bench);
            histogram_ui(&mut columns[2], &bench);
        });
    }
}

fn controls_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    let mode = cx.doc.view_doc(cx.wall.selected()).map_or(Mode::Spectral, |doc| doc.estimator.mode);
    let state = &mut cx.inspector.ray;
    ui.horizontal_wrapped(|ui| {
        let through = [("the pixel's ray", Through::Pixel)].into_iter();
        let shapes = Shape::ALL.iter().map(|shape| (shape.name(), Through::Shape(*shape)));
        for (name, choice) in through.chain(shapes) {
            let on = state.through == choice;
            let response = ui.add(Button::selectable(on, RichText::new(name).small()));
            response.widget_info(|| {
                egui::WidgetInfo::selected(egui::Role::Button, true, on, format!("Through {name}"))
            });
            if response.clicked() {
                state.through = choice;
            }
        }
        ui.separator();
        let kind = state.kind();
        let combo = ComboBox::from_id_salt("kind").selected_text(RichText::new(kind.entry().name).small());
        let combo = combo.show_ui(ui, |ui| {
            for kind in TransmittanceKind::all() {
                let entry = kind.entry();
                let name =
                    if entry.unbiased { entry.name.to_owned() } else { format!("{} (biased)", entry.name) };
                let on = state.kind().entry().id == entry.id;
                let tip = format!("{}\n\n{}\n\n{}", entry.formula, entry.summary, entry.cost);
                if ui.selectable_label(on, name).on_hover_text(tip).clicked() {
                    state.kind = Some(kind);
                }
            }
        });
        combo.response.accessible_name("Estimator of transmittance");
        if state.through == Through::Pixel {
            component_ui(ui, state, mode);
        }
        if state.through != Through::Pixel {
            shape_ui(ui, state);
        }
        let again = Button::new(RichText::new("Another").small());
        if ui.add(again).on_hover_text("Shows the steps of another estimate").clicked() {
            state.example += 1;
        }
        if state.query.is_running() {
            ui.spinner();
        }
    });
}

/// Draws the labelled parameters of a shape.
fn shape_ui(ui: &mut Ui, state: &mut RayState) {
    let weak = Palette::get(ui).weak;
    let number = |ui: &mut Ui, text: &str, name: &str, value: DragValue<'_>| {
        ui.label(RichText::new(text).small().color(weak));
        ui.add(value).accessible_name(name);
    };
    let extinction = DragValue::new(&mut state.extinction).range(0.1..=40.0).speed(0.05);
    number(ui, "μ", "Largest extinction", extinction);
    let cells = DragValue::new(&mut state.cells).range(1..=64).speed(0.1);
    number(ui, "cells", "Cells of the majorant", cells);
    let factor = DragValue::new(&mut state.factor).range(0.3..=10.0).speed(0.01);
    number(ui, "majorant ×", "Majorant over the bound", factor);
}

fn component_ui(ui: &mut Ui, state: &mut RayState, mode: Mode) {
    match mode {
        Mode::Spectral => {
            let value = DragValue::new(&mut state.lambda_nm).range(380.0..=780.0).speed(1.0).suffix(" nm");
            ui.add(value)
                .accessible_name("Wavelength")
                .on_hover_text("Wavelength at which the extinction is evaluated");
        }
        Mode::Rgb => {
            for (channel, name) in ["R", "G", "B"].into_iter().enumerate() {
                let on = state.channel == channel;
                if ui.add(Button::selectable(on, RichText::new(name).small())).clicked() {
                    state.channel = channel;
                }
            }
        }
    }
}

/// Measurement that the controls describe; `None` if a pixel's ray is chosen, but no pixel is picked or the
/// scene is still being built.
pub(crate) fn question(wall: &Wall, state: &RayState) -> Option<RayQuestion> {
    let slot = wall.selected_slot()?;
    let mode = slot.rendered.estimator.mode;
    let plan =
        BenchPlan { kind: state.kind(), estimates: ESTIMATES, seed: 1, example: state.example % ESTIMATES };
    let component = match mode {
        Mode::Spectral => state.lambda_nm,
        Mode::Rgb => state.channel as f32,
    };
    let of_pixel = state.through == Through::Pixel;
    let shape = [state.extinction, state.cells as f32, state.factor];
    Some(RayQuestion {
        of: if of_pixel {
            slot.probe().map(|_| Some((wall.selected(), slot.state.generation)))?
        } else {
            None
        },
        pixel: if of_pixel { Some(wall.picked?) } else { None },
        through: state.through,
        numbers: if of_pixel { [component, 0.0, 0.0] } else { shape },
        plan,
    })
}

/// Returns the measured ray. It is measured again if its inputs have changed and `wake` is given.
fn bench(cx: &mut Cx<'_>, wake: Option<egui::Context>) -> Option<Arc<RayBench>> {
    let question = question(cx.wall, &cx.inspector.ray)?;
    let slot = cx.wall.selected_slot()?;
    let (mode, probe) = (slot.rendered.estimator.mode, slot.probe().cloned());
    let RayQuestion { through, pixel, plan, numbers: [component, ..], .. } = question;
    let state = &mut cx.inspector.ray;
    let (extinction, cells, majorant_factor) = (state.extinction, state.cells, state.factor);
    let wake = move || {
        if let Some(ctx) = &wake {
            ctx.request_repaint();
        }
    };
    let answer = state.query.ask(&question, wake, move |cancel| {
        let along = match through {
            Through::Shape(shape) => Along::Shape { shape, extinction, cells, majorant_factor },
            Through::Pixel => {
                let [x, y] = pixel?;
                let probe = probe.as_ref()?;
                let scene = probe.scene();
                let ray = scene.camera.ray(Vec2::new(x as f32 + 0.5, y as f32 + 0.5));
                Along::Medium { scene, ray, mode, component }
            }
        };
        RayBench::new(&along, &plan, cancel)
    });
    answer.filter(|(_, current)| *current).map(|(bench, _)| bench)
}

/// Draws exact value, mean and cost in one line.
fn numbers_ui(ui: &mut Ui, bench: &RayBench) {
    let palette = Palette::get(ui);
    let [mean, error] = bench.mean;
    let z = if error > 0.0 { (mean - bench.truth()) / error } else { 0.0 };
    let n = bench.estimates.len();
    let text = format!(
        "T = {:.5}      mean of {n} estimates {mean:.5} ± {error:.5}      {z:+.1} σ      {:.2} look-ups each",
        bench.truth(),
        bench.lookups
    );
    let colour = if z.abs() > 4.0 { palette.error } else { palette.strong };
    ui.label(RichText::new(text).small().color(colour))
        .on_hover_text("Beyond ±4 σ the mean is wrong: the estimator is biased, or the majorant does not bound the extinction");
}

fn curve<'a>(name: &'a str, points: &[[f32; 2]]) -> Line<'a> {
    let points: PlotPoints<'_> = points.iter().map(|[t, v]| [f64::from(*t), f64::from(*v)]).collect();
    Line::new(name, points).width(1.6)
}

/// Majorants as a step function, zero between the cells.
fn stairs(bench: &RayBench) -> Vec<[f32; 2]> {
    let mut stairs = vec![[0.0, 0.0]];
    let mut end = 0.0;
    for [t0, t1, majorant] in &bench.majorants {
        // Adjacent cells may be separated by rounding errors.
        if *t0 > end + 1e-4 * bench.length {
            stairs.extend([[end, 0.0], [*t0, 0.0]]);
        }
        stairs.extend([[*t0, *majorant], [*t1, *majorant]]);
        end = *t1;
    }
    stairs.extend([[end, 0.0], [bench.length, 0.0]]);
    // A line between identical points has no direction.
    stairs.dedup();
    stairs
}

fn extinction_ui(ui: &mut Ui, bench: &RayBench) {
    let palette = Palette::get(ui);
    let names = [("extinction", palette.accent), ("majorant", palette.warning), ("look-ups", palette.strong)];
    key_ui(ui, &names);
    plot("extinction", ui, ("t", "μ"), (false, false)).show(ui, |plot| {
        // One line per segment: a polyline with many right angles is drawn too thick.
        for ends in stairs(bench).windows(2) {
            plot.line(curve("majorant", ends).color(palette.warning));
        }
        plot.line(curve("extinction", &bench.extinction).color(palette.accent));
        let looks: PlotPoints<'_> =
            bench.looks.iter().map(|look| [f64::from(look.t), f64::from(look.extinction)]).collect();
        plot.points(Points::new("look-ups", looks).radius(3.5).color(palette.strong));
    });
}

fn transmittance_ui(ui: &mut Ui, bench: &RayBench) {
    let palette = Palette::get(ui);
    key_ui(ui, &[("transmittance", palette.good), ("this estimate", palette.strong)]);
    plot("transmittance", ui, ("t", "T"), (false, false)).include_y(0.0).include_y(1.0).show(ui, |plot| {
        plot.line(curve("truth", &bench.transmittance).color(palette.good));
        plot.line(curve("this estimate", &bench.running).color(palette.strong));
        for look in &bench.looks {
            let line = VLine::new("", f64::from(look.t)).color(palette.line);
            plot.vline(line.width(0.6).style(LineStyle::dashed_dense()).allow_hover(false));
        }
    });
}

fn histogram_ui(ui: &mut Ui, bench: &RayBench) {
    let palette = Palette::get(ui);
    let (lo, hi) = bench.estimates.iter().fold((0.0f32, 1.0f32), |(lo, hi), e| (lo.min(*e), hi.max(*e)));
    // A long tail would compress the histogram into one bar.
    let (lo, hi) = (lo.max(-4.0), hi.min(5.0));
    let width = f64::from(hi - lo) / BINS as f64;
    let mut counts = [0u32; BINS];
    for estimate in &bench.estimates {
        let bin = (f64::from(*estimate - lo) / width).clamp(0.0, BINS as f64 - 1.0) as usize;
        counts[bin] += 1;
    }
    let total = bench.estimates.len().max(1) as f64;
    let colour = view_colour(0).gamma_multiply(0.7);
    key_ui(ui, &[("estimates", colour), ("truth", palette.good), ("their mean", palette.strong)]);
    plot("histogram", ui, ("estimate", "share"), (false, false)).show(ui, |plot| {
        let bars = counts.iter().enumerate().filter(|(_, n)| **n > 0).map(|(i, n)| {
            Bar::new(f64::from(lo) + (i as f64 + 0.5) * width, f64::from(*n) / total).width(0.92 * width)
        });
        plot.bar_chart(BarChart::new("estimates", bars.collect()).color(colour));
        plot.vline(VLine::new("truth", bench.truth()).color(palette.good).width(1.6));
        let [mean, error] = bench.mean;
        plot.vline(VLine::new(format!("mean {}", digits(mean)), mean).color(palette.strong));
        for side in [-1.96, 1.96] {
            plot.vline(VLine::new("", mean + side * error).color(palette.weak).allow_hover(false));
        }
    });
}
