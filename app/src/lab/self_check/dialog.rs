//! Dialog of the self-check.

use super::table::{TABLE_WIDTH, table_ui};
use super::{Ending, SelfCheck, Subject};
use crate::lab::Command;
use crate::theme::{Palette, dialog_frame};
use crate::widgets::{callout, segmented};
use egui::{Align, Button, Context, Grid, Id, Layout, Modal, ProgressBar, RichText, ScrollArea, Ui, vec2};
use majorant_core::check::FAMILIES;
use majorant_core::estimator::REGISTRY;
use majorant_core::scene::SceneDoc;

/// Shows the dialog if it is open.
pub(in crate::lab) fn self_check_ui(
    ctx: &Context,
    check: &mut SelfCheck,
    doc: &SceneDoc,
    commands: &mut Vec<Command>,
) {
    if !check.open {
        return;
    }
    let room = ctx.content_rect().size() - vec2(96.0, 96.0);
    let response =
        Modal::new(Id::unique("self-check")).frame(dialog_frame(&ctx.global_style())).show(ctx, |ui| {
            ui.set_width(room.x.min(980.0));
            ui.set_height(room.y.min(620.0));
            ui.spacing_mut().item_spacing.y = 8.0;
            title_ui(ui, commands);
            choices_ui(ui, check, commands);
            explanation_ui(ui, check, doc);
            progress_ui(ui, check);
            if check.rows.is_empty() && check.subject == Subject::BuiltIn {
                families_ui(ui, check.deep);
            }
            if !check.rows.is_empty() {
                ScrollArea::horizontal().auto_shrink(false).show(ui, |ui| {
                    ui.set_min_width(TABLE_WIDTH);
                    table_ui(ui, &check.rows, check.only_failures);
                });
            }
        });
    // A click outside does not discard minutes of work.
    if response.should_close() && !check.is_running() {
        commands.push(Command::CloseSelfCheck);
    }
}

fn title_ui(ui: &mut Ui, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        ui.heading("Self-check");
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if ui.button("Close").clicked() {
                commands.push(Command::CloseSelfCheck);
            }
        });
    });
}

fn choices_ui(ui: &mut Ui, check: &mut SelfCheck, commands: &mut Vec<Command>) {
    let running = check.is_running();
    let before = (check.subject, check.deep);
    ui.horizontal(|ui| {
        ui.add_enabled_ui(!running, |ui| {
            ui.scope(|ui| {
                ui.set_max_width(230.0);
                let options = [
                    (Subject::BuiltIn, "Built-in cases", "Scenes whose expected image is known"),
                    (
                        Subject::ThisScene,
                        "This scene",
                        "Compares the estimators with each other on the current scene",
                    ),
                ];
                segmented(ui, "What to check", &mut check.subject, &options);
            });
            ui.add_space(8.0);
            ui.scope(|ui| {
                ui.set_max_width(150.0);
                let options = [
                    (false, "Quick", "Detects a bias of 3 % of the image mean"),
                    (true, "Deep", "Detects a bias of 1 %, and adds images by independent renderers"),
                ];
                segmented(ui, "Effort", &mut check.deep, &options);
            });
        });
        ui.add_space(8.0);
        let palette = Palette::get(ui);
        if running {
            if ui.add(Button::new("Cancel").min_size(vec2(84.0, 0.0))).clicked() {
                commands.push(Command::CancelSelfCheck);
            }
        } else {
            let text = RichText::new("Run").color(palette.strong);
            if ui.add(Button::new(text).fill(palette.accent_fill).min_size(vec2(84.0, 0.0))).clicked() {
                commands.push(Command::StartSelfCheck);
            }
        }
        if before != (check.subject, check.deep) {
            check.clear();
        }
        if check.rows.is_empty() {
            return;
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if ui.button("Copy as CSV").clicked() {
                ui.ctx().copy_text(check.csv());
            }
            ui.checkbox(&mut check.only_failures, "Failures only");
        });
    });
}

/// Describes the check until there are results.
fn explanation_ui(ui: &mut Ui, check: &SelfCheck, doc: &SceneDoc) {
    let palette = Palette::get(ui);
    for note in &check.notes {
        callout(ui, palette.warning, note);
    }
    if !check.rows.is_empty() {
        return;
    }
    let text = match (check.subject, check.deep) {
        (Subject::BuiltIn, false) => {
            "Every estimator is tested on some sixty scenes, against closed forms and quadrature, or against the \
             other estimators. Takes about half a minute; rendering continues meanwhile."
        }
        (Subject::BuiltIn, true) => {
            "The same scenes, with enough samples to detect a bias of 1 %, and seven more that independent \
             renderers have rendered. Takes several minutes; rendering continues meanwhile."
        }
        (Subject::ThisScene, false) => {
            "The expected image of this scene is unknown, so the estimators are compared with each other, pair by pair, \
             on a small image. Takes at most about 45 seconds."
        }
        (Subject::ThisScene, true) => {
            "The expected image of this scene is unknown, so the estimators are compared with each other, pair by pair, \
             on a small image. Takes at most about ten minutes."
        }
    };
    ui.label(RichText::new(text).color(palette.weak));
    if check.subject == Subject::ThisScene && check.notes.is_empty() {
        let reasons: Vec<_> = REGISTRY.iter().map(|entry| entry.bias(doc)).collect();
        if let Some(Some(reason)) = reasons.first()
            && reasons.iter().all(Option::is_some)
        {
            let text = format!("This scene is biased by choice: {reason}. No estimator can be tested.");
            callout(ui, palette.error, &text);
        }
    }
}

/// Lists the families of cases before the check starts.
fn families_ui(ui: &mut Ui, deep: bool) {
    let palette = Palette::get(ui);
    ui.add_space(8.0);
    Grid::new("families").num_columns(2).spacing([20.0, 8.0]).show(ui, |ui| {
        for family in FAMILIES.iter().filter(|family| deep || !family.deep_only) {
            ui.label(RichText::new(family.id).color(palette.strong));
            ui.label(family.about);
            ui.end_row();
        }
    });
}

/// Shows the progress of the check, or its result.
fn progress_ui(ui: &mut Ui, check: &SelfCheck) {
    let palette = Palette::get(ui);
    if check.is_running() {
        let share = if check.total > 0 { check.done as f32 / check.total as f32 } else { 0.0 };
        let text = if check.total > 0 {
            format!("{} of {}   {}", check.done, check.total, check.at)
        } else {
            "Computing the expected values…".into()
        };
        let bar = ProgressBar::new(share).text(RichText::new(text).small()).desired_height(20.0);
        ui.add(bar).accessible_name("Progress of the check");
        return;
    }
    let (total, agree, wrong) = check.counts();
    let tally = || {
        let noisy = total - agree - wrong;
        let mut text = format!("{agree} of {total} agree");
        if noisy > 0 {
            text += &format!(", {noisy} too noisy to tell");
        }
        if wrong > 0 {
            text += &format!(", {wrong} wrong");
        }
        text
    };
    let (text, colour) = match &check.ending {
        None => return,
        Some(Ending::Finished(_)) if total == 0 => return,
        Some(Ending::Finished(seconds)) if wrong == 0 => {
            (format!("{}, in {seconds:.0} s.", tally()), palette.good)
        }
        Some(Ending::Finished(seconds)) => (format!("{}, in {seconds:.0} s.", tally()), palette.error),
        Some(Ending::Cancelled) => (format!("Cancelled: {} so far.", tally()), palette.warning),
        Some(Ending::Failed(message)) => return callout(ui, palette.error, message),
    };
    ui.label(RichText::new(text).color(colour));
}
