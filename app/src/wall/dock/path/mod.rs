//! Replay of one path with its random numbers: list of samples, 3D view, and table of path weights.
//!
//! All three show the same event: selecting an event in one marks it in the others.

mod event;
mod events;
mod list;
mod segment;
mod space;

use super::{Cx, Tab, empty};
use crate::model::Command;
use crate::theme::Palette;
use crate::wall::inspector::{PathQuestion, Replayed};
use egui::{Button, ComboBox, Key, Layout, RichText, Ui, UiBuilder};
use majorant_core::compare::label;
use majorant_core::estimator::{PathIndex, REGISTRY};
use majorant_core::inspect::{Ledger, Recording};
use majorant_core::spectrum::Carried;
use std::fmt::Write;
use std::sync::Arc;

/// Tab of the replayed path.
pub struct Path;

impl Tab for Path {
    fn id(&self) -> &'static str {
        "path"
    }

    fn title(&self) -> &'static str {
        "Path"
    }

    fn share(&self) -> f32 {
        0.52
    }

    fn for_one_view(&self) -> bool {
        true
    }

    fn csv(&self, cx: &mut Cx<'_>) -> Option<String> {
        let replayed = replay(cx, None)?;
        let mut text =
            String::from("row,branch,event,x,y,z,ln_f,ln_p_uni,ln_p_nee,added_r,added_g,added_b\n");
        for (i, row) in replayed.ledger.rows.iter().enumerate() {
            let [x, y, z] = row.point.map_or([f32::NAN; 3], |p| p.to_array());
            let [r, g, b] = row.contribution.map_or([0.0; 3], |c| c.film.to_array());
            let (f, uni, nee) = (row.f[0].ln(), row.uni[0].ln(), row.nee[0].ln());
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{i},{},{},{x},{y},{z},{f},{uni},{nee},{r},{g},{b}",
                row.branch.name(),
                row.step
            );
        }
        Some(text)
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        let Some(pixel) = cx.wall.picked else {
            return pick_prompt(ui, cx);
        };
        if cx.inspector.path.pixel != Some(pixel) {
            let state = &mut cx.inspector.path;
            (state.pixel, state.sample, state.step) = (Some(pixel), None, 0);
        }
        let samples = list::sorted(cx.wall, pixel);
        if samples.is_empty() {
            return empty(ui, "The samples of the pixel are being retraced.");
        }
        let chosen = cx.inspector.path.sample.unwrap_or(samples[0].0);
        cx.inspector.path.sample = Some(chosen);
        let replayed = replay(cx, Some(ui.ctx().clone()));
        bar_ui(ui, cx, pixel, chosen, replayed.as_deref());
        let room = ui.available_rect_before_wrap();
        // The table of path weights takes precedence: list and 3D view are omitted in narrow windows.
        let (narrow, alone) = (room.width() < 620.0, room.width() < 480.0);
        let list_width = if narrow { 0.0 } else { 138.0 };
        let ledger_width = if alone { room.width() } else { (0.57 * (room.width() - list_width)).max(300.0) };
        let (left, rest) = room.split_left_right_at_x(room.left() + list_width);
        let (middle, right) = rest.split_left_right_at_x(rest.right() - ledger_width);
        if !narrow {
            list::list_ui(&mut part(ui, left.with_max_x(left.right() - 6.0)), cx, pixel, &samples, chosen);
        }
        let Some(replayed) = replayed else {
            return empty(&mut part(ui, rest), "The path is being retraced.");
        };
        keys(ui, cx, replayed.ledger.rows.len());
        if !alone {
            let middle = middle.with_max_x(middle.right() - 6.0);
            let (above, below) = middle.split_top_bottom_at_y(middle.bottom() - segment::HEIGHT);
            space::space_ui(&mut part(ui, above.with_max_y(above.bottom() - 4.0)), cx, &replayed);
            segment::segment_ui(ui, cx, &replayed, below);
        }
        events::events_ui(&mut part(ui, right), cx, &replayed);
        ui.advance_cursor_after_rect(room);
    }
}

fn part(ui: &mut Ui, rect: egui::Rect) -> Ui {
    let mut part = ui.new_child(UiBuilder::new().max_rect(rect).layout(Layout::top_down(egui::Align::Min)));
    part.set_clip_rect(rect.intersect(ui.clip_rect()));
    part
}

/// Draws the instructions shown while no pixel is picked.
fn pick_prompt(ui: &mut Ui, cx: &mut Cx<'_>) {
    empty(ui, "Click a pixel of an image to retrace its paths, event by event.");
    ui.add_space(6.0);
    ui.vertical_centered(|ui| {
        let outlier = list::outlier(cx.wall);
        let button = Button::new("Take the brightest outlier");
        let response = ui
            .add_enabled(outlier.is_some(), button)
            .on_hover_text("The pixel that exceeds its neighbours by most: a firefly, if there is one");
        if response.clicked()
            && let Some(pixel) = outlier
        {
            cx.commands.push(Command::Pick(pixel));
        }
    });
}

