//! Layout of the window: menu, two columns, views, messages, status bar.

use super::dialogs::dialog_ui;
use super::files::FileKind;
use super::help::help_ui;
use super::messages::line_ui;
use super::self_check::self_check_ui;
use super::{Command, LabApp, shortcuts};
use crate::lessons::{Live, player_ui};
use crate::panels::{Column, faults};
use crate::theme::Palette;
use crate::wall::dock;
use egui::{
    Align2, CentralPanel, Color32, Context, FontId, Frame, Id, LayerId, Margin, Order, Panel, RichText,
    Stroke, StrokeKind, Ui,
};
use majorant_core::scene::{CameraDoc, SceneDoc};

/// Window width in points below which a lesson, the views and the method column do not fit side by side.
const WIDE: f32 = 1500.0;

impl LabApp {
    /// Draws a frame and returns the commands issued by its widgets.
    pub(super) fn window_ui(&mut self, ui: &mut Ui) -> Vec<Command> {
        let mut commands = self.keys(ui.ctx());
        let whole = self.document.doc().clone();
        let selected = self.wall.selected();
        let mut draft = whole.view_doc(selected).unwrap_or_else(|| whole.clone());
        let before = draft.clone();
        let palette = Palette::get(ui);
        let bar = |margin| Frame::NONE.fill(palette.bar).inner_margin(margin);

        let menu = Panel::top("menu").frame(bar(Margin::symmetric(6, 3))).exact_size(30.0);
        menu.show(ui, |ui| self.menu_ui(ui, &mut commands));
        if let Some(name) = faults::planted(&draft) {
            let frame = Frame::NONE
                .fill(palette.bar.lerp_to_gamma(palette.error, 0.22))
                .inner_margin(Margin::symmetric(12, 4));
            Panel::top("fault").frame(frame).show(ui, |ui| fault_ui(ui, name, &mut commands));
        }
        let status = Panel::bottom("status").frame(bar(Margin::symmetric(12, 0))).exact_size(26.0);
        status.show(ui, |ui| self.status_ui(ui));
        self.messages_ui(ui, &mut commands);

        let column = Frame::NONE.fill(palette.panel);
        if let Some(player) = &self.lesson {
            let panel = Panel::left("lesson").frame(column).default_size(372.0).size_range(320.0..=560.0);
            let live = Live { wall: &self.wall, inspector: &self.inspector };
            panel.show(ui, |ui| player_ui(ui, player, &live, &mut commands));
        }
        if self.settings.scene_column && self.lesson.is_none() {
            let panel =
                Panel::left("scene-column").frame(column).default_size(316.0).size_range(292.0..=480.0);
            panel.show(ui, |ui| self.column_ui(ui, Column::Scene, &mut draft, &mut commands));
        }
        self.narrow = ui.max_rect().width() < WIDE;
        if self.method_shown() {
            let panel =
                Panel::right("method-column").frame(column).default_size(292.0).size_range(292.0..=480.0);
            panel.show(ui, |ui| self.column_ui(ui, Column::Method, &mut draft, &mut commands));
        }
        let mut camera = None;
        let mut pictures = ui.available_rect_before_wrap();
        CentralPanel::no_frame().show(ui, |ui| {
            pictures = ui.max_rect();
            camera = self.wall_ui(ui, &whole, &mut commands);
        });
        self.loading_ui(ui.ctx(), pictures);

        let name = self.name();
        dialog_ui(ui.ctx(), &mut self.dialog, &name, &mut commands);
        if self.shortcuts_open {
            help_ui(ui.ctx(), &mut commands);
        }
        self_check_ui(ui.ctx(), &mut self.self_check, self.document.doc(), &mut commands);
        drop_overlay(ui.ctx());
        // Commands of this frame refer to the document as drawn, so that its edits are applied first.
        let mut edited = if draft == before { whole.clone() } else { whole.with_view_doc(selected, &draft) };
        if let Some((view, camera)) = camera
            && let Some(seen) = edited.view_doc(view)
        {
            edited = edited.with_view_doc(view, &SceneDoc { camera, ..seen });
        }
        if edited != whole {
            commands.insert(0, Command::Edit(Box::new(edited)));
        }
        commands
    }

