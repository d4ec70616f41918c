//! Objects: surfaces that block, reflect and emit light, and boundaries of media.

use super::lights::{Change, add_ui, card_ui};
use super::object_fields::object_ui;
use super::{Column, Cx, Panel};
use crate::model::{Command, Purpose};
use crate::widgets::hint;
use egui::Ui;
use majorant_core::scene::{ObjectDoc, ShapeDoc};

/// Panel of the objects.
pub struct Objects;

impl Panel for Objects {
    fn id(&self) -> &'static str {
        "objects"
    }
    fn title(&self) -> &'static str {
        "Objects"
    }
    fn column(&self) -> Column {
        Column::Scene
    }
    fn summary(&self, cx: &Cx<'_>) -> String {
        match cx.draft.objects.as_slice() {
            [] => "none".into(),
            [one] => one.shape.kind_name().to_lowercase(),
            more => more.len().to_string(),
        }
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        if cx.draft.objects.is_empty() {
            hint(ui, "No objects. A ground plane receives the shadow of the medium.");
        }
        let mut change = None;
        for index in 0..cx.draft.objects.len() {
            let object = &cx.draft.objects[index];
            let kind = object.shape.kind_name();
            let title = if object.name.is_empty() { kind.to_owned() } else { object.name.clone() };
            let made = card_ui(ui, "object", index, &title, |ui| object_ui(ui, cx, index));
            if let Some(made) = made {
                change = Some((index, made));
            }
        }
        match change {
            Some((index, Change::Remove)) => cx.draft.remove_object(index),
            Some((index, Change::Duplicate)) => {
                let mut copy = cx.draft.objects[index].clone();
                copy.name = cx.draft.free_object_name(&copy.name);
                cx.draft.objects.insert(index + 1, copy);
            }
            None => {}
        }
        add_ui(ui, "Add object", ObjectDoc::templates(), |mut object| {
            // A mesh without a file cannot be rendered, so that the path entry opens immediately.
            if matches!(object.shape, ShapeDoc::Mesh { .. }) {
                cx.commands.push(Command::Ask(Purpose::Mesh(cx.draft.objects.len())));
            }
            if object.shape.has_inside() {
                // Media within an object refer to its name.
                object.name = cx.draft.free_object_name(&object.shape.kind_name().to_lowercase());
            }
            cx.draft.objects.push(object);
        });
    }
}
