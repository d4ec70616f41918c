//! The window's layout: menu, two columns, picture, messages, status.

use super::dialogs::dialog_ui;
use super::files::FileKind;
use super::help::help_ui;
use super::messages::line_ui;
use super::self_check::self_check_ui;
use super::{Command, LabApp, shortcuts};
use crate::panels::Column;
use crate::theme::Palette;
use crate::view::canvas::{Shown, canvas_ui};
use crate::widgets::badge;
use egui::{
    Align, Align2, CentralPanel, Color32, Context, FontId, Frame, Id, Label, LayerId, Layout, Margin, Order,
    Panel, Rect, RichText, Stroke, StrokeKind, Ui, UiBuilder, pos2, vec2,
};
use majorant_core::estimator;
use majorant_core::scene::SceneDoc;
use majorant_core::session::Status;

impl LabApp {
    /// Draws a frame; returns what it was asked for.
    pub(super) fn window_ui(&mut self, ui: &mut Ui) -> Vec<Command> {
        let mut commands = self.keys(ui.ctx());
        let mut draft = self.document.doc().clone();
        let palette = Palette::get(ui);
        let bar = |margin| Frame::NONE.fill(palette.bar).inner_margin(margin);

        let menu = Panel::top("menu").frame(bar(Margin::symmetric(6, 3))).exact_size(30.0);
        menu.show(ui, |ui| self.menu_ui(ui, &mut commands));
        let status = Panel::bottom("status").frame(bar(Margin::symmetric(12, 0))).exact_size(26.0);
        status.show(ui, |ui| self.status_ui(ui));
        self.messages_ui(ui, &mut commands);

        let column = Frame::NONE.fill(palette.panel);
        if self.settings.scene_column {
            let panel =
                Panel::left("scene-column").frame(column).default_size(316.0).size_range(292.0..=480.0);
            panel.show(ui, |ui| self.column_ui(ui, Column::Scene, &mut draft, &mut commands));
        }
        if self.settings.method_column {
            let panel =
                Panel::right("method-column").frame(column).default_size(292.0).size_range(292.0..=480.0);
            panel.show(ui, |ui| self.column_ui(ui, Column::Method, &mut draft, &mut commands));
        }
        CentralPanel::no_frame().show(ui, |ui| self.picture_ui(ui, &mut draft));

        let name = self.name();
        dialog_ui(ui.ctx(), &mut self.dialog, &name, &mut commands);
        if self.shortcuts_open {
            help_ui(ui.ctx(), &mut commands);
        }
        self_check_ui(ui.ctx(), &mut self.self_check, self.document.doc(), &mut commands);
        drop_overlay(ui.ctx());
        // Commands of this frame were meant for the document as it was drawn, edits included.
        if draft != *self.document.doc() {
            commands.insert(0, Command::Edit(Box::new(draft)));
        }
        commands
    }

    /// Keys of this frame; what is open over the window keeps the others from it.
    fn keys(&self, ctx: &Context) -> Vec<Command> {
        let mut commands = shortcuts::pressed(ctx);
        if self.dialog.is_some() || self.shortcuts_open || self.self_check.open {
            commands.retain(|command| self.shortcuts_open && *command == Command::ToggleShortcuts);
        }
        commands
    }

    /// Errors and confirmations, above the status line.
    fn messages_ui(&self, ui: &mut Ui, commands: &mut Vec<Command>) {
        if self.messages.lines().is_empty() {
            return;
        }
        Panel::bottom("messages").frame(Frame::NONE).resizable(false).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            for line in self.messages.lines() {
                line_ui(ui, line, commands);
            }
        });
    }

    fn picture_ui(&mut self, ui: &mut Ui, draft: &mut SceneDoc) {
        let failure = match &self.state.status {
            Status::Failed(text) => Some(text.clone()),
            _ => None,
        };
        let display = self.document.doc().view.clone();
        let shown = Shown {
            texture: self.texture.as_ref(),
            snapshot: self.shown.as_deref(),
            dimmed: failure.is_some(),
            display: &display,
        };
        let film = vec2(draft.film.width as f32, draft.film.height as f32);
        let outcome = canvas_ui(ui, &shown, self.image_view, &draft.camera, film);
        (self.image_view, self.pixel, self.zoom) = (outcome.view, outcome.pixel, outcome.zoom);
        if let Some(camera) = outcome.camera {
            draft.camera = camera;
        }
        self.remarks_ui(ui, outcome.rect);
        if let Some(text) = failure {
            failure_ui(ui, outcome.rect, &text, self.shown.is_some());
        }
    }
}