    /// Commands of the keys of this frame; an open dialog blocks all but its own.
    fn keys(&self, ctx: &Context) -> Vec<Command> {
        let mut commands = shortcuts::pressed(ctx);
        if self.over_wall && self.document.doc().view_count() > 1 && shortcuts::tab_pressed(ctx) {
            commands.push(Command::Flip);
        }
        if self.dialog.is_some() || self.shortcuts_open || self.self_check.open {
            commands.retain(|command| self.shortcuts_open && *command == Command::ToggleShortcuts);
        }
        commands
    }

    /// Shows errors and confirmations above the status bar.
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

    /// Shows the views with bar and dock; returns the camera of a view that a gesture has moved.
    fn wall_ui(
        &mut self,
        ui: &mut Ui,
        doc: &SceneDoc,
        commands: &mut Vec<Command>,
    ) -> Option<(usize, CameraDoc)> {
        let palette = Palette::get(ui);
        let dock = if doc.view_count() > 1 { self.settings.dock } else { self.settings.dock_alone };
        let bar = Frame::NONE.fill(palette.header).inner_margin(Margin::symmetric(8, 4));
        Panel::top("wall-bar").frame(bar).resizable(false).show(ui, |ui| {
            self.wall.bar_ui(ui, doc, dock, commands);
        });
        if dock {
            let frame = Frame::NONE.fill(palette.panel);
            let room = ui.available_height();
            let share = dock::share(&self.settings.tab);
            let panel = Panel::bottom(format!("dock {share}")).frame(frame).resizable(true);
            panel.default_size(share * room).size_range(110.0..=(0.7 * room).max(120.0)).show(ui, |ui| {
                // The height of the panel does not depend on the content of the tab.
                ui.set_min_height(ui.available_height());
                let mut cx = dock::Cx { wall: &self.wall, doc, inspector: &mut self.inspector, commands };
                dock::dock_ui(ui, &self.settings.tab, &mut cx);
            });
        }
        let area = ui.available_rect_before_wrap();
        self.over_wall = ui.input(|i| i.pointer.latest_pos()).is_some_and(|at| area.contains(at));
        self.wall.majorant_slice = self.settings.majorant_slice;
        self.wall.medium = self.medium;
        let seen = self.wall.cells_ui(ui, doc, commands);
        (self.pixel, self.zoom) = (seen.pixel, seen.zoom);
        seen.camera
    }
}

/// Shows a banner while a fault is enabled.
fn fault_ui(ui: &mut Ui, name: &str, commands: &mut Vec<Command>) {
    let palette = Palette::get(ui);
    ui.horizontal(|ui| {
        ui.label(RichText::new(format!("Deliberate fault: {name}")).color(palette.strong));
        ui.label(RichText::new("the image of this view is incorrect").color(palette.text));
        if ui.small_button("Remove it").clicked() {
            commands.push(Command::RemoveFaults);
        }
    });
}

/// Shows the effect of dropping the files that hover over the window.
fn drop_overlay(ctx: &Context) {
    let hovered = ctx.input(|i| i.raw.hovered_files.clone());
    if hovered.is_empty() {
        return;
    }
    let texts: Vec<&str> = hovered
        .iter()
        .map(|file| match file.path.as_deref().map(FileKind::of) {
            Some(FileKind::Scene) => "Open this scene",
            Some(FileKind::Volume) => "Use this volume as density of the medium",
            Some(FileKind::Panorama) => {
                "Use this image as reference, or as environment map if it is a panorama"
            }
            Some(FileKind::Mesh) => "Add this mesh to the objects",
            Some(FileKind::Unknown) => "Unsupported file type",
            None => "Drop a scene, a volume, a mesh or an environment map",
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
