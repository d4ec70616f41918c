//! The menu bar.

use super::shortcuts::keys_of;
use super::{Command, LabApp, Purpose};
use crate::lessons;
use crate::model::Source;
use crate::model::WallEdit;
use crate::model::{Arrangement, WindowDoc};
use crate::theme::Palette;
use crate::wall::presets::PRESETS;
use egui::{Align, Button, Checkbox, Label, Layout, MenuBar, RichText, ThemePreference, Ui};
use majorant_core::io::embedded;
use majorant_core::scene::ToneCurve;

type Commands = Vec<Command>;

impl LabApp {
    pub(super) fn menu_ui(&self, ui: &mut Ui, commands: &mut Commands) {
        MenuBar::new().ui(ui, |ui| {
            ui.menu_button("File", |ui| self.file_ui(ui, commands));
            ui.menu_button("Edit", |ui| {
                item_if(ui, self.document.can_undo(), "Undo", Command::Undo, commands);
                item_if(ui, self.document.can_redo(), "Redo", Command::Redo, commands);
            });
            ui.menu_button("View", |ui| self.view_ui(ui, commands));
            ui.menu_button("Compare", |ui| self.compare_ui(ui, commands));
            ui.menu_button("Lessons", |ui| self.lessons_ui(ui, commands));
            ui.menu_button("Inspect", |ui| {
                for tab in crate::wall::dock::TABS.iter().filter(|tab| tab.for_one_view()) {
                    item(ui, tab.title(), Command::ShowTab(tab.id()), commands);
                }
            });
            ui.menu_button("Help", |ui| {
                item(ui, "Keys and gestures", Command::ToggleShortcuts, commands);
                item(ui, "Self-check…", Command::OpenSelfCheck, commands);
            });
            self.title_ui(ui);
        });
    }

    fn file_ui(&self, ui: &mut Ui, commands: &mut Commands) {
        item(ui, "New", Command::Open(Source::New), commands);
        item(ui, "Open scene…", Command::Ask(Purpose::OpenScene), commands);
        item(ui, "Open volume…", Command::Ask(Purpose::OpenVolume), commands);
        ui.menu_button("Recent", |ui| {
            if self.settings.recent.is_empty() {
                ui.weak("No scene file was opened yet.");
            }
            for path in &self.settings.recent {
                let name = path.file_name().map_or_else(|| path.to_string_lossy(), |n| n.to_string_lossy());
                if ui.button(name).on_hover_text(path.to_string_lossy()).clicked() {
                    commands.push(Command::Open(Source::File(path.clone())));
                    ui.close();
                }
            }
        });
        ui.menu_button("Embedded scenes", |ui| {
            for scene in embedded::SCENES {
                if ui.button(scene.name).on_hover_text(scene.summary()).clicked() {
                    commands.push(Command::Open(Source::Embedded(scene.name.to_owned())));
                    ui.close();
                }
            }
        });
        ui.separator();
        item(ui, "Save", Command::Save, commands);
        item(ui, "Save as…", Command::Ask(Purpose::SaveScene), commands);
        ui.separator();
        item(ui, "Export EXR…", Command::Ask(Purpose::ExportExr), commands);
        item(ui, "Export PNG…", Command::Ask(Purpose::ExportPng), commands);
        item(ui, "Export comparison…", Command::Ask(Purpose::ExportReport), commands);
        ui.separator();
        item(ui, "Quit", Command::Quit, commands);
    }