impl LabApp {
    /// What has to be known about the picture to read it rightly, in its corner.
    fn remarks_ui(&self, ui: &mut Ui, canvas: Rect) {
        let palette = Palette::get(ui);
        let biased = estimator::find(&self.doc().estimator.id).and_then(|entry| entry.bias(self.doc()));
        let coarse = self.shown.as_ref().is_some_and(|s| s.coarse.is_some());
        let area = Rect::from_min_size(canvas.min + vec2(10.0, 10.0), vec2(canvas.width() - 20.0, 22.0));
        let mut child =
            ui.new_child(UiBuilder::new().max_rect(area).layout(Layout::left_to_right(Align::Center)));
        if let Some(reason) = biased {
            badge(&mut child, palette.error, &format!("biased: {reason}"));
        }
        if coarse {
            badge(&mut child, palette.accent, "preview");
        }
    }
}

/// Why nothing new is shown, over the last picture.
fn failure_ui(ui: &mut Ui, canvas: Rect, text: &str, pictured: bool) {
    let palette = Palette::get(ui);
    let width = (canvas.width() - 64.0).clamp(120.0, 560.0);
    let left = canvas.left() + 0.5 * (canvas.width() - width);
    let area = Rect::from_min_size(pos2(left, canvas.top() + 44.0), vec2(width, 10.0));
    let mut child = ui.new_child(UiBuilder::new().max_rect(area));
    let frame =
        Frame::popup(child.style()).inner_margin(Margin::same(14)).stroke(Stroke::new(1.0, palette.error));
    frame.show(&mut child, |ui| {
        ui.set_width(width - 28.0);
        ui.label(RichText::new("This scene cannot be rendered").color(palette.error));
        ui.add(Label::new(RichText::new(text).color(palette.strong)).wrap());
        let kept = "Your edits are kept: correct them, or take them back with Ctrl + Z.";
        let kept =
            if pictured { format!("The last picture is shown, dimmed. {kept}") } else { kept.to_owned() };
        ui.add(Label::new(RichText::new(kept).small().color(palette.weak)).wrap());
    });
}

/// While files hover over the window: what would become of them.
fn drop_overlay(ctx: &Context) {
    let hovered = ctx.input(|i| i.raw.hovered_files.clone());
    if hovered.is_empty() {
        return;
    }
    let texts: Vec<&str> = hovered
        .iter()
        .map(|file| match file.path.as_deref().map(FileKind::of) {
            Some(FileKind::Scene) => "Open this scene",
            Some(FileKind::Volume) => "Fill the medium with this volume",
            Some(FileKind::Panorama) => "Light the scene with this environment map",
            Some(FileKind::Unknown) => "Not a kind of file that Majorant reads",
            None => "Drop a scene, a volume or an environment map",
        })
        .collect();
    let painter = ctx.layer_painter(LayerId::new(Order::Foreground, Id::unique("drop")));
    let palette = Palette::of(ctx.theme());
    let rect = ctx.content_rect();
    painter.rect_filled(rect, 0.0, Color32::from_black_alpha(150));
    painter.rect_stroke(rect.shrink(16.0), 8.0, Stroke::new(2.0, palette.accent), StrokeKind::Inside);
    let font = FontId::proportional(22.0);
    painter.text(rect.center(), Align2::CENTER_CENTER, texts.join("\n"), font, Color32::WHITE);
}
