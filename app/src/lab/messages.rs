//! What the window has to say: lines above the status bar. Errors stay until they are dismissed.

use super::Command;
use crate::theme::Palette;
use egui::{Align, Button, Frame, Label, Layout, Margin, RichText, Ui};
use std::time::{Duration, Instant};

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// It worked.
    Done,
    /// It failed.
    Error,
}

/// One line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// Counts up; names it for [`Command::Dismiss`].
    pub number: u64,
    /// How bad it is.
    pub severity: Severity,
    /// What happened, with the file's name and the cure.
    pub text: String,
    /// When it was said.
    at: Instant,
}

/// The lines that are shown, oldest first.
#[derive(Clone, Debug, Default)]
pub struct Messages {
    lines: Vec<Message>,
    next: u64,
}

impl Messages {
    /// No more than this many are kept.
    const CAPACITY: usize = 4;
    /// How long a confirmation stays.
    const CONFIRMED: Duration = Duration::from_secs(6);

    /// Adds a line; the same text is not repeated.
    pub fn say(&mut self, severity: Severity, text: impl Into<String>) {
        let text = text.into();
        self.lines.retain(|line| line.text != text && line.severity != Severity::Done);
        self.lines.push(Message { number: self.next, severity, text, at: Instant::now() });
        self.next += 1;
        if self.lines.len() > Self::CAPACITY {
            self.lines.remove(0);
        }
    }

    /// Removes confirmations that have been read by now; returns how long the next one has left.
    /// Errors stay until they are dismissed.
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

    /// Removes a line.
    pub fn dismiss(&mut self, number: u64) {
        self.lines.retain(|line| line.number != number);
    }

    /// The lines.
    #[must_use]
    pub fn lines(&self) -> &[Message] {
        &self.lines
    }
}

/// Shows one line with its dismiss button.
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
