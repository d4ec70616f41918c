//! Messages above the status bar. Errors are shown until they are dismissed.

use super::Command;
use crate::theme::Palette;
use egui::{Align, Button, Frame, Label, Layout, Margin, RichText, Ui};
use std::time::{Duration, Instant};

/// Severity of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// Confirmation of success.
    Done,
    /// Failure.
    Error,
}

/// A message, shown as one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// Consecutive number, which identifies the message in [`Command::Dismiss`].
    pub number: u64,
    /// Severity of the message.
    pub severity: Severity,
    /// Description of the event, with the file's name and the remedy.
    pub text: String,
    /// Time at which the message was added.
    at: Instant,
}

/// Displayed messages, oldest first.
#[derive(Clone, Debug, Default)]
pub struct Messages {
    lines: Vec<Message>,
    next: u64,
}

impl Messages {
    /// Maximum number of messages.
    const CAPACITY: usize = 4;
    /// Display time of a confirmation.
    const CONFIRMED: Duration = Duration::from_secs(6);

    /// Adds a message, which replaces one with the same text and all confirmations.
    pub fn say(&mut self, severity: Severity, text: impl Into<String>) {
        let text = text.into();
        self.lines.retain(|line| line.text != text && line.severity != Severity::Done);
        self.lines.push(Message { number: self.next, severity, text, at: Instant::now() });
        self.next += 1;
        if self.lines.len() > Self::CAPACITY {
            self.lines.remove(0);
        }
    }

    /// Removes confirmations whose display time has passed; returns the remaining time of the next one.
    /// Errors are kept until they are dismissed.
    pub fn expire(&mut self) -> Option<Duration> {
        let left = |line: &Message| match line.severity {
            Severity::Done => Some(Self::CONFIRMED.saturating_sub(line.at.elapsed())),
            Severity::Error => None,
        };
        self.lines.retain(|line| left(line) != Some(Duration::ZERO));
        self.lines.iter().filter_map(left).min()
    }

    /// Adds an error.
    pub fn fail(&mut self, text: impl Into<String>) {
        self.say(Severity::Error, text);
    }

    /// Removes a message by its number.
    pub fn dismiss(&mut self, number: u64) {
        self.lines.retain(|line| line.number != number);
    }

    /// Displayed messages, oldest first.
    #[must_use]
    pub fn lines(&self) -> &[Message] {
        &self.lines
    }
}

/// Shows a message with its dismiss button.
pub(super) fn line_ui(ui: &mut Ui, line: &Message, commands: &mut Vec<Command>) {
    let palette = Palette::get(ui);
    let colour = if line.severity == Severity::Error { palette.error } else { palette.good };
    let frame = Frame::NONE.fill(palette.bar.lerp_to_gamma(colour, 0.14)).inner_margin(Margin {
        left: 12,
        right: 8,
        top: 4,
        bottom: 4,
    });
    let response = frame
        .show(ui, |ui| {
            ui.horizontal(|ui| {
                let room = ui.available_width() - 84.0;
                ui.scope(|ui| {
                    ui.set_max_width(room);
                    ui.add(Label::new(RichText::new(&line.text).color(colour)).wrap());
                });
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    if ui.add(Button::new("Dismiss").small()).clicked() {
                        commands.push(Command::Dismiss(line.number));
                    }
                });
            });
        })
        .response;
    let edge = response.rect.with_max_x(response.rect.left() + 3.0);
    ui.painter().rect_filled(edge, 0.0, colour);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_few_and_distinct() {
        let mut messages = Messages::default();
        for i in 0..9 {
            messages.fail(format!("{}", i % 6));
        }
        assert!(messages.lines().len() <= 4);
        let number = messages.lines()[0].number;
        messages.dismiss(number);
        assert!(messages.lines().iter().all(|l| l.number != number));
    }
}
