//! Progress, cost and limits of the render.

use super::{Column, Cx, Panel};
use crate::lab::stats::{count, duration};
use crate::lab::{Command, Latency};
use crate::theme::Palette;
use crate::widgets::{Value, badge, callout, format_number, hint, key, optional_key, row};
use egui::{Align2, Button, Color32, RichText, Role, Sense, TextStyle, Ui, WidgetInfo, vec2};
use majorant_core::film::Snapshot;
use majorant_core::scene::Limits;
use majorant_core::session::{Ending, Status};
use std::sync::Arc;

/// See the [module](self).
pub struct Render;

impl Panel for Render {
    fn id(&self) -> &'static str {
        "render"
    }
    fn title(&self) -> &'static str {
        "Render"
    }
    fn column(&self) -> Column {
        Column::Method
    }
    fn starts_open(&self) -> bool {
        true
    }
    fn summary(&self, cx: &Cx<'_>) -> String {
        format!("{} spp", cx.stats.spp)
    }
    fn alert(&self, cx: &Cx<'_>, palette: &Palette) -> Option<Color32> {
        let failed = matches!(cx.state.status, Status::Failed(_)) || cx.stats.non_finite > 0;
        failed.then_some(palette.error)
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        buttons_ui(ui, cx);
        progress_ui(ui, cx);
        figures_ui(ui, cx);
        trouble_ui(ui, cx);
        hint(ui, &stops_at(&cx.draft.render.limits(), cx.stats.relative_error));
        limits_ui(ui, cx);
        latency_ui(ui, cx.latency);
    }
}

fn buttons_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    let paused = cx.paused;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let width = (ui.available_width() - 8.0) / 3.0;
        let mut button = |ui: &mut Ui, on: bool, text: &str, tip: &str, command: Command| {
            let button = Button::new(text).min_size(vec2(width, 24.0));
            if ui.add_enabled(on, button).on_hover_text(tip).on_disabled_hover_text(tip).clicked() {
                cx.commands.push(command);
            }
        };
        let text = if paused { "Resume" } else { "Pause" };
        let tip = "Pause all views and the reference after the running pass, or let all go on  (P)";
        button(ui, paused || cx.unfinished, text, tip, Command::TogglePause);
        let tip = "While paused: one sample per pixel of all views and the reference  (.)";
        button(ui, paused && cx.unfinished, "Step", tip, Command::Step);
        button(ui, true, "Restart", "Start all views over from sample 0  (R)", Command::Restart);
    });
}

fn progress_ui(ui: &mut Ui, cx: &Cx<'_>) {
    let palette = Palette::get(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 6.0), Sense::hover());
    ui.painter().rect_filled(rect, 3.0, palette.well);
    let colour = match cx.state.status {
        Status::Finished if cx.state.ending.and_then(Ending::warning).is_some() => palette.warning,
        Status::Finished => palette.good,
        Status::Failed(_) => palette.error,
        Status::Paused => palette.warning,
        Status::Empty | Status::Building | Status::Rendering => palette.accent,
    };
    let progress = cx.stats.progress.unwrap_or(0.0);
    ui.painter().rect_filled(rect.with_max_x(egui::lerp(rect.x_range(), progress)), 3.0, colour);
    response.on_hover_text("Progress to the nearest limit");
}

fn figures_ui(ui: &mut Ui, cx: &Cx<'_>) {
    let stats = cx.stats;
    let optional = |value: Option<f64>| value.map_or_else(|| "–".into(), count);
    let limit = cx.draft.render.spp.map_or_else(String::new, |limit| format!(" / {limit}"));
    let unknown = if cx.draft.render.limits().are_none() { "no limit" } else { "–" };
    let eta = stats.eta_seconds.map_or_else(|| unknown.into(), duration);
    let figures = [
        ("Samples", format!("{}{limit}", stats.spp), "Samples per pixel in the picture"),
        ("Rate", format!("{} spp/s", optional(stats.spp_per_second)), "Samples per pixel and second"),
        (
            "Look-ups/s",
            optional(stats.lookups_per_second),
            "Evaluations of the medium's coefficients per second",
        ),
        (
            "Look-ups/path",
            optional(stats.lookups_per_path),
            "Look-ups per path: what the majorant and the estimator cost",
        ),
        ("Time", duration(stats.seconds), "Time spent rendering, pauses left out"),
        ("Left", eta, "Estimated time to the nearest limit"),
    ];
    ui.add_space(2.0);
    let width = (ui.available_width() / 3.0).floor();
    for line in figures.chunks(3) {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            for (label, value, tip) in line {
                figure_ui(ui, width, label, value, tip);
            }
        });
    }
}

/// A number under its label.
fn figure_ui(ui: &mut Ui, width: f32, label: &str, value: &str, tip: &str) {
    let palette = Palette::get(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(width, 36.0), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("{label}: {value}")));
    let text = |at, align, text: &str, style: TextStyle, colour| {
        ui.painter().text(at, align, text, style.resolve(ui.style()), colour);
    };
    text(rect.left_top(), Align2::LEFT_TOP, label, TextStyle::Small, palette.weak);
    text(
        rect.left_bottom() - vec2(0.0, 2.0),
        Align2::LEFT_BOTTOM,
        value,
        TextStyle::Monospace,
        palette.strong,
    );
    response.on_hover_text(tip);
}

/// The picture of what was submitted last.
fn picture<'a>(cx: &Cx<'a>) -> Option<&'a Arc<Snapshot>> {
    cx.state.snapshot.as_ref().filter(|s| s.generation == cx.state.generation)
}

