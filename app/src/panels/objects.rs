//! Diffuse surfaces that receive and block light.

use super::lights::{Change, add_ui, card_ui};
use super::{Column, Cx, Panel};
use crate::widgets::{SpectrumField, Vector, hint, row, spectrum_editor};
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
            let before = cx.opened.objects.get(index).filter(|o| o.kind_name() == title);
            let made = card_ui(ui, "object", index, title, |ui| object_ui(ui, object, before, index));
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

fn object_ui(ui: &mut Ui, object: &mut ObjectDoc, opened: Option<&ObjectDoc>, index: usize) {
    let name = format!("Object {}", index + 1);
    let templates = ObjectDoc::templates().into_iter().map(|(_, template)| template);
    let Some(template) = templates.into_iter().find(|t| t.kind_name() == object.kind_name()) else { return };
    let opened = opened.unwrap_or(&template);
    let place = |label, now| (label, format!("{name} {}", str::to_lowercase(label)), now);
    let show = |ui: &mut Ui, (label, name, now): (&str, String, &mut [f32; 3]), was, default, tip: &str| {
        let row = Vector::new(label, name, now, default).opened(was).tip(tip);
        if label == "Rotation" { row.degrees().show(ui) } else { row.show(ui) }
    };
    // All three are of one kind.
    match (object, opened, &template) {
        (
            ObjectDoc::Ground { point, normal, albedo },
            ObjectDoc::Ground { point: p1, normal: n1, albedo: a1 },
            ObjectDoc::Ground { point: p0, normal: n0, .. },
        ) => {
            show(ui, place("Point", point), *p1, *p0, "A point on the plane");
            show(ui, place("Normal", normal), *n1, *n0, "The direction that its top faces");
            albedo_ui(ui, &name, albedo, a1);
        }
        (
            ObjectDoc::Box { center, size, rotate_deg, albedo },
            ObjectDoc::Box { center: c1, size: s1, rotate_deg: r1, albedo: a1 },
            ObjectDoc::Box { center: c0, size: s0, rotate_deg: r0, .. },
        ) => {
            show(ui, place("Centre", center), *c1, *c0, "Where it is");
            show(ui, place("Size", size), *s1, *s0, "Edge lengths");
            show(ui, place("Rotation", rotate_deg), *r1, *r0, "Turns about x, then y, then z");
            albedo_ui(ui, &name, albedo, a1);
        }
        _ => {}
    }
}

fn albedo_ui(ui: &mut Ui, name: &str, albedo: &mut SpectrumDoc, opened: &SpectrumDoc) {
    let tip = "Reflected share of the light that arrives, 0 to 1";
    let text = super::extinction::in_words(albedo);
    row(ui, "Albedo", tip, |ui, _| ui.weak(text));
    let field = SpectrumField {
        name: &format!("{name} albedo"),
        unit: "",
        max: Some(1.0),
        tip,
        opened,
        quantity: Quantity::Coefficient,
        majorant: None,
    };
    spectrum_editor(ui, &field, albedo);
}
