//! Editors for the fields of every kind of material.

use crate::widgets::{SpectrumField, Value, key, row, row_of, segmented, spectrum_editor};
use egui::{ComboBox, Ui};
use majorant_core::material::Metal;
use majorant_core::scene::keys::Key;
use majorant_core::scene::{IorDoc, MaterialDoc};
use majorant_core::spectrum::{Quantity, SpectrumDoc};

/// Shows kind and fields of a material. `name` is that of the object.
pub fn material_ui(ui: &mut Ui, name: &str, material: &mut MaterialDoc, opened: &MaterialDoc) {
    row_of(ui, key("objects.*.material.kind"), |ui, _| {
        let combo = ComboBox::from_id_salt((name, "material")).width(ui.available_width());
        let shown = combo.selected_text(material.kind_name()).show_ui(ui, |ui| {
            for (kind, template) in MaterialDoc::templates() {
                let label = ui.selectable_label(material.kind_name() == kind, kind);
                if label.on_hover_text(about(&template)).clicked() && material.kind_name() != kind {
                    *material = template;
                }
            }
        });
        shown.response.accessible_name(format!("{name} material"));
    });
    match material {
        MaterialDoc::Diffuse { albedo } => {
            let now = albedo.clone();
            let before = if let MaterialDoc::Diffuse { albedo } = opened { albedo } else { &now };
            let field = (albedo, before);
            spectrum_ui(
                ui,
                &format!("{name} albedo"),
                key("objects.*.material.albedo"),
                field,
                Quantity::Coefficient,
            );
        }
        MaterialDoc::Mirror { reflectance } => {
            let now = reflectance.clone();
            let before = if let MaterialDoc::Mirror { reflectance } = opened { reflectance } else { &now };
            let key = key("objects.*.material.reflectance");
            spectrum_ui(
                ui,
                &format!("{name} reflectance"),
                key,
                (reflectance, before),
                Quantity::Coefficient,
            );
        }
        MaterialDoc::Conductor { preset, eta, k, roughness } => {
            metal_ui(ui, name, preset, (eta, k));
            roughness_ui(ui, name, roughness);
        }
        MaterialDoc::Dielectric { ior, roughness } => {
            ior_ui(ui, name, ior);
            roughness_ui(ui, name, roughness);
        }
        MaterialDoc::ThinDielectric { ior } => ior_ui(ui, name, ior),
        MaterialDoc::Interface {} => {}
    }
}

fn about(material: &MaterialDoc) -> &'static str {
    match material {
        MaterialDoc::Diffuse { .. } => "Reflects light in all directions, on both sides",
        MaterialDoc::Mirror { .. } => "Reflects light in one direction, at every angle alike",
        MaterialDoc::Conductor { .. } => "A metal, smooth or rough, by its refractive index",
        MaterialDoc::Dielectric { .. } => {
            "The boundary of a transparent body, as glass or water, smooth or rough"
        }
        MaterialDoc::ThinDielectric { .. } => "A thin pane, which light passes in a straight line",
        MaterialDoc::Interface {} => "Lets light pass unchanged: an index-matched boundary of media",
    }
}

/// Shows the rank of a dielectric.
pub fn priority_ui(ui: &mut Ui, name: &str, priority: &mut i32, opened: i32) {
    let mut value = *priority as f32;
    Value::of(key("objects.*.priority"), &mut value)
        .opened(opened as f32)
        .named(format!("{name} priority"))
        .show(ui);
    *priority = value.round() as i32;
}

fn roughness_ui(ui: &mut Ui, name: &str, roughness: &mut f32) {
    Value::of(key("objects.*.material.roughness"), roughness).named(format!("{name} roughness")).show(ui);
}

/// Shows the metal by name, or n and k as spectra.
fn metal_ui(
    ui: &mut Ui,
    name: &str,
    preset: &mut Option<Metal>,
    (eta, k): (&mut Option<SpectrumDoc>, &mut Option<SpectrumDoc>),
) {
    let metal = *preset;
    row_of(ui, key("objects.*.material.preset"), |ui, _| {
        let combo = ComboBox::from_id_salt((name, "metal")).width(ui.available_width());
        let shown = combo
            .selected_text(metal.map_or("n and k".into(), |metal| format!("{metal:?}")))
            .show_ui(ui, |ui| {
                for other in Metal::ALL {
                    if ui.selectable_label(metal == Some(other), format!("{other:?}")).clicked() {
                        (*preset, *eta, *k) = (Some(other), None, None);
                    }
                }
                if ui.selectable_label(metal.is_none(), "n and k").clicked() && metal.is_some() {
                    let points = |points: Option<&str>| {
                        let points = points
                            .and_then(|points| SpectrumDoc::parse_points(points).ok())
                            .unwrap_or_default();
                        Some(SpectrumDoc::Points { points, outside: Default::default() })
                    };
                    (*eta, *k) = (points(metal.map(Metal::eta)), points(metal.map(Metal::k)));
                    *preset = None;
                }
            });
        shown.response.accessible_name(format!("{name} metal"));
    });
    for (spectrum, key) in [(eta, key("objects.*.material.eta")), (k, key("objects.*.material.k"))] {
        if let Some(spectrum) = spectrum {
            let now = spectrum.clone();
            spectrum_ui(ui, &format!("{name} {}", key.label), key, (spectrum, &now), Quantity::Coefficient);
        }
    }
}

/// Shows the refractive index as a number or spectrum, or by the coefficients of Cauchy's equation.
fn ior_ui(ui: &mut Ui, name: &str, ior: &mut IorDoc) {
    let index = key("objects.*.material.ior");
    let mut form = usize::from(matches!(ior, IorDoc::Cauchy { .. }));
    let forms = [
        (0, "Spectrum", "A number, or points by wavelength"),
        (1, "Cauchy", "n(λ) = A + B/λ², λ in micrometres"),
    ];
    row_of(ui, index, |ui, _| {
        if segmented(ui, &format!("{name} index"), &mut form, &forms) {
            // 1.5046 and 0.0042 are borosilicate crown glass (BK7).
            let crown = IorDoc::Cauchy { cauchy: [1.5046, 0.0042] };
            *ior = if form == 1 { crown } else { IorDoc::default() };
        }
    });
    match ior {
        IorDoc::Spectrum(spectrum) => {
            let now = spectrum.clone();
            spectrum_ui(ui, &format!("{name} index"), index, (spectrum, &now), Quantity::Coefficient);
        }
        IorDoc::Cauchy { cauchy: [a, b] } => {
            Value::of(index, a).labelled("A").named(format!("{name} A")).show(ui);
            Value::of(key("objects.*.material.roughness"), b)
                .labelled("B")
                .named(format!("{name} B"))
                .show(ui);
        }
    }
}

/// Shows a spectrum in words, with its editor in a collapsed section.
pub fn spectrum_ui(
    ui: &mut Ui,
    name: &str,
    key: &'static Key,
    (spectrum, opened): (&mut SpectrumDoc, &SpectrumDoc),
    quantity: Quantity,
) {
    let text = super::extinction::in_words(spectrum);
    row(ui, key.label, key.tip, |ui, _| ui.weak(text));
    let field = SpectrumField { name, key, opened, quantity, majorant: None };
    let heading = egui::RichText::new(format!("Edit {} by wavelength", key.label.to_lowercase())).small();
    egui::CollapsingHeader::new(heading)
        .id_salt(key.path)
        .show_unindented(ui, |ui| spectrum_editor(ui, &field, spectrum));
}
