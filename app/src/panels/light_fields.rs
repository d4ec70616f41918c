//! Every field of every kind of light.

use crate::lab::{Command, Purpose};
use crate::widgets::{SpectrumField, Value, path_field, row, spectrum_editor, switch, vector};
use egui::Ui;
use majorant_core::scene::LightDoc;
use majorant_core::spectrum::{Quantity, SpectrumDoc};

const RADIANCE: &str = "Le(λ) = scale · radiance(λ), per scene unit², steradian and nm";
const IRRADIANCE: &str = "E(λ) = scale · irradiance(λ) on a surface that faces the sun";

/// Shows the fields of a light. `opened` is the same light in the opened scene, if it was there.
pub fn light_ui(
    ui: &mut Ui,
    light: &mut LightDoc,
    opened: Option<&LightDoc>,
    index: usize,
    commands: &mut Vec<Command>,
) {
    let before = opened.unwrap_or(light).clone();
    let name = format!("Light {}", index + 1);
    match light {
        LightDoc::Rectangle { center, target, up, size, radiance, scale, visible } => {
            vector(ui, "Centre", &format!("{name} centre"), center, 0.01, "", "Where it is");
            vector(
                ui,
                "Faces",
                &format!("{name} target"),
                target,
                0.01,
                "",
                "The point that its lit side faces",
            );
            vector(ui, "Up", &format!("{name} up"), up, 0.01, "", "Direction that its height leans to");
            for (label, length) in ["Width", "Height"].iter().zip(size) {
                length_ui(ui, label, &name, length, 0.6);
            }
            emission_ui(ui, "radiance", RADIANCE, &name, radiance, scale, &before);
            visible_ui(ui, &name, visible);
        }
        LightDoc::Sphere { center, radius, radiance, scale, visible } => {
            vector(ui, "Centre", &format!("{name} centre"), center, 0.01, "", "Where it is");
            length_ui(ui, "Radius", &name, radius, 0.15);
            emission_ui(ui, "radiance", RADIANCE, &name, radiance, scale, &before);
            visible_ui(ui, &name, visible);
        }
        LightDoc::Sun { toward, angular_diameter_deg, irradiance, scale, visible } => {
            vector(
                ui,
                "Direction",
                &format!("{name} direction"),
                toward,
                0.01,
                "",
                "From the scene to the sun",
            );
            Value::new("Diameter", angular_diameter_deg, 0.53)
                .opened(if let LightDoc::Sun { angular_diameter_deg: d, .. } = before { d } else { 0.53 })
                .unit("°")
                .range(0.01..=90.0)
                .logarithmic()
                .named(format!("{name} diameter"))
                .tip("Apparent diameter: 0.53° from the earth")
                .show(ui);
            emission_ui(ui, "irradiance", IRRADIANCE, &name, irradiance, scale, &before);
            visible_ui(ui, &name, visible);
        }
        LightDoc::Environment { radiance, scale, visible } => {
            emission_ui(ui, "radiance", RADIANCE, &name, radiance, scale, &before);
            visible_ui(ui, &name, visible);
        }
        LightDoc::EnvironmentMap { file, rotate_deg, scale, visible } => {
            let tip = "An equirectangular EXR or HDR picture, linear sRGB; its top row is +y";
            if path_field(ui, "Picture", &format!("{name} picture"), "sky.exr", file, tip) {
                commands.push(Command::Ask(Purpose::EnvironmentMap(index)));
            }
            Value::new("Turn", rotate_deg, 0.0)
                .opened(if let LightDoc::EnvironmentMap { rotate_deg: r, .. } = before { r } else { 0.0 })
                .unit("°")
                .range(-360.0..=360.0)
                .speed(0.5)
                .named(format!("{name} turn"))
                .tip("Turns the picture about the y axis")
                .show(ui);
            scale_ui(ui, &name, scale, &before);
            visible_ui(ui, &name, visible);
        }
    }
}

fn length_ui(ui: &mut Ui, label: &str, name: &str, length: &mut f32, default: f32) {
    let opened = *length;
    let value = Value::new(label, length, default).opened(opened).range(1e-4..=f64::from(f32::MAX));
    value.logarithmic().named(format!("{name} {}", label.to_lowercase())).tip("In scene units").show(ui);
}

/// The brightness that the opened scene gave this light.
fn opened_scale(light: &LightDoc) -> f32 {
    match light {
        LightDoc::Rectangle { scale, .. }
        | LightDoc::Sphere { scale, .. }
        | LightDoc::Sun { scale, .. }
        | LightDoc::Environment { scale, .. }
        | LightDoc::EnvironmentMap { scale, .. } => *scale,
    }
}

fn opened_spectrum(light: &LightDoc) -> Option<&SpectrumDoc> {
    match light {
        LightDoc::Rectangle { radiance, .. }
        | LightDoc::Sphere { radiance, .. }
        | LightDoc::Environment { radiance, .. } => Some(radiance),
        LightDoc::Sun { irradiance, .. } => Some(irradiance),
        LightDoc::EnvironmentMap { .. } => None,
    }
}

fn scale_ui(ui: &mut Ui, name: &str, scale: &mut f32, before: &LightDoc) {
    Value::new("Scale", scale, 1.0)
        .opened(opened_scale(before))
        .range(0.0..=f64::from(f32::MAX))
        .logarithmic()
        .named(format!("{name} scale"))
        .tip("Multiplies what it emits")
        .show(ui);
}

fn emission_ui(
    ui: &mut Ui,
    quantity: &str,
    tip: &str,
    name: &str,
    spectrum: &mut SpectrumDoc,
    scale: &mut f32,
    before: &LightDoc,
) {
    scale_ui(ui, name, scale, before);
    let now = spectrum.clone();
    let field = SpectrumField {
        name: &format!("{name} {quantity}"),
        unit: "",
        max: None,
        tip,
        opened: opened_spectrum(before).unwrap_or(&now),
        quantity: Quantity::Radiance,
        majorant: None,
    };
    let title = if quantity == "radiance" { "Radiance" } else { "Irradiance" };
    row(ui, title, tip, |ui, _| ui.weak(super::extinction::in_words(&now)));
    let heading = egui::RichText::new(format!("Edit {quantity} by wavelength")).small();
    egui::CollapsingHeader::new(heading)
        .id_salt("spectrum")
        .show_unindented(ui, |ui| spectrum_editor(ui, &field, spectrum));
}

fn visible_ui(ui: &mut Ui, name: &str, visible: &mut bool) {
    let tip = "Whether the camera sees it directly; it lights the medium either way";
    ui.push_id(name, |ui| switch(ui, "Visible", visible, "to the camera", tip));
}
