//! Editors for the fields of every kind of object.

use super::Cx;
use super::material_fields::{material_ui, priority_ui, spectrum_ui};
use super::placement::placement_ui;
use crate::model::{Command, Purpose};
use crate::widgets::{Value, Vector, buffered_text, hint, key, path_field, row_of, switch};
use egui::Ui;
use majorant_core::scene::keys::Key;
use majorant_core::scene::{MaterialDoc, ObjectDoc, ShapeDoc, SurfaceEmissionDoc, Within};
use majorant_core::spectrum::Quantity;

/// Shows the fields of an object.
pub fn object_ui(ui: &mut Ui, cx: &mut Cx<'_>, index: usize) {
    let name = format!("Object {}", index + 1);
    let kind = cx.draft.objects[index].shape.kind_name();
    let templates = ObjectDoc::templates().into_iter().map(|(_, template)| template);
    let Some(template) = templates.into_iter().find(|t| t.shape.kind_name() == kind) else { return };
    let opened = cx.opened.objects.get(index).filter(|o| o.shape.kind_name() == kind).unwrap_or(&template);
    name_ui(ui, cx, index, &name);
    let object = &mut cx.draft.objects[index];
    let enabled = key("objects.*.enabled");
    let label = format!("{name} enabled");
    switch(ui, enabled.label, &label, &mut object.enabled, "part of the scene", enabled.tip);
    if let ShapeDoc::Mesh { file, .. } = &mut object.shape {
        let key = key("objects.*.file");
        if path_field(ui, key.label, &format!("{name} mesh"), "lantern.ply", file, key.tip) {
            cx.commands.push(Command::Ask(Purpose::Mesh(index)));
        }
    }
    let info = cx.state.scene.as_ref().and_then(|scene| scene.objects.get(index));
    if let Some(info) = info.filter(|info| info.triangles > 0) {
        let (triangles, vertices) = (info.triangles, info.vertices);
        let megabytes = info.memory_bytes as f64 / 1e6;
        hint(ui, &format!("{triangles} triangles, {vertices} vertices, {megabytes:.1} MB."));
    }
    let object = &mut cx.draft.objects[index];
    shape_ui(ui, &name, &mut object.shape, &opened.shape, &template.shape);
    material_ui(ui, &name, &mut object.material, &opened.material);
    if matches!(object.material, MaterialDoc::Dielectric { .. }) {
        priority_ui(ui, &name, &mut object.priority, opened.priority);
    }
    if object.material != (MaterialDoc::Interface {}) && !matches!(object.shape, ShapeDoc::Ground { .. }) {
        emission_ui(ui, &name, &mut object.emission, opened.emission.as_ref());
    }
    let inside = Within::Object(object.name.clone());
    let bounds_a_medium = cx.draft.media.iter().any(|medium| medium.within == inside);
    if cx.draft.objects[index].material == (MaterialDoc::Interface {}) && !bounds_a_medium {
        hint(ui, "Without effect until a medium is within this object (Media, Within).");
    }
}

/// Shows the name, by which media refer to the object.
fn name_ui(ui: &mut Ui, cx: &mut Cx<'_>, index: usize, label: &str) {
    row_of(ui, key("objects.*.name"), |ui, _| {
        let id = ui.make_persistent_id(("object name", index));
        let mut name = cx.draft.objects[index].name.clone();
        buffered_text(ui, id, &format!("{label} name"), "none", &mut name, 1);
        let taken = cx.draft.object_named(&name).is_some_and(|(other, _)| other != index);
        let refers = Within::Object(cx.draft.objects[index].name.clone());
        let needed = name.is_empty() && cx.draft.media.iter().any(|medium| medium.within == refers);
        if !taken && !needed && !Within::RESERVED.contains(&name.as_str()) {
            cx.draft.rename_object(index, name);
        }
    });
}