fn trouble_ui(ui: &mut Ui, cx: &Cx<'_>) {
    let palette = Palette::get(ui);
    if cx.stats.non_finite > 0 {
        let located = picture(cx).map(|s| s.tally.located.as_slice()).unwrap_or_default();
        let places: Vec<String> =
            located.iter().map(|n| format!("pixel ({}, {}), sample {}", n.x, n.y, n.sample)).collect();
        let tip = format!("Left out of the picture, never hidden. First of them:\n{}", places.join("\n"));
        badge(ui, palette.error, &format!("{} samples not finite", cx.stats.non_finite)).on_hover_text(tip);
    }
    if let Some(warning) = cx.state.ending.and_then(Ending::warning) {
        callout(ui, palette.warning, warning);
    }
    for notice in &cx.state.notices {
        callout(ui, palette.warning, notice);
    }
}

/// How soon the window answers.
fn latency_ui(ui: &mut Ui, latency: &Latency) {
    let title = RichText::new("Latency").small();
    egui::CollapsingHeader::new(title).id_salt("latency").show_unindented(ui, |ui| {
        let rows = [
            (
                "First picture",
                latency.first_picture(),
                "From an edit to the first frame that shows it, over the last 32 edits",
            ),
            (
                "Cancelled",
                latency.cancellation(),
                "From an edit to the moment when no worker traces the old scene any more",
            ),
            (
                "Window",
                latency.frames(),
                "The window's own part of a frame, without the rasteriser, over the last 120 frames",
            ),
        ];
        for (name, recent, tip) in rows {
            let text = recent.map_or_else(
                || "–".into(),
                |r| {
                    let ms = |seconds: f64| 1e3 * seconds;
                    format!("{:.1} ms, worst {:.1} ms", ms(r.median), ms(r.worst))
                },
            );
            row(ui, name, tip, |ui, _| {
                ui.monospace(text).on_hover_text(format!("Median and worst. {tip}"));
            });
        }
    });
}

/// When it stops, by all limits that hold: whichever comes first.
fn stops_at(limits: &Limits, relative_error: Option<f64>) -> String {
    let number = |x: f32| format_number(x.into());
    let now = relative_error.filter(|e| e.is_finite());
    let now = now.map_or_else(String::new, |e| format!(" (now {:.2} %)", 100.0 * e));
    let all = [
        limits.spp.map(|n| format!("{n} spp")),
        limits.seconds.map(|s| format!("{} s", number(s))),
        limits.cpu_seconds.map(|s| format!("{} s of CPU time", number(s))),
        limits.relative_error.map(|e| format!("an error of {} %{now}", format_number(100.0 * f64::from(e)))),
    ];
    let all: Vec<String> = all.into_iter().flatten().collect();
    match all.split_last() {
        None => "Goes on until it is paused: there is no limit.".into(),
        Some((only, [])) => format!("Stops at {only}."),
        Some((last, others)) => format!("Stops at {} or {last}, whichever comes first.", others.join(", ")),
    }
}

fn limits_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    let title = RichText::new("Limits, threads, seed").small();
    egui::CollapsingHeader::new(title).id_salt("limits").show_unindented(ui, |ui| {
        let (render, opened) = (&mut cx.draft.render, &cx.opened.render);
        let spp = (&mut render.spp, opened.spp);
        optional_key(ui, key("render.spp"), spp, 1024, "no sample limit", |v| v.within(1.0..=1e9));
        let seconds = (&mut render.seconds, opened.seconds);
        optional_key(ui, key("render.seconds"), seconds, 60.0, "no time limit", |v| {
            v.within(0.1..=1e6).logarithmic()
        });
        let tip = "Rendering stops after so much CPU time of path tracing, all workers together: what --seconds of \
                   `majorant compare` gives every estimator";
        let seconds = (&mut render.cpu_seconds, opened.cpu_seconds);
        optional_key(ui, key("render.cpu_seconds"), seconds, 60.0, "no limit of CPU time", |v| {
            v.tip(tip).within(0.1..=1e6).logarithmic()
        });
        let tip = "Rendering stops when the standard error of a pixel, root mean square, is this share of the image's \
                   mean: 0.01 is 1 %. The error is estimated from the samples themselves: paths too rare to have come \
                   yet are not in it";
        let error = (&mut render.relative_error, opened.relative_error);
        optional_key(ui, key("render.relative_error"), error, 0.01, "no error limit", |v| {
            v.tip(tip).within(1e-5..=1.0).logarithmic()
        });
        let threads = (&mut render.threads, opened.threads);
        optional_key(ui, key("render.threads"), threads, 1, "one per core", |v| v);
        Value::of(key("render.seed"), &mut render.seed).opened(opened.seed).within(0.0..=9e15).show(ui);
        if let Some(snapshot) = picture(cx) {
            let cpu = duration(snapshot.cpu_seconds);
            hint(ui, &format!("{} threads, {cpu} of CPU time.", snapshot.threads));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_limit_that_holds_is_named() {
        assert!(stops_at(&Limits::default(), None).contains("no limit"));
        assert_eq!(stops_at(&Limits::samples(64), None), "Stops at 64 spp.");
        let limits =
            Limits { spp: Some(64), seconds: Some(2.5), cpu_seconds: Some(20.0), relative_error: Some(0.01) };
        assert_eq!(
            stops_at(&limits, Some(0.034)),
            "Stops at 64 spp, 2.5 s, 20 s of CPU time or an error of 1 % (now 3.40 %), whichever comes first."
        );
        let only = Limits { cpu_seconds: Some(20.0), ..Limits::default() };
        assert_eq!(stops_at(&only, None), "Stops at 20 s of CPU time.");
    }
}
