//! Ranking of the views: costs, errors, variances, efficiencies with confidence intervals, and verdicts.

use super::{Cx, Tab, empty};
use crate::model::Command;
use crate::model::WallEdit;
use crate::model::stats::{count, duration};
use crate::theme::{Palette, view_colour};
use crate::wall::caption::{against, chip, digits, error_tip, not_measured, verdict};
use egui::{Align, Color32, Layout, RichText, Sense, Ui};
use egui_extras::{Column, TableBuilder};
use majorant_core::compare::report::words;
use majorant_core::compare::{ComparedWith, Standing, Verdict};
use majorant_core::measure::{Measure, Measured};
use majorant_core::scene::ReferenceDoc;
use std::fmt::Write;

/// Tab of the ranking.
pub struct Ranking;

/// Width, in points, below which the column of names is narrower.
const NARROW: f32 = 760.0;
/// Width of the columns of errors, which are omitted without a reference.
const ERRORS: f32 = 200.0;

/// Heading of a column, its tooltip, and the minimum width of the table at which it is shown.
type Heading = (&'static str, &'static str, f32);

/// Placeholder for the heading of the error column, replaced by the name of the measure.
const ERROR: &str = "error";
/// Heading of the column with the share of the reference's noise in the error.
const SHARE: &str = "ref. ±";

/// Numeric columns.
const HEADINGS: &[Heading] = &[
    ("spp", "Samples per pixel", 0.0),
    (
        "CPU s",
        "CPU seconds of path tracing, summed over all threads; film merging and statistics are not charged",
        900.0,
    ),
    ("look-ups", "Evaluations of the medium per path", 960.0),
    (ERROR, "", 0.0),
    (
        SHARE,
        "Contribution of the reference's noise to the error: the error is corrected for it, and its ± includes it in full",
        1020.0,
    ),
    ("variance", "Variance of the pixel mean, averaged over pixels and channels", 0.0),
    ("colour", "Share of the variance that is colour noise, perpendicular to grey", 840.0),
    ("efficiency", "1 / (variance · CPU seconds)", 780.0),
    (
        "speed-up",
        "Efficiency relative to the baseline, with its 95 % interval from the error of the variance and the scatter of the cost",
        0.0,
    ),
];

impl Tab for Ranking {
    fn id(&self) -> &'static str {
        "ranking"
    }
    fn title(&self) -> &'static str {
        "Ranking"
    }
    fn csv(&self, cx: &mut Cx<'_>) -> Option<String> {
        let standings = &cx.wall.analysis().standings;
        let mut text = String::from(
            "view,estimator,spp,cpu_seconds,lookups_per_path,relmse,variance,chroma_variance,efficiency,speedup,speedup_low,speedup_high,bias_z,p,verdict,relmse_error,relmse_reference_share,against\n",
        );
        for s in standings {
            // Without a reference there is no error: the cell stays empty.
            let error =
                |of: fn(&Measured) -> f64| s.error("relmse").map_or_else(String::new, |m| of(m).to_string());
            let [relmse, scatter, share] =
                [error(Measured::corrected), error(|m| m.error), error(|m| m.reference_share)];
            let against = words::against(&s.against).replace('"', "'");
            let (z, p) = s.agreement.map_or((f64::NAN, f64::NAN), |a| (a.z, a.p));
            let [lo, hi] = s.speedup_interval;
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{},{},{},{},{},{relmse},{},{},{},{},{lo},{hi},{z},{p},{},{scatter},{share},\"{against}\"",
                s.label,
                s.estimator,
                s.spp,
                s.cpu_seconds,
                s.lookups_per_path,
                s.variance,
                s.chroma_variance,
                s.efficiency,
                s.speedup,
                s.verdict()
            );
        }
        (!standings.is_empty()).then_some(text)
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        let analysis = cx.wall.analysis().clone();
        if analysis.standings.is_empty() {
            return empty(ui, "Numbers appear after three samples per pixel.");
        }
        // The view with the highest efficiency is marked if its lead is significant.
        let winner = winner(&analysis.standings).filter(|_| analysis.standings.len() == cx.doc.view_count());
        let measure = analysis.measure.filter(|_| cx.doc.compare.reference != ReferenceDoc::None);
        let row_height = 21.0 * ui.text_style_height(&egui::TextStyle::Small) / 14.0 + 2.0;
        let wide = ui.available_width() > NARROW;
        let room = ui.available_width() + if measure.is_some() { 0.0 } else { ERRORS };
        let shown = |h: &Heading| room >= h.2 && (measure.is_some() || ![ERROR, SHARE].contains(&h.0));
        let columns = HEADINGS.iter().filter(|h| shown(h)).count();
        egui::ScrollArea::horizontal().auto_shrink([false, true]).show(ui, |ui| {
            let table = TableBuilder::new(ui)
                .striped(true)
                .cell_layout(Layout::right_to_left(Align::Center))
                .column(Column::exact(28.0))
                .column(Column::auto().at_least(if wide { 170.0 } else { 104.0 }))
                .columns(Column::auto().at_least(44.0), columns - 1)
                .column(Column::auto().at_least(96.0))
                .column(Column::remainder().at_least(150.0));
            table
                .header(row_height, |mut header| {
                    heading(&mut header, "", "");
                    left_heading(&mut header, "estimator", "");
                    for (text, tip, _) in HEADINGS.iter().filter(|h| shown(h)) {
                        let (text, tip) = match measure.filter(|_| *text == ERROR) {
                            Some(m) => (m.name, m.formula),
                            None => (*text, *tip),
                        };
                        heading(&mut header, text, tip);
                    }
                    left_heading(
                        &mut header,
                        "bias",
                        "Result of the comparison with the reference, or with the other unbiased views",
                    );
                })
                .body(|mut body| {
                    for s in &analysis.standings {
                        body.row(row_height, |mut row| {
                            line(&mut row, cx, s, measure, (winner == Some(s.label.as_str()), &shown));
                        });
                    }
                });
        });
        footnote(ui, cx, &analysis.standings);
    }
}

