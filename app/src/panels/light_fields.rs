//! Every field of every kind of light.

use crate::lab::{Command, Purpose};
use crate::widgets::{SpectrumField, Value, Vector, path_field, row, spectrum_editor, switch};
use egui::Ui;
use majorant_core::scene::LightDoc;
use majorant_core::spectrum::{Quantity, SpectrumDoc};

/// Shows the fields of a light. `opened` is the same light in the opened scene, if it was there.
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
        let tip = "An equirectangular EXR or HDR picture, linear sRGB; its top row is +y";
        if path_field(ui, "Picture", &format!("{name} picture"), "sky.exr", file, tip) {
            commands.push(Command::Ask(Purpose::EnvironmentMap(index)));
        }
    }
    geometry_ui(ui, &name, light, opened, &template);
    emission_ui(ui, &name, light, opened, &template);
}

/// Where it is and how large: the fields that differ between kinds. The three lights are of one kind.
fn geometry_ui(ui: &mut Ui, name: &str, light: &mut LightDoc, opened: &LightDoc, template: &LightDoc) {
    use LightDoc::{EnvironmentMap, Rectangle, Sphere, Sun};
    let place = |ui: &mut Ui, label: &str, now: &mut [f32; 3], was, default, tip: &str| {
        let name = format!("{name} {}", label.to_lowercase());
        Vector::new(label, name, now, default).opened(was).tip(tip).show(ui);
    };
    let length = |ui: &mut Ui, label: &str, now: &mut f32, was, default| {
        let value = Value::new(label, now, default).opened(was).range(1e-4..=f64::from(f32::MAX));
        let name = format!("{name} {}", label.to_lowercase());
        value.logarithmic().named(name).tip("In scene units").show(ui);
    };
    match (light, opened, template) {
        (
            Rectangle { center, target, up, size, .. },
            Rectangle { center: c1, target: t1, up: u1, size: s1, .. },
            Rectangle { center: c0, target: t0, up: u0, size: s0, .. },
        ) => {
            place(ui, "Centre", center, *c1, *c0, "Where it is");
            place(ui, "Target", target, *t1, *t0, "The point that its lit side faces");
            place(ui, "Up", up, *u1, *u0, "Direction that its height leans to");
            length(ui, "Width", &mut size[0], s1[0], s0[0]);
            length(ui, "Height", &mut size[1], s1[1], s0[1]);
        }
        (
            Sphere { center, radius, .. },
            Sphere { center: c1, radius: r1, .. },
            Sphere { center: c0, radius: r0, .. },
        ) => {
            place(ui, "Centre", center, *c1, *c0, "Where it is");
            length(ui, "Radius", radius, *r1, *r0);
        }
        (
            Sun { toward, angular_diameter_deg, .. },
            Sun { toward: t1, angular_diameter_deg: d1, .. },
            Sun { toward: t0, angular_diameter_deg: d0, .. },
        ) => {
            place(ui, "Direction", toward, *t1, *t0, "From the scene to the sun");
            let diameter = Value::new("Diameter", angular_diameter_deg, *d0).opened(*d1).unit("°");
            let diameter = diameter.range(0.01..=90.0).logarithmic().named(format!("{name} diameter"));
            diameter.tip("Apparent diameter: 0.53° from the earth").show(ui);
        }
        (
            EnvironmentMap { rotate_deg, .. },
            EnvironmentMap { rotate_deg: r1, .. },
            EnvironmentMap { rotate_deg: r0, .. },
        ) => {
            let turn = Value::new("Turn", rotate_deg, *r0).opened(*r1).unit("°").range(-360.0..=360.0);
            let turn = turn.speed(0.5).named(format!("{name} turn"));
            turn.tip("Turns the picture about the y axis").show(ui);
        }
        _ => {}
    }
}

/// How much it emits: what all kinds share.
fn emission_ui(ui: &mut Ui, name: &str, light: &mut LightDoc, opened: &LightDoc, template: &LightDoc) {
    let (scale_before, spectrum_before) = emission(opened);
    let (scale_default, _) = emission(template);
    let irradiance = matches!(light, LightDoc::Sun { .. });
    let (scale, spectrum, visible) = emission_mut(light);
    let tip = match irradiance {
        true => "E(λ) = scale · irradiance(λ) on a surface that faces the sun",
        false => "Le(λ) = scale · radiance(λ), per scene unit², steradian and nm",
    };
    let value = Value::new("Scale", scale, scale_default).opened(scale_before);
    let value = value.range(0.0..=f64::from(f32::MAX)).logarithmic().named(format!("{name} scale"));
    value.tip(tip).show(ui);
    if let Some(spectrum) = spectrum {
        let quantity = if irradiance { "Irradiance" } else { "Radiance" };
        let text = super::extinction::in_words(spectrum);
        row(ui, quantity, tip, |ui, _| ui.weak(text));
        let now = spectrum.clone();
        let field = SpectrumField {
            name: &format!("{name} {}", quantity.to_lowercase()),
            unit: "",
            max: None,
            tip,
            opened: spectrum_before.unwrap_or(&now),
            quantity: Quantity::Radiance,
            majorant: None,
        };
        let heading = egui::RichText::new(format!("Edit {} by wavelength", quantity.to_lowercase())).small();
        egui::CollapsingHeader::new(heading)
            .id_salt("spectrum")
            .show_unindented(ui, |ui| spectrum_editor(ui, &field, spectrum));
    }
    let tip = "Whether the camera sees it directly; it lights the medium either way";
    switch(ui, "Visible", &format!("{name} visible"), visible, "to the camera", tip);
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
        | LightDoc::Environment { scale, radiance, visible } => (scale, Some(radiance), visible),
        LightDoc::Sun { scale, irradiance, visible, .. } => (scale, Some(irradiance), visible),
        LightDoc::EnvironmentMap { scale, visible, .. } => (scale, None, visible),
    }
}
