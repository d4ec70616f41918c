//! Modal dialogs: path entry and unsaved changes.

use super::{Answer, Command, Purpose};
use crate::theme::{Palette, dialog_frame};
use egui::{Button, Context, Id, Key, Modal, RichText, TextEdit, Ui, vec2};
use std::path::PathBuf;

/// The open dialog.
pub(super) enum Dialog {
    /// Entry of a path.
    Path(PathPrompt),
    /// Confirmation of unsaved changes before this command.
    Unsaved(Box<Command>),
}

/// Path entry. The desktop's file dialog may be open as well; the first answer is used.
pub(super) struct PathPrompt {
    pub purpose: Purpose,
    text: String,
    fresh: bool,
}

impl PathPrompt {
    pub fn new(purpose: Purpose, text: String) -> Self {
        Self { purpose, text, fresh: true }
    }

    fn words(&self) -> (&'static str, &'static str, &'static str) {
        match self.purpose {
            Purpose::OpenScene => ("Open scene", "Open", "path/to/scene.toml"),
            Purpose::OpenVolume | Purpose::DensityFile | Purpose::TemperatureFile => {
                ("Open volume", "Open", "path/to/volume.vdb")
            }
            Purpose::PhaseTable => ("Open phase function", "Open", "path/to/lobe.csv"),
            Purpose::EnvironmentMap(_) => ("Open environment map", "Open", "path/to/sky.exr"),
            Purpose::Mesh(_) => ("Open mesh", "Open", "path/to/mesh.ply"),
            Purpose::Reference => ("Open reference", "Open", "path/to/reference.exr"),
            Purpose::ExportReport => ("Export comparison", "Export", "path/to/folder"),
            Purpose::SaveScene => ("Save scene", "Save", "path/to/scene.toml"),
            Purpose::ExportExr => ("Export EXR", "Export", "path/to/render.exr"),
            Purpose::ExportPng => ("Export PNG", "Export", "path/to/render.png"),
        }
    }

    fn explanation(&self) -> &'static str {
        match self.purpose {
            Purpose::OpenScene => {
                "A scene file. Relative paths refer to the working directory of the program."
            }
            Purpose::OpenVolume => "The density of the medium, scaled to length 1 and centred on the origin.",
            Purpose::DensityFile => "Replaces the density; the placement is kept.",
            Purpose::TemperatureFile => "Aligned with the density if both files contain a transform.",
            Purpose::PhaseTable => "A text file with an angle and a value on each line.",
            Purpose::EnvironmentMap(_) => "An equirectangular image, linear sRGB.",
            Purpose::Mesh(_) => "Triangles or polygons as OBJ, PLY or glTF; materials are not read.",
            Purpose::Reference => {
                "An EXR image of this scene; its standard errors are used if it contains any."
            }
            Purpose::ExportReport => {
                "A folder for an HTML page (index.html), all images and maps, one EXR with layers, and tables."
            }
            Purpose::SaveScene => "An existing file is overwritten.",
            Purpose::ExportExr => "Linear radiance, standard error and the scene file, as OpenEXR.",
            Purpose::ExportPng => "The displayed image, with exposure, tone curve and gamma.",
        }
    }
}

/// Shows the open dialog, if any.
pub(super) fn dialog_ui(ctx: &Context, dialog: &mut Option<Dialog>, name: &str, commands: &mut Vec<Command>) {
    let Some(open) = dialog else { return };
    let response =
        Modal::new(Id::unique("dialog")).frame(dialog_frame(&ctx.global_style())).show(ctx, |ui| {
            ui.set_width(480.0);
            ui.spacing_mut().item_spacing.y = 10.0;
            match open {
                Dialog::Path(prompt) => path_ui(ui, prompt, commands),
                Dialog::Unsaved(_) => unsaved_ui(ui, name, commands),
            }
        });
    if response.should_close() {
        commands.push(Command::CloseDialog);
    }
}

fn path_ui(ui: &mut Ui, prompt: &mut PathPrompt, commands: &mut Vec<Command>) {
    let (title, verb, hint) = prompt.words();
    ui.heading(title);
    ui.label(RichText::new(prompt.explanation()).color(Palette::get(ui).weak));
    let edit = TextEdit::singleline(&mut prompt.text).hint_text(hint).desired_width(f32::INFINITY);
    let response = ui.add(edit.margin(vec2(8.0, 6.0))).accessible_name("Path");
    if std::mem::take(&mut prompt.fresh) {
        response.request_focus();
    }
    let entered = response.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
    let typed = prompt.text.trim().to_owned();
    buttons(ui, |ui| {
        let go = ui.add_enabled(!typed.is_empty(), primary(ui, verb));
        if (go.clicked() || entered) && !typed.is_empty() {
            commands.push(Command::Chosen(prompt.purpose, expanded(&typed)));
        }
        if ui.button("Cancel").clicked() {
            commands.push(Command::CloseDialog);
        }
    });
}

/// Expands a leading `~/`, which a shell would have replaced.
fn expanded(typed: &str) -> PathBuf {
    match (typed.strip_prefix("~/"), std::env::home_dir()) {
        (Some(rest), Some(home)) => home.join(rest),
        _ => PathBuf::from(typed),
    }
}

fn unsaved_ui(ui: &mut Ui, name: &str, commands: &mut Vec<Command>) {
    ui.heading(format!("Save the changes to {name}?"));
    ui.label(RichText::new("Unsaved changes will be lost.").color(Palette::get(ui).weak));
    buttons(ui, |ui| {
        if ui.add(primary(ui, "Save")).clicked() {
            commands.push(Command::Answer(Answer::Save));
        }
        if ui.button("Discard").clicked() {
            commands.push(Command::Answer(Answer::Discard));
        }
        if ui.button("Cancel").clicked() {
            commands.push(Command::Answer(Answer::Cancel));
        }
    });
}

fn buttons(ui: &mut Ui, add: impl FnOnce(&mut Ui)) {
    ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
        ui.spacing_mut().button_padding = vec2(14.0, 5.0);
        add(ui);
    });
}

fn primary<'a>(ui: &Ui, text: &'a str) -> Button<'a> {
    let palette = Palette::get(ui);
    Button::new(RichText::new(text).color(palette.strong)).fill(palette.accent_fill)
}
