//! Title and note of the scene.

use super::{Column, Cx, Panel};
use crate::widgets::{buffered_text, row};
use egui::Ui;

/// Panel of title and note.
pub struct Scene;

impl Panel for Scene {
    fn id(&self) -> &'static str {
        "scene"
    }
    fn title(&self) -> &'static str {
        "About"
    }
    fn column(&self) -> Column {
        Column::Scene
    }
    fn starts_open(&self) -> bool {
        true
    }
    fn summary(&self, cx: &Cx<'_>) -> String {
        cx.draft.title.clone()
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        let note = cx.draft.note.trim();
        if note.is_empty() {
            ui.weak("This scene has no note yet.");
        } else {
            ui.add(egui::Label::new(note).wrap());
        }
        let title = egui::RichText::new("Edit title and note").small();
        egui::CollapsingHeader::new(title).id_salt("edit").show_unindented(ui, |ui| {
            row(ui, "Title", "A short name", |ui, _| {
                let id = ui.make_persistent_id("title");
                buffered_text(ui, id, "Scene title", "Untitled", &mut cx.draft.title, 1);
            });
            let id = ui.make_persistent_id("note");
            buffered_text(ui, id, "Scene note", "What to notice in this scene", &mut cx.draft.note, 4);
        });
    }
}
