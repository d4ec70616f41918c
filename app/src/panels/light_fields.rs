//! Editors for the fields of every kind of light.

use crate::model::{Command, Purpose};
use crate::widgets::{SpectrumField, Value, Vector, key, path_field, row, spectrum_editor, switch};
use egui::Ui;
use majorant_core::scene::LightDoc;
use majorant_core::scene::keys::Key;
use majorant_core::spectrum::{Quantity, SpectrumDoc};

/// Shows the fields of a light. `opened` is the same light in the opened scene, if it exists.
pub fn light_ui(
    ui: &mut Ui,
    light: &mut LightDoc,
    opened: Option<&LightDoc>,
    index: usize,
    commands: &mut Vec<Command>,
) {
    let name = format!("Light {}", index + 1);
    let templates = LightDoc::templates().into_iter().map(|(_, template)| template);
    let template = templates.into_iter().find(|t| t.kind_name() == light.kind_name()).unwrap_or_default();
    let opened = opened.unwrap_or(&template);
    if let LightDoc::EnvironmentMap { file, .. } = light {
        let key = key("lights.*.file");
        if path_field(ui, key.label, &format!("{name} image"), "sky.exr", file, key.tip) {
            commands.push(Command::Ask(Purpose::EnvironmentMap(index)));
        }
    }
    geometry_ui(ui, &name, light, opened, &template);
    emission_ui(ui, &name, light, opened, &template);
}

/// Shows position and size, which differ between kinds. All three lights are of the same kind.
fn geometry_ui(ui: &mut Ui, name: &str, light: &mut LightDoc, opened: &LightDoc, template: &LightDoc) {
    use LightDoc::{EnvironmentMap, Rectangle, Sphere, Sun};
    let place = |ui: &mut Ui, key: &'static Key, now: &mut [f32; 3], was, default| {
        let name = format!("{name} {}", key.label.to_lowercase());
        Vector::of(key, name, now).defaulting_to(default).opened(was).show(ui);
    };
    let length = |ui: &mut Ui, key: &'static Key, label: &str, now: &mut f32, was, default| {
        let value = Value::of(key, now).labelled(label).defaulting_to(default).opened(was).within(1e-4..=1e9);
        value.logarithmic().named(format!("{name} {}", label.to_lowercase())).show(ui);
    };
    match (light, opened, template) {
        (
            Rectangle { center, target, up, size, .. },
            Rectangle { center: c1, target: t1, up: u1, size: s1, .. },
            Rectangle { center: c0, target: t0, up: u0, size: s0, .. },
        ) => {
            place(ui, key("lights.*.center"), center, *c1, *c0);
            place(ui, key("lights.*.target"), target, *t1, *t0);
            place(ui, key("lights.*.up"), up, *u1, *u0);
            length(ui, key("lights.*.size"), "Width", &mut size[0], s1[0], s0[0]);
            length(ui, key("lights.*.size"), "Height", &mut size[1], s1[1], s0[1]);
        }
        (
            Sphere { center, radius, .. },
            Sphere { center: c1, radius: r1, .. },
            Sphere { center: c0, radius: r0, .. },
        ) => {
            place(ui, key("lights.*.center"), center, *c1, *c0);
            length(ui, key("lights.*.radius"), "Radius", radius, *r1, *r0);
        }
        (
            Sun { toward, angular_diameter_deg, .. },
            Sun { toward: t1, angular_diameter_deg: d1, .. },
            Sun { toward: t0, angular_diameter_deg: d0, .. },
        ) => {
            place(ui, key("lights.*.toward"), toward, *t1, *t0);
            let diameter = Value::of(key("lights.*.angular_diameter_deg"), angular_diameter_deg);
            let diameter = diameter.defaulting_to(*d0).opened(*d1).logarithmic();
            diameter.named(format!("{name} diameter")).show(ui);
        }
        (
            EnvironmentMap { rotate_deg, .. },
            EnvironmentMap { rotate_deg: r1, .. },
            EnvironmentMap { rotate_deg: r0, .. },
        ) => {
            let turn = Value::of(key("lights.*.rotate_deg"), rotate_deg).defaulting_to(*r0).opened(*r1);
            turn.within(-360.0..=360.0).speed(0.5).named(format!("{name} rotation")).show(ui);
        }
        _ => {}
    }
}

/// Shows the emission, which all kinds share.
fn emission_ui(ui: &mut Ui, name: &str, light: &mut LightDoc, opened: &LightDoc, template: &LightDoc) {
    let (scale_before, spectrum_before) = emission(opened);
    let (scale_default, _) = emission(template);
    let irradiance = matches!(light, LightDoc::Sun { .. });
    let (scale, spectrum, visible) = emission_mut(light);
    let emitted = if irradiance { key("lights.*.irradiance") } else { key("lights.*.radiance") };
    let value = Value::of(key("lights.*.scale"), scale).defaulting_to(scale_default).opened(scale_before);
    value.logarithmic().named(format!("{name} scale")).show(ui);
    if let Some(spectrum) = spectrum {
        let quantity = emitted.label;
        let text = super::extinction::in_words(spectrum);
        row(ui, quantity, emitted.tip, |ui, _| ui.weak(text));
        let now = spectrum.clone();
        let field = SpectrumField {
            name: &format!("{name} {}", quantity.to_lowercase()),
            key: emitted,
            opened: spectrum_before.unwrap_or(&now),
            quantity: Quantity::Radiance,
            majorant: None,
        };
        let heading = egui::RichText::new(format!("Edit {} by wavelength", quantity.to_lowercase())).small();
        egui::CollapsingHeader::new(heading)
            .id_salt("spectrum")
            .show_unindented(ui, |ui| spectrum_editor(ui, &field, spectrum));
    }
    let key = key("lights.*.visible");
    switch(ui, key.label, &format!("{name} visible"), visible, "to the camera", key.tip);
    let key = self::key("lights.*.enabled");
    switch(ui, key.label, &format!("{name} enabled"), light.enabled_mut(), "part of the scene", key.tip);
}

fn emission(light: &LightDoc) -> (f32, Option<&SpectrumDoc>) {
    match light {
        LightDoc::Rectangle { scale, radiance, .. }
        | LightDoc::Sphere { scale, radiance, .. }
        | LightDoc::Environment { scale, radiance, .. } => (*scale, Some(radiance)),
        LightDoc::Sun { scale, irradiance, .. } => (*scale, Some(irradiance)),
        LightDoc::EnvironmentMap { scale, .. } => (*scale, None),
    }
}

fn emission_mut(light: &mut LightDoc) -> (&mut f32, Option<&mut SpectrumDoc>, &mut bool) {
    match light {
        LightDoc::Rectangle { scale, radiance, visible, .. }
        | LightDoc::Sphere { scale, radiance, visible, .. }
        | LightDoc::Environment { scale, radiance, visible, .. } => (scale, Some(radiance), visible),
        LightDoc::Sun { scale, irradiance, visible, .. } => (scale, Some(irradiance), visible),
        LightDoc::EnvironmentMap { scale, visible, .. } => (scale, None, visible),
    }
}