/// Shows position and size, which differ between kinds. All three shapes are of the same kind.
fn shape_ui(ui: &mut Ui, name: &str, shape: &mut ShapeDoc, opened: &ShapeDoc, template: &ShapeDoc) {
    use ShapeDoc::{Box, Disk, Ground, Mesh, Rectangle, Sphere};
    let place = |ui: &mut Ui, key: &'static Key, now: &mut [f32; 3], was, default| {
        let name = format!("{name} {}", key.label.to_lowercase());
        Vector::of(key, name, now).defaulting_to(default).opened(was).show(ui);
    };
    let length = |ui: &mut Ui, key: &'static Key, label: &str, now: &mut f32, was, default| {
        let value = Value::of(key, now).labelled(label).defaulting_to(default).opened(was).within(1e-4..=1e9);
        value.logarithmic().named(format!("{name} {}", label.to_lowercase())).show(ui);
    };
    match (shape, opened, template) {
        (Ground { point, normal }, Ground { point: p1, normal: n1 }, Ground { point: p0, normal: n0 }) => {
            place(ui, key("objects.*.point"), point, *p1, *p0);
            place(ui, key("objects.*.normal"), normal, *n1, *n0);
        }
        (
            Box { center, size, rotate_deg },
            Box { center: c1, size: s1, rotate_deg: r1 },
            Box { center: c0, size: s0, rotate_deg: r0 },
        ) => {
            place(ui, key("objects.*.center"), center, *c1, *c0);
            place(ui, key("objects.*.size"), size, *s1, *s0);
            place(ui, key("objects.*.rotate_deg"), rotate_deg, *r1, *r0);
        }
        (Sphere { center, radius }, Sphere { center: c1, radius: r1 }, Sphere { center: c0, radius: r0 }) => {
            place(ui, key("objects.*.center"), center, *c1, *c0);
            length(ui, key("objects.*.radius"), "Radius", radius, *r1, *r0);
        }
        (
            Disk { center, normal, radius },
            Disk { center: c1, normal: n1, radius: r1 },
            Disk { center: c0, normal: n0, radius: r0 },
        ) => {
            place(ui, key("objects.*.center"), center, *c1, *c0);
            place(ui, key("objects.*.normal"), normal, *n1, *n0);
            length(ui, key("objects.*.radius"), "Radius", radius, *r1, *r0);
        }
        (
            Rectangle { center, target, up, size },
            Rectangle { center: c1, target: t1, up: u1, size: s1 },
            Rectangle { center: c0, target: t0, up: u0, size: s0 },
        ) => {
            place(ui, key("objects.*.center"), center, *c1, *c0);
            place(ui, key("objects.*.target"), target, *t1, *t0);
            place(ui, key("objects.*.up"), up, *u1, *u0);
            length(ui, key("objects.*.size"), "Width", &mut size[0], s1[0], s0[0]);
            length(ui, key("objects.*.size"), "Height", &mut size[1], s1[1], s0[1]);
        }
        (Mesh { placement, .. }, Mesh { placement: opened, .. }, _) => {
            placement_ui(ui, name, placement, opened);
        }
        _ => {}
    }
}

/// Shows whether the surface emits light, and its radiance.
fn emission_ui(
    ui: &mut Ui,
    name: &str,
    emission: &mut Option<SurfaceEmissionDoc>,
    opened: Option<&SurfaceEmissionDoc>,
) {
    let mut emits = emission.is_some();
    let tip = "Makes the surface an area light, on its outer side";
    switch(ui, "Emission", &format!("{name} emits"), &mut emits, "emits light", tip);
    if emits != emission.is_some() {
        *emission = emits.then(|| opened.cloned().unwrap_or_default());
    }
    let Some(emission) = emission else { return };
    let default = SurfaceEmissionDoc::default();
    let before = opened.unwrap_or(&default);
    let scale = Value::of(key("objects.*.emission.scale"), &mut emission.scale).opened(before.scale);
    scale.logarithmic().named(format!("{name} scale")).show(ui);
    let radiance = (&mut emission.radiance, &before.radiance);
    spectrum_ui(
        ui,
        &format!("{name} radiance"),
        key("objects.*.emission.radiance"),
        radiance,
        Quantity::Radiance,
    );
    let visible = key("objects.*.emission.visible");
    switch(
        ui,
        visible.label,
        &format!("{name} visible"),
        &mut emission.visible,
        "to the camera",
        visible.tip,
    );
}
