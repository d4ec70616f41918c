//! Analysis of the noise of the selected view: shares of the variance, samples with the largest
//! contributions, and suggested changes that can be rendered in another view.

use super::{Cx, Tab, empty};
use crate::model::Command;
use crate::theme::{Palette, UNIT, view_colour};
use crate::wall::inspector::NoiseQuestion;
use egui::{Align, Button, Label, Layout, RichText, ScrollArea, Sense, Ui, vec2};
use majorant_core::estimator::PathIndex;
use majorant_core::film::Snapshot;
use majorant_core::inspect::{Evidence, Heaviest, Shares, advise};
use majorant_core::scene::SceneDoc;
use std::fmt::Write;
use std::sync::Arc;

/// Tab of the noise analysis.
pub struct Noise;

/// Number of contributions listed per decomposition.
const LISTED: usize = 6;
/// Fractions of the samples, largest contributions first, whose share of the variance is shown.
const FRACTIONS: [(&str, f64); 3] = [("1 in 1000", 1e-3), ("1 in 100", 1e-2), ("1 in 10", 1e-1)];

impl Tab for Noise {
    fn id(&self) -> &'static str {
        "noise"
    }

    fn title(&self) -> &'static str {
        "Noise"
    }

    fn share(&self) -> f32 {
        0.52
    }

    fn for_one_view(&self) -> bool {
        true
    }

    fn csv(&self, cx: &mut Cx<'_>) -> Option<String> {
        let evidence = evidence(cx, None)?;
        let mut text = String::from("by,part,share\n");
        for shares in &evidence.shares {
            for (name, share) in &shares.parts {
                // Writing to a string cannot fail.
                let _ = writeln!(text, "{},{name},{share}", shares.split.name());
            }
        }
        for (name, fraction) in FRACTIONS {
            let _ = writeln!(text, "heaviest samples,{name},{}", evidence.heaviest.held_by(fraction));
        }
        for heavy in &evidence.heaviest.named {
            let PathIndex { x, y, sample } = heavy.at;
            let _ = writeln!(text, "sample,{x} {y} #{sample},{}", heavy.share);
        }
        Some(text)
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        let Some(evidence) = evidence(cx, Some(ui.ctx().clone())) else {
            let built = cx.wall.selected_slot().is_some_and(|slot| slot.probe().is_some());
            let text = if !built || cx.inspector.noise.is_running() {
                "Samples are being analysed by technique, order, null collisions and hero wavelength."
            } else {
                "No noise was found."
            };
            return empty(ui, text);
        };
        let Some(doc) = cx.doc.view_doc(cx.wall.selected()) else { return };
        let height = ui.available_height();
        let narrow = ui.available_width() < 720.0;
        ui.columns(if narrow { 2 } else { 3 }, |columns| {
            for column in columns.iter_mut() {
                column.set_height(height);
            }
            ScrollArea::vertical().id_salt("shares").auto_shrink(false).show(&mut columns[0], |ui| {
                for shares in &evidence.shares {
                    shares_ui(ui, shares);
                }
                if narrow {
                    heaviest_ui(ui, cx, &evidence.heaviest);
                }
            });
            if !narrow {
                ScrollArea::vertical().id_salt("heaviest").auto_shrink(false).show(&mut columns[1], |ui| {
                    heaviest_ui(ui, cx, &evidence.heaviest);
                });
            }
            let last = columns.len() - 1;
            ScrollArea::vertical().id_salt("advice").auto_shrink(false).show(&mut columns[last], |ui| {
                advice_ui(ui, cx, &doc, &evidence);
            });
        });
    }
}

/// Statistics of the view's noise, restricted to the box if there is one. They are recomputed if their inputs
/// have changed and `wake` is given.
fn evidence(cx: &mut Cx<'_>, wake: Option<egui::Context>) -> Option<Arc<Evidence>> {
    let slot = cx.wall.selected_slot()?;
    let probe = slot.probe()?.clone();
    let region = cx.doc.compare.region;
    let question = NoiseQuestion { of: (cx.wall.selected(), slot.state.generation, probe.raises()), region };
    let chroma = slot.picture().and_then(|snapshot| chroma_share(snapshot, region));
    let wake = move || {
        if let Some(ctx) = &wake {
            ctx.request_repaint();
        }
    };
    let answer =
        cx.inspector.noise.ask(&question, wake, move |cancel| probe.evidence(region, chroma, cancel));
    answer.filter(|(_, current)| *current).map(|(evidence, _)| evidence)
}

fn inside(region: Option<[u32; 4]>, x: usize, y: usize) -> bool {
    region.is_none_or(|[x0, y0, x1, y1]| {
        (x0 as usize..x1 as usize).contains(&x) && (y0 as usize..y1 as usize).contains(&y)
    })
}

