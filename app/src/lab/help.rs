//! The list of shortcuts and gestures.

use super::Command;
use super::shortcuts::{GESTURES, KEYS};
use crate::theme::Palette;
use egui::{Context, Grid, Id, Modal, RichText, Ui};

/// Shows the list over the window.
pub(super) fn help_ui(ctx: &Context, commands: &mut Vec<Command>) {
    let response = Modal::new(Id::unique("shortcuts")).show(ctx, |ui| {
        ui.heading("Keys and gestures");
        ui.add_space(8.0);
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = 32.0;
            ui.vertical(|ui| {
                column(ui, "Keys", KEYS.iter().map(|s| (ui_keys(ctx, s), s.text)));
            });
            ui.vertical(|ui| {
                column(ui, "Picture and panels", GESTURES.iter().map(|(a, b)| ((*a).to_owned(), *b)));
            });
        });
        ui.add_space(8.0);
        ui.vertical_centered(|ui| ui.button("Close").clicked()).inner
    });
    if response.should_close() || response.inner {
        commands.push(Command::ToggleShortcuts);
    }
}

fn ui_keys(ctx: &Context, shortcut: &super::shortcuts::Shortcut) -> String {
    ctx.format_shortcut(&shortcut.keys)
}

fn column<'a>(ui: &mut Ui, title: &str, rows: impl Iterator<Item = (String, &'a str)>) {
    let palette = Palette::get(ui);
    ui.label(RichText::new(title).color(palette.accent));
    ui.add_space(4.0);
    Grid::new(title).num_columns(2).spacing([20.0, 4.0]).show(ui, |ui| {
        for (keys, text) in rows {
            ui.label(RichText::new(keys).color(palette.strong));
            ui.label(text);
            ui.end_row();
        }
    });
}
