//! Diffuse surfaces that receive and block light.

use super::lights::{Change, add_ui, card_ui};
use super::{Column, Cx, Panel};
use crate::widgets::{SpectrumField, hint, spectrum_editor, vector};
use egui::Ui;
use majorant_core::scene::ObjectDoc;
use majorant_core::spectrum::{Quantity, SpectrumDoc};

/// See the [module](self).
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
            [one] => one.kind_name().to_lowercase(),
            more => more.len().to_string(),
        }
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        if cx.draft.objects.is_empty() {
            hint(ui, "No object. A ground plane catches the medium's shadow.");
        }
        let mut change = None;
        for (index, object) in cx.draft.objects.iter_mut().enumerate() {
            let title = object.kind_name();
            let made = card_ui(ui, "object", index, title, |ui| object_ui(ui, object, index));
            if let Some(made) = made {
                change = Some((index, made));
            }
        }
        match change {
            Some((index, Change::Remove)) => {
                cx.draft.objects.remove(index);
            }
            Some((index, Change::Duplicate)) => {
                let copy = cx.draft.objects[index].clone();
                cx.draft.objects.insert(index + 1, copy);
            }
            None => {}
        }
        add_ui(ui, "Add object", ObjectDoc::templates(), |object| cx.draft.objects.push(object));
    }
}

fn object_ui(ui: &mut Ui, object: &mut ObjectDoc, index: usize) {
    let name = format!("Object {}", index + 1);
    match object {
        ObjectDoc::Ground { point, normal, albedo } => {
            vector(ui, "Point", &format!("{name} point"), point, 0.01, "", "A point on the plane");
            vector(
                ui,
                "Normal",
                &format!("{name} normal"),
                normal,
                0.01,
                "",
                "The direction that its top faces",
            );
            albedo_ui(ui, &name, albedo);
        }
        ObjectDoc::Box { center, size, rotate_deg, albedo } => {
            vector(ui, "Centre", &format!("{name} centre"), center, 0.01, "", "Where it is");
            vector(ui, "Size", &format!("{name} size"), size, 0.01, "", "Edge lengths");
            vector(
                ui,
                "Rotate",
                &format!("{name} rotation"),
                rotate_deg,
                0.5,
                "°",
                "Turns about x, then y, then z",
            );
            albedo_ui(ui, &name, albedo);
        }
    }
}

fn albedo_ui(ui: &mut Ui, name: &str, albedo: &mut SpectrumDoc) {
    let before = albedo.clone();
    let field = SpectrumField {
        name: &format!("{name} albedo"),
        unit: "",
        max: Some(1.0),
        tip: "Reflected share of the light that arrives, 0 to 1",
        opened: &before,
        quantity: Quantity::Coefficient,
        majorant: None,
    };
    spectrum_editor(ui, &field, albedo);
}