    fn view_ui(&self, ui: &mut Ui, commands: &mut Commands) {
        item(ui, "Fit image", Command::Fit, commands);
        item(ui, "Image at 100 %", Command::Zoom(1.0), commands);
        ui.separator();
        item(ui, "Half a stop brighter", Command::Expose(0.5), commands);
        item(ui, "Half a stop darker", Command::Expose(-0.5), commands);
        ui.menu_button("Tone curve", |ui| {
            for (tone, name) in [
                (ToneCurve::Linear, "Linear"),
                (ToneCurve::Reinhard, "Reinhard"),
                (ToneCurve::Filmic, "Filmic"),
            ] {
                if ui.radio(self.doc().view.tone == tone, name).clicked() {
                    let mut doc = self.doc().clone();
                    doc.view.tone = tone;
                    commands.push(Command::Edit(Box::new(doc)));
                    ui.close();
                }
            }
        });
        ui.separator();
        let mut cells = self.settings.majorant_slice.is_some();
        if ui
            .checkbox(&mut cells, "Majorant cells")
            .on_hover_text("Shows the tightness of the local majorants  (M)")
            .clicked()
        {
            commands.push(Command::ToggleMajorants);
        }
        ui.separator();
        let (reading, method) = (self.lesson.is_some(), self.method_shown());
        let columns = [
            ("Scene column", !reading, self.settings.scene_column && !reading, Command::ToggleSceneColumn),
            ("Method column", true, method, Command::ToggleMethodColumn),
        ];
        for (name, possible, mut shown, command) in columns {
            if ui.add_enabled(possible, Checkbox::new(&mut shown, name)).clicked() {
                commands.push(command);
            }
        }
        ui.separator();
        let mut large = self.settings.large_type;
        if ui.checkbox(&mut large, "Large text, for projectors").clicked() {
            commands.push(Command::ToggleLargeType);
        }
        ui.separator();
        for (theme, name) in [
            (ThemePreference::Dark, "Dark theme"),
            (ThemePreference::Light, "Light theme"),
            (ThemePreference::System, "Theme of the system"),
        ] {
            if ui.radio(self.settings.theme == theme, name).clicked() {
                commands.push(Command::Theme(theme));
                ui.close();
            }
        }
    }

    /// Lists every lesson, with a mark on finished and started ones.
    fn lessons_ui(&self, ui: &mut Ui, commands: &mut Commands) {
        for lesson in lessons::embedded().iter().chain(&self.own_lessons) {
            let reached = self.settings.lessons.get(&lesson.id).copied().unwrap_or(0);
            let mark = match reached {
                0 => "    ",
                n if n >= lesson.steps.len() => "✔ ",
                _ => "›  ",
            };
            if ui.button(format!("{mark}{}", lesson.title)).on_hover_text(&lesson.about).clicked() {
                commands.push(Command::OpenLesson(lesson.id.clone()));
                ui.close();
            }
        }
    }

    fn compare_ui(&self, ui: &mut Ui, commands: &mut Commands) {
        for preset in PRESETS {
            if ui.button(preset.name).on_hover_text(preset.about).clicked() {
                commands.push(Command::OpenPreset(preset.name));
                ui.close();
            }
        }
        ui.separator();
        for count in [1, 2, 3, 4, 6, 8] {
            let text = if count == 1 { "One view".to_owned() } else { format!("{count} views") };
            if ui.radio(self.doc().view_count() == count, text).clicked() {
                commands.push(Command::Wall(WallEdit::Count(count)));
                ui.close();
            }
        }
        ui.separator();
        let several = self.doc().view_count() > 1;
        item_if(ui, several, "Wipe", Command::Arrange(Arrangement::Wipe), commands);
        item_if(ui, several, "Difference", Command::Arrange(Arrangement::Difference), commands);
        item_if(ui, several, "Flip", Command::Flip, commands);
        ui.separator();
        let mut own = WindowDoc::of(self.doc()).own_zoom;
        if ui.checkbox(&mut own, "Separate zoom for each view").clicked() {
            commands.push(Command::Wall(WallEdit::OwnZoom(own)));
        }
        item(ui, "Numbers", Command::ToggleDock, commands);
        item(ui, "Export report…", Command::Ask(Purpose::ExportReport), commands);
        item(ui, "Load reference…", Command::Ask(Purpose::Reference), commands);
    }

    /// Shows the scene's name at the right end of the bar, with a mark if there are unsaved changes.
    fn title_ui(&self, ui: &mut Ui) {
        let palette = Palette::get(ui);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add_space(8.0);
            if self.is_modified() {
                let mark = RichText::new("● unsaved").small().color(palette.warning);
                ui.add(Label::new(mark).selectable(false))
                    .on_hover_text("There are changes to save  (Ctrl + S)");
            }
            let title = RichText::new(self.name()).color(palette.strong);
            let response = ui.add(Label::new(title).truncate().selectable(false));
            if let Some(path) = self.document.path() {
                response.on_hover_text(path.to_string_lossy());
            }
        });
    }
}

fn item(ui: &mut Ui, text: &str, command: Command, commands: &mut Commands) {
    item_if(ui, true, text, command, commands);
}

fn item_if(ui: &mut Ui, enabled: bool, text: &str, command: Command, commands: &mut Commands) {
    let keys = keys_of(ui.ctx(), &command);
    let button = Button::new(text).shortcut_text(keys);
    if ui.add_enabled(enabled, button).accessible_name(text).clicked() {
        commands.push(command);
        ui.close();
    }
}
