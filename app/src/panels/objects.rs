//! Diffuse surfaces that receive and block light.

use super::lights::{Change, add_ui, card_ui};
use super::{Column, Cx, Panel};
use crate::widgets::{SpectrumField, Vector, hint, key, row, spectrum_editor, switch};
use egui::Ui;
use majorant_core::scene::ObjectDoc;
use majorant_core::scene::keys::Key;
use majorant_core::spectrum::{Quantity, SpectrumDoc};

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
            [one] => one.kind_name().to_lowercase(),
            more => more.len().to_string(),
        }
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        if cx.draft.objects.is_empty() {
            hint(ui, "No objects. A ground plane receives the shadow of the medium.");
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
    let show = |ui: &mut Ui, key: &'static Key, now: &mut [f32; 3], was, default| {
        let name = format!("{name} {}", key.label.to_lowercase());
        Vector::of(key, name, now).defaulting_to(default).opened(was).show(ui);
    };
    let enabled = key("objects.*.enabled");
    let label = format!("{name} enabled");
    switch(ui, enabled.label, &label, object.enabled_mut(), "part of the scene", enabled.tip);
    // All three are of the same kind.
    match (object, opened, &template) {
        (
            ObjectDoc::Ground { point, normal, albedo, .. },
            ObjectDoc::Ground { point: p1, normal: n1, albedo: a1, .. },
            ObjectDoc::Ground { point: p0, normal: n0, .. },
        ) => {
            show(ui, key("objects.*.point"), point, *p1, *p0);
            show(ui, key("objects.*.normal"), normal, *n1, *n0);
            albedo_ui(ui, &name, albedo, a1);
        }
        (
            ObjectDoc::Box { center, size, rotate_deg, albedo, .. },
            ObjectDoc::Box { center: c1, size: s1, rotate_deg: r1, albedo: a1, .. },
            ObjectDoc::Box { center: c0, size: s0, rotate_deg: r0, .. },
        ) => {
            show(ui, key("objects.*.center"), center, *c1, *c0);
            show(ui, key("objects.*.size"), size, *s1, *s0);
            show(ui, key("objects.*.rotate_deg"), rotate_deg, *r1, *r0);
            albedo_ui(ui, &name, albedo, a1);
        }
        _ => {}
    }
}

fn albedo_ui(ui: &mut Ui, name: &str, albedo: &mut SpectrumDoc, opened: &SpectrumDoc) {
    let key = key("objects.*.albedo");
    let text = super::extinction::in_words(albedo);
    row(ui, key.label, key.tip, |ui, _| ui.weak(text));
    let field = SpectrumField {
        name: &format!("{name} albedo"),
        key,
        opened,
        quantity: Quantity::Coefficient,
        majorant: None,
    };
    spectrum_editor(ui, &field, albedo);
}
