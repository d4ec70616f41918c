//! State of the open lesson, and the column that shows it.

use super::prose::prose_ui;
use super::{Lesson, Live, Stage, Step};
use crate::model::Command;
use crate::theme::{Palette, UNIT};
use crate::widgets::badge;
use egui::{Button, Frame, Id, Key, Label, Margin, ProgressBar, RadioButton, RichText, ScrollArea, Ui};
use std::sync::Arc;

/// An open lesson with its current step and answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Player {
    /// The lesson.
    pub lesson: Arc<Lesson>,
    /// Index of the current step.
    pub step: usize,
    /// Chosen answer of each step.
    pub answers: Vec<Option<usize>>,
    /// Whether the method column is shown as well when the window is narrow.
    pub with_method: bool,
}

impl Player {
    /// Opens a lesson at a step.
    #[must_use]
    pub fn new(lesson: Arc<Lesson>, step: usize) -> Self {
        let steps = lesson.steps.len();
        Self {
            answers: vec![None; steps],
            step: step.min(steps.saturating_sub(1)),
            lesson,
            with_method: false,
        }
    }

    /// The current step.
    #[must_use]
    pub fn now(&self) -> Option<&Step> {
        self.lesson.steps.get(self.step)
    }

    fn is_last(&self) -> bool {
        self.step + 1 >= self.lesson.steps.len()
    }

    /// Whether the next step may be shown: a prediction has to be answered first.
    #[must_use]
    pub fn may_go_on(&self) -> bool {
        let answered = self.answers.get(self.step).is_some_and(Option::is_some);
        answered || self.now().is_none_or(|step| step.stop.choices.is_empty())
    }
}

/// Draws the column; user actions are appended to `commands`.
pub fn player_ui(ui: &mut Ui, player: &Player, live: &Live<'_>, commands: &mut Vec<Command>) {
    let palette = Palette::get(ui);
    let Some(step) = player.now() else { return };
    keys(ui, player, commands);
    Frame::NONE.fill(palette.bar).inner_margin(Margin::symmetric(12, 6)).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.horizontal(|ui| {
            ui.add(Label::new(RichText::new("Lesson").color(palette.accent)).selectable(false));
            let title = RichText::new(&player.lesson.title).color(palette.strong);
            ui.add(Label::new(title).truncate().selectable(false));
        });
    });
    let footer = 58.0;
    let height = (ui.available_height() - footer).max(60.0);
    ScrollArea::vertical().id_salt(("lesson", player.step)).max_height(height).auto_shrink(false).show(
        ui,
        |ui| {
            Frame::NONE.inner_margin(Margin::symmetric(14, 10)).show(ui, |ui| {
                ui.set_width(ui.available_width());
                let colour = match step.stage {
                    Stage::Predict => palette.warning,
                    Stage::See => palette.accent,
                    Stage::Explain => palette.good,
                };
                badge(ui, colour, step.stage.name());
                ui.add_space(2.0 * UNIT);
                prose_ui(ui, &live.fill(&step.text));
                choices_ui(ui, player, step, commands);
            });
        },
    );
    footer_ui(ui, player, commands);
}

fn choices_ui(ui: &mut Ui, player: &Player, step: &Step, commands: &mut Vec<Command>) {
    let palette = Palette::get(ui);
    let chosen = player.answers.get(player.step).copied().flatten();
    let turned = newly_shown(ui, player);
    for (i, choice) in step.stop.choices.iter().enumerate() {
        let on = chosen == Some(i);
        let text = RichText::new(choice).color(if on { palette.strong } else { palette.text });
        let response = ui.add(RadioButton::new(on, text));
        if response.clicked() {
            commands.push(Command::AnswerLesson(i));
        }
        // Focus the first answer: Space chooses it, Tab moves to the next.
        if turned && i == 0 {
            response.request_focus();
        }
    }
    if let Some(chosen) = chosen {
        ui.add_space(UNIT);
        let (text, colour) = if chosen == step.stop.right {
            ("Correct. The next step shows it.", palette.good)
        } else {
            ("A common guess, but wrong. The next step shows what happens.", palette.warning)
        };
        ui.add(Label::new(RichText::new(text).color(colour)).wrap());
    }
}

/// Whether the previous frame showed another step.
fn newly_shown(ui: &Ui, player: &Player) -> bool {
    let page = (player.lesson.id.clone(), player.step);
    ui.data_mut(|data| {
        let shown = data.get_temp_mut_or_default::<Option<(String, usize)>>(Id::unique("page of a lesson"));
        shown.replace(page.clone()) != Some(page)
    })
}

fn footer_ui(ui: &mut Ui, player: &Player, commands: &mut Vec<Command>) {
    let palette = Palette::get(ui);
    let steps = player.lesson.steps.len();
    Frame::NONE.fill(palette.bar).inner_margin(Margin::symmetric(12, 6)).show(ui, |ui| {
        ui.set_width(ui.available_width());
        let share = (player.step + 1) as f32 / steps as f32;
        ui.add(ProgressBar::new(share).desired_height(4.0));
        ui.horizontal(|ui| {
            if ui.add_enabled(player.step > 0, Button::new("Back")).on_hover_text("Page up").clicked() {
                commands.push(Command::StepLesson(-1));
            }
            ui.label(RichText::new(format!("{} of {steps}", player.step + 1)).small().color(palette.weak));
            let next = if player.is_last() { "Finish" } else { "Next" };
            let tip =
                if player.may_go_on() { "Page down" } else { "Choose an answer first: a guess is fine" };
            let response = ui.add_enabled(player.may_go_on(), Button::new(next));
            if response.on_hover_text(tip).on_disabled_hover_text(tip).clicked() {
                commands.push(Command::StepLesson(1));
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if ui.button("Close").on_hover_text("The scene stays as it is").clicked() {
                    commands.push(Command::CloseLesson);
                }
            });
        });
    });
}

/// Handles Page Up and Page Down, which change the step.
fn keys(ui: &Ui, player: &Player, commands: &mut Vec<Command>) {
    if ui.ctx().text_edit_focused() {
        return;
    }
    let pressed = |key: Key| ui.input(|input| input.key_pressed(key));
    if pressed(Key::PageDown) && player.may_go_on() {
        commands.push(Command::StepLesson(1));
    }
    if pressed(Key::PageUp) && player.step > 0 {
        commands.push(Command::StepLesson(-1));
    }
}