fn heading(row: &mut egui_extras::TableRow<'_, '_>, text: &str, tip: &str) {
    row.col(|ui| heading_ui(ui, text, tip));
}

/// Heading of a left-aligned column of text.
fn left_heading(row: &mut egui_extras::TableRow<'_, '_>, text: &str, tip: &str) {
    row.col(|ui| {
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| heading_ui(ui, text, tip));
    });
}

fn heading_ui(ui: &mut Ui, text: &str, tip: &str) {
    let response = ui.label(RichText::new(text).small().color(Palette::get(ui).weak));
    if !tip.is_empty() {
        response.on_hover_text(tip);
    }
}

fn line(
    row: &mut egui_extras::TableRow<'_, '_>,
    cx: &mut Cx<'_>,
    s: &Standing,
    measure: Option<&'static Measure>,
    (wins, shown): (bool, &dyn Fn(&Heading) -> bool),
) {
    let view = (0..cx.doc.view_count()).find(|v| majorant_core::compare::label(*v) == s.label).unwrap_or(0);
    let error = measure.and_then(|m| s.error(m.id));
    let excluded = if s.excluded > 0 {
        format!("{} of {} pixels have no finite value and are excluded", s.excluded, s.pixels)
    } else {
        String::new()
    };
    let cells = [
        (count(s.spp as f64), excluded),
        (duration_short(s.cpu_seconds), duration(s.cpu_seconds)),
        (count(s.lookups_per_path), String::new()),
        (
            error.map_or_else(|| "–".into(), |e| words::quantity(e.corrected(), e.uncertainty())),
            measure.zip(error).map_or_else(
                || not_measured(s, cx.doc).unwrap_or_default().to_owned(),
                |(measure, e)| error_tip(measure, e),
            ),
        ),
        (
            error.map_or_else(|| "–".into(), |e| digits(e.reference_share)),
            error.map_or_else(String::new, |e| {
                format!("{:.0} % of the measured error", 100.0 * e.reference_share / e.value)
            }),
        ),
        (digits(s.variance), format!("± {}", digits(s.variance_error))),
        (format!("{:.0} %", 100.0 * s.chroma_variance / s.variance), digits(s.chroma_variance)),
        (digits(s.efficiency), String::new()),
    ];
    row.col(|ui| chip(ui, &s.label, view_colour(view)));
    row.col(|ui| {
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            let palette = Palette::get(ui);
            let text = RichText::new(crate::wall::caption::name(cx.doc, view)).small().color(palette.strong);
            ui.add(egui::Label::new(text).truncate().selectable(false));
            if wins {
                ui.label(RichText::new("best").small().color(palette.good))
                    .on_hover_text("Its 95 % interval of efficiency lies above those of all other views");
            }
        });
    });
    for ((text, tip), _) in cells.into_iter().zip(HEADINGS).filter(|(_, h)| shown(h)) {
        row.col(|ui| {
            let response = ui.label(RichText::new(text).monospace().size(12.0).color(Palette::get(ui).text));
            if !tip.is_empty() {
                response.on_hover_text(tip);
            }
        });
    }
    row.col(|ui| speedup_ui(ui, cx, s, view));
    row.col(|ui| {
        let (text, colour): (String, Color32) = verdict(s, Palette::get(ui));
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            ui.label(RichText::new(text).small().color(colour)).on_hover_text(against(s));
        });
    });
}

