//! Dialog with the shortcuts and gestures.

use super::Command;
use super::shortcuts::{GESTURES, KEYS, name};
use crate::theme::{Palette, dialog_frame};
use egui::{Context, Grid, Id, Modal, RichText, Ui};

/// Shows the dialog over the window.
pub(super) fn help_ui(ctx: &Context, commands: &mut Vec<Command>) {
    let frame = dialog_frame(&ctx.global_style());
    let response = Modal::new(Id::unique("shortcuts")).frame(frame).show(ctx, |ui| {
        ui.heading("Keys and gestures");
        ui.add_space(12.0);
        let keys: Vec<_> = KEYS.iter().map(|s| (name(ctx, &s.keys), s.text)).collect();
        let (files, picture) = keys.split_at(KEYS.iter().take_while(|s| s.keys.modifiers.command).count());
        let gestures: Vec<_> = GESTURES.iter().map(|(keys, text)| ((*keys).to_owned(), *text)).collect();
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = 36.0;
            ui.vertical(|ui| column(ui, "Scene", files));
            ui.vertical(|ui| column(ui, "Render and image", picture));
            ui.vertical(|ui| column(ui, "Mouse", &gestures));
        });
        ui.add_space(12.0);
        ui.vertical_centered(|ui| ui.button("Close").clicked()).inner
    });
    if response.should_close() || response.inner {
        commands.push(Command::ToggleShortcuts);
    }
}

fn column(ui: &mut Ui, title: &str, rows: &[(String, &str)]) {
    let palette = Palette::get(ui);
    ui.label(RichText::new(title).color(palette.accent));
    ui.add_space(4.0);
    Grid::new(title).num_columns(2).spacing([16.0, 2.0]).show(ui, |ui| {
        for (keys, text) in rows {
            ui.label(RichText::new(keys).color(palette.strong));
            ui.label(*text);
            ui.end_row();
        }
    });
}