/// Share of the variance that is perpendicular to grey.
fn chroma_share(snapshot: &Snapshot, region: Option<[u32; 4]>) -> Option<f64> {
    let (mut chroma, mut all) = (0.0, 0.0);
    for (i, (noise, error)) in snapshot.noise.iter().zip(&snapshot.standard_error).enumerate() {
        if inside(region, i % snapshot.width, i / snapshot.width) && error.iter().all(|e| e.is_finite()) {
            chroma += f64::from(noise.chroma_variance);
            all += error.iter().map(|e| f64::from(*e).powi(2)).sum::<f64>();
        }
    }
    (all > 0.0).then(|| chroma / all)
}

fn shares_ui(ui: &mut Ui, shares: &Shares) {
    ui.label(RichText::new(format!("by {}", shares.split.name())).small().color(Palette::get(ui).strong));
    for (name, share) in shares.parts.iter().take(LISTED) {
        share_ui(ui, name, *share);
    }
    ui.add_space(UNIT);
}

fn share_ui(ui: &mut Ui, name: &str, share: f64) {
    let palette = Palette::get(ui);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = UNIT;
        let label = Label::new(RichText::new(name).small().color(palette.text)).truncate();
        ui.allocate_ui_with_layout(vec2(88.0, 14.0), Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_width(88.0);
            ui.add(label);
        });
        let room = (ui.available_width() - 46.0).max(20.0);
        let (rect, _) = ui.allocate_exact_size(vec2(room, 9.0), Sense::hover());
        ui.painter().rect_filled(rect, 2.0, palette.well);
        let mut bar = rect;
        bar.set_width(rect.width() * (share.abs().min(1.0) as f32));
        // A negative share reduces the variance of the sum.
        let colour = if share < 0.0 { palette.weak } else { view_colour(0) };
        ui.painter().rect_filled(bar, 2.0, colour);
        ui.label(RichText::new(format!("{:.0} %", 100.0 * share)).small().monospace().color(palette.text));
    });
}

/// Draws the share of the variance due to the largest samples, and a list of these samples.
fn heaviest_ui(ui: &mut Ui, cx: &mut Cx<'_>, heaviest: &Heaviest) {
    let palette = Palette::get(ui);
    ui.label(RichText::new("share of the largest samples").small().color(palette.strong));
    for (name, fraction) in FRACTIONS {
        share_ui(ui, name, heaviest.held_by(fraction));
    }
    ui.add_space(UNIT);
    ui.label(RichText::new("largest samples: click to replay").small().color(palette.strong));
    for heavy in &heaviest.named {
        let PathIndex { x, y, sample } = heavy.at;
        let name = format!("({x}, {y}) #{sample}");
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 2.0 * UNIT;
            let link = ui.link(RichText::new(&name).small().monospace());
            let tip = "Pixel and sample index; click to show the events of its path";
            if link.on_hover_text(tip).clicked() {
                cx.commands.push(Command::Replay([x as usize, y as usize], sample));
            }
            let share = format!("{:.1} %", 100.0 * heavy.share);
            ui.label(RichText::new(share).small().monospace().color(palette.text));
            let summary = format!("{}, order {}", heavy.technique, heavy.order);
            let label = Label::new(RichText::new(summary).small().color(palette.weak)).truncate();
            ui.add(label).on_hover_text(format!("{:.0} times the mean of its pixel", heavy.times_mean));
        });
    }
}

fn advice_ui(ui: &mut Ui, cx: &mut Cx<'_>, doc: &SceneDoc, evidence: &Evidence) {
    let palette = Palette::get(ui);
    let place = if cx.doc.compare.region.is_some() { "in the box" } else { "in the whole image" };
    ui.label(RichText::new(format!("Suggestions, {place}")).small().color(palette.strong));
    let advice = advise(doc, evidence);
    if advice.is_empty() {
        ui.label(RichText::new("No suggestion applies: take more samples.").small().color(palette.weak));
    }
    for (i, advice) in advice.iter().enumerate() {
        ui.add_space(UNIT);
        ui.add(Label::new(RichText::new(advice.change).color(palette.text)).wrap());
        ui.with_layout(Layout::top_down(Align::Min), |ui| {
            ui.add(
                Label::new(RichText::new(format!("as {}", advice.because)).small().color(palette.weak))
                    .wrap(),
            );
            let button = ui.add(Button::new(RichText::new("Try in a new view").small()));
            button.widget_info(|| {
                egui::WidgetInfo::labeled(egui::Role::Button, true, format!("Try advice {}", i + 1))
            });
            if button.on_hover_text("Adds a view with the change; the ranking shows its speed-up").clicked() {
                cx.commands.push(Command::AddViewWith(Box::new(advice.doc.clone())));
            }
        });
    }
}