fn speedup_ui(ui: &mut Ui, cx: &mut Cx<'_>, s: &Standing, view: usize) {
    let palette = Palette::get(ui);
    let baseline = cx.doc.compare.baseline == view;
    let text = if baseline {
        RichText::new("baseline").small().color(palette.weak)
    } else {
        let [lo, hi] = s.speedup_interval;
        let sure = lo > 1.0 || hi < 1.0;
        let colour = if sure { palette.strong } else { palette.weak };
        let interval =
            if hi.is_finite() { format!(" [{}, {}]", factor(lo), factor(hi)) } else { String::new() };
        RichText::new(format!("{}×{interval}", factor(s.speedup))).monospace().size(12.0).color(colour)
    };
    let response = ui.add(egui::Label::new(text).selectable(false).sense(Sense::click()));
    if response.on_hover_text("Click to use this view as baseline").clicked() && !baseline {
        cx.commands.push(Command::Wall(WallEdit::Baseline(view)));
    }
}

/// Label of the view whose efficiency is significantly higher than that of all others.
fn winner(standings: &[Standing]) -> Option<&str> {
    if standings.len() < 2 {
        return None;
    }
    let best = standings
        .iter()
        .filter(|s| s.declared_bias.is_none() && s.verdict() != Verdict::Differs && s.speedup.is_finite())
        .max_by(|a, b| a.speedup.total_cmp(&b.speedup))?;
    let mut rivals = standings.iter().filter(|s| s.label != best.label && s.speedup.is_finite());
    let clear = rivals.all(|other| {
        // The interval of the baseline is [1, 1]: the uncertainty is in that of the other view.
        best.speedup_interval[0] > other.speedup_interval[1].max(other.speedup)
    });
    clear.then_some(best.label.as_str())
}

/// Formats a ratio with about three digits.
fn factor(ratio: f64) -> String {
    match ratio {
        r if r.is_nan() => "–".into(),
        r if r < 0.001 => format!("{r:.1e}"),
        r if r < 0.1 => format!("{r:.4}"),
        r if r < 10.0 => format!("{r:.2}"),
        r => format!("{r:.0}"),
    }
}

fn duration_short(seconds: f64) -> String {
    if seconds < 100.0 { format!("{seconds:.1}") } else { format!("{seconds:.0}") }
}

/// Draws the footnote: region, fairness, excluded pixels and reference of the table.
fn footnote(ui: &mut Ui, cx: &Cx<'_>, standings: &[Standing]) {
    use majorant_core::scene::Fairness;
    let fair = match cx.doc.compare.fairness {
        Fairness::Time => "equal CPU time",
        Fairness::Samples => "equal samples",
        Fairness::Lookups => "equal look-ups",
    };
    let place = match cx.doc.compare.region {
        Some([x0, y0, x1, y1]) => format!("the box {} × {} at ({x0}, {y0})", x1 - x0, y1 - y0),
        None => "the whole image".to_owned(),
    };
    let excluded: u64 = standings.iter().map(|s| s.excluded).sum();
    let excluded = if excluded > 0 {
        format!("; {excluded} pixels without a finite value excluded")
    } else {
        String::new()
    };
    let text = format!("Over {place}, at {fair}{excluded}. {}", basis(cx, standings));
    let palette = Palette::get(ui);
    ui.label(RichText::new(text).small().color(palette.weak));
    let noise_limited = noise_limited(standings);
    if !noise_limited.is_empty() {
        let text = format!(
            "More than half of the measured error of {noise_limited} is noise of the reference: it has to be less \
             noisy than the views."
        );
        ui.label(RichText::new(text).small().color(palette.warning));
    }
}

/// Sentence that names the reference of errors and verdicts.
fn basis(cx: &Cx<'_>, standings: &[Standing]) -> String {
    let others = "the mean of the other unbiased views";
    let origin = standings.iter().find_map(|s| match &s.against {
        ComparedWith::Reference(origin) => Some(origin),
        ComparedWith::Others(_) | ComparedWith::Nothing(_) => None,
    });
    match (&cx.doc.compare.reference, origin) {
        (ReferenceDoc::None, _) => format!("No reference, no errors. Verdicts: against {others}."),
        (ReferenceDoc::Pooled, _) => {
            format!("Errors and verdicts: against {others}, corrected for the noise of that mean.")
        }
        (_, Some(origin)) => format!("Errors and verdicts: against {origin}."),
        (_, None) => {
            let state = cx.wall.reference_state();
            format!("Reference: {}. No errors yet.", state.text)
        }
    }
}

/// Labels of the views whose measured errors are mostly noise of the reference.
fn noise_limited(standings: &[Standing]) -> String {
    let limited = |s: &&Standing| s.error("relmse").is_some_and(|e| e.reference_share > 0.5 * e.value);
    standings.iter().filter(limited).map(|s| s.label.as_str()).collect::<Vec<_>>().join(", ")
}