/// Returns the replayed path. It is retraced if its inputs have changed and `wake` is given.
fn replay(cx: &mut Cx<'_>, wake: Option<egui::Context>) -> Option<Arc<Replayed>> {
    let view = cx.wall.selected();
    let slot = cx.wall.selected_slot()?;
    let probe = slot.probe()?.clone();
    let state = &mut cx.inspector.path;
    let own = cx.doc.view_doc(view).and_then(|doc| majorant_core::estimator::find(&doc.estimator.id))?;
    let entry = state.under.unwrap_or(own);
    let [x, y] = state.pixel?;
    let at = PathIndex { x: x as u32, y: y as u32, sample: state.sample? };
    let question = PathQuestion {
        of: (view, slot.state.generation, probe.raises()),
        pixel: [x, y],
        sample: at.sample,
        estimator: entry.id,
    };
    let answer = state.query.ask(
        &question,
        move || {
            if let Some(ctx) = &wake {
                ctx.request_repaint();
            }
        },
        move |cancel| {
            let recording: Recording = probe.under(entry).record(at, cancel);
            cancel.is_active().then(|| Replayed { ledger: Ledger::new(&recording), recording })
        },
    );
    answer.filter(|(_, current)| *current).map(|(replayed, _)| replayed)
}

/// Draws the title, the event navigation and the choice of the estimator that uses the path's random numbers.
fn bar_ui(ui: &mut Ui, cx: &mut Cx<'_>, [x, y]: [usize; 2], sample: u64, replayed: Option<&Replayed>) {
    let palette = Palette::get(ui);
    let view = cx.wall.selected();
    let several = cx.doc.view_count() > 1;
    ui.horizontal_wrapped(|ui| {
        let of = if several { format!("{}  ", label(view)) } else { String::new() };
        let title = format!("{of}pixel ({x}, {y}), sample {sample}");
        ui.label(RichText::new(title).small().color(palette.strong));
        let state = &mut cx.inspector.path;
        let last = replayed.map_or(0, |r| r.ledger.rows.len().saturating_sub(1));
        let mut step = state.step.min(last);
        let arrow = |ui: &mut Ui, text: &str, name: &str, tip: &str, enabled: bool| {
            let response = ui.add_enabled(enabled, Button::new(text).small()).on_hover_text(tip);
            response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, enabled, name));
            response.clicked()
        };
        if arrow(ui, "◀", "Previous event", "Previous event  ([)", step > 0) {
            (step, state.scroll) = (step - 1, true);
        }
        ui.label(RichText::new(format!("{} of {}", step + 1, last + 1)).small().color(palette.weak));
        if arrow(ui, "▶", "Next event", "Next event  (])", step < last) {
            (step, state.scroll) = (step + 1, true);
        }
        state.step = step;
        let own = cx.doc.view_doc(view).and_then(|doc| majorant_core::estimator::find(&doc.estimator.id));
        ui.label(RichText::new("under").small().color(palette.weak));
        let shown = state.under.or(own).map_or("", |entry| entry.name);
        let combo = ComboBox::from_id_salt("under").selected_text(RichText::new(shown).small());
        let combo = combo.show_ui(ui, |ui| {
            for entry in REGISTRY {
                let is_own = own.is_some_and(|own| own.id == entry.id);
                let on = state.under.or(own).is_some_and(|now| now.id == entry.id);
                let name =
                    if is_own { format!("{} (the view's)", entry.name) } else { entry.name.to_owned() };
                if ui.selectable_label(on, name).clicked() {
                    state.under = (!is_own).then_some(entry);
                    state.step = 0;
                }
            }
        });
        combo.response.accessible_name("Replay under");
        if replayed.is_some_and(|replayed| !replayed.recording.complete) {
            let text = "truncated: the path is too long to be recorded completely";
            ui.label(RichText::new(text).small().color(palette.warning));
        }
        if let Some(replayed) = replayed {
            let film = replayed.ledger.film;
            let text = format!(
                "{}  →  {:.4} {:.4} {:.4}",
                carried(&replayed.ledger.carried),
                film.x,
                film.y,
                film.z
            );
            ui.label(RichText::new(text).small().color(palette.weak))
                .on_hover_text("Components of the path, and its contribution to the film (linear sRGB)");
        }
    });
}

/// Handles the keys `[` and `]`, which step through the events.
fn keys(ui: &Ui, cx: &mut Cx<'_>, rows: usize) {
    if ui.ctx().text_edit_focused() {
        return;
    }
    let state = &mut cx.inspector.path;
    let pressed = |key: Key| ui.input(|input| input.key_pressed(key));
    if pressed(Key::OpenBracket) && state.step > 0 {
        (state.step, state.scroll) = (state.step - 1, true);
    }
    if pressed(Key::CloseBracket) && state.step + 1 < rows {
        (state.step, state.scroll) = (state.step + 1, true);
    }
}

/// Components of a path, such as "543, 623, 703, 463 nm" or "red, green, blue".
fn carried(carried: &Carried) -> String {
    match carried {
        Carried::Wavelengths(nm, n) => {
            let nm: Vec<_> = nm[..*n].iter().map(|nm| format!("{nm:.0}")).collect();
            format!("{} nm", nm.join(", "))
        }
        Carried::Channels(channels, n) => {
            let names = ["red", "green", "blue"];
            channels[..*n].iter().map(|c| names[*c as usize]).collect::<Vec<_>>().join(", ")
        }
        Carried::Grey => "all colours".to_owned(),
    }
}
