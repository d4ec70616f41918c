//! The two columns of panels at the sides of the window.

use super::{Command, LabApp};
use crate::panels::{Column, Cx, PANELS};
use crate::theme::Palette;
use crate::widgets::section::{Header, section};
use egui::{Frame, Label, Margin, RichText, ScrollArea, Ui};
use majorant_core::scene::SceneDoc;

impl LabApp {
    /// Shows the heading and the panels of a column; edits are made to `draft`.
    pub(super) fn column_ui(
        &self,
        ui: &mut Ui,
        column: Column,
        draft: &mut SceneDoc,
        commands: &mut Vec<Command>,
    ) {
        let palette = Palette::get(ui);
        let (title, text) = match column {
            Column::Scene => ("Scene", "what is simulated"),
            Column::Method => ("Method", "how it is estimated"),
        };
        ui.spacing_mut().item_spacing.y = 0.0;
        Frame::NONE.fill(palette.bar).inner_margin(Margin::symmetric(12, 6)).show(ui, |ui| {
            ui.set_width(ui.available_width());
            ui.horizontal(|ui| {
                ui.add(Label::new(RichText::new(title).color(palette.accent)).selectable(false));
                ui.add(Label::new(RichText::new(text).color(palette.weak)).selectable(false));
            });
        });
        ScrollArea::vertical().id_salt(title).auto_shrink(false).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = crate::theme::UNIT;
            let saved = self.document.saved();
            let opened = saved.view_doc(self.wall.selected()).unwrap_or_else(|| saved.clone());
            let mut cx = Cx {
                medium: self.medium.min(draft.media.len().saturating_sub(1)),
                draft,
                opened: &opened,
                state: &self.state,
                stats: &self.stats,
                paused: self.wall.is_paused(),
                unfinished: self.wall.is_unfinished(),
                latency: &self.latency,
                factor_curve: &self.factor_curve,
                settings: &self.settings,
                grids: &self.grids,
                commands,
            };
            for panel in PANELS.iter().filter(|p| p.column() == column) {
                if panel.is_of_medium() && cx.draft.media.is_empty() {
                    continue;
                }
                let summary = panel.summary(&cx);
                let header = Header {
                    id: panel.id(),
                    title: panel.title(),
                    summary: &summary,
                    alert: panel.alert(&cx, palette),
                    open: panel.starts_open(),
                };
                section(ui, &header, |ui| panel.ui(ui, &mut cx));
            }
            ui.add_space(24.0);
        });
    }
}
