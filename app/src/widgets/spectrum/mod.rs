//! Spectrum editor: kind, control points on a plot, exact numbers, presets.
//!
//! | file | does |
//! | --- | --- |
//! | `model.rs` | edits of a spectrum, independent of widgets |
//! | `axes.rs` | axes, curve and colour strip |
//! | `plot.rs` | plot and its input |
//! | `grip.rs` | handle of a control point |
//! | `table.rs` | control points as numbers and text |

mod axes;
mod grip;
mod model;
mod plot;
mod table;

use super::choice::segmented;
use super::hint;
use super::row::row;
use super::value::Value;
use egui::containers::menu::MenuButton;
use egui::{Button, Ui, vec2};
use majorant_core::scene::MajorantDoc;
use majorant_core::scene::keys::Key;
use majorant_core::spectrum::{Quantity, SpectrumDoc, presets};
use model::Kind;

/// Properties of the edited spectrum.
pub struct SpectrumField<'a> {
    /// Name, which begins the accessible names of all widgets.
    pub name: &'a str,
    /// Scene key, with range, unit and tooltip.
    pub key: &'static Key,
    /// Spectrum when the scene was opened or saved.
    pub opened: &'a SpectrumDoc,
    /// Quantity, which determines the upsampling of RGB.
    pub quantity: Quantity,
    /// Majorant drawn over an extinction.
    pub majorant: Option<&'a MajorantDoc>,
}

impl SpectrumField<'_> {
    /// Range of values of the key.
    fn values(&self) -> [f32; 2] {
        self.key.range().map_or([0.0, f32::MAX], |range| [range.min as f32, range.max as f32])
    }

    /// Maximum of the key if it is at most 1, as of an albedo; it then fixes the value axis.
    fn max(&self) -> Option<f32> {
        Some(self.values()[1]).filter(|most| *most <= 1.0)
    }

    /// Use by which presets are filtered.
    fn use_(&self) -> presets::Use {
        match (self.quantity, self.max()) {
            (Quantity::Radiance, _) => presets::Use::Light,
            (Quantity::Coefficient, Some(_)) => presets::Use::Albedo,
            (Quantity::Coefficient, None) => presets::Use::Extinction,
        }
    }
}

/// Draws the editor.
pub fn spectrum_editor(ui: &mut Ui, field: &SpectrumField<'_>, doc: &mut SpectrumDoc) {
    ui.push_id(field.name, |ui| {
        kind_ui(ui, field, doc);
        match doc {
            SpectrumDoc::Constant(value) => constant_ui(ui, field, value),
            SpectrumDoc::Rgb(rgb) => rgb_ui(ui, field, rgb),
            SpectrumDoc::Points { .. } | SpectrumDoc::Preset(_) => {}
        }
        plot::plot_ui(ui, field, doc);
        if let SpectrumDoc::Preset(id) = doc {
            let summary = presets::find(id).map_or("", |p| p.summary);
            hint(ui, &format!("Preset {id}: {summary}. Drag a point to edit it."));
        }
        if matches!(doc, SpectrumDoc::Points { .. }) {
            table::points_ui(ui, field, doc);
        }
    });
}

fn kind_ui(ui: &mut Ui, field: &SpectrumField<'_>, doc: &mut SpectrumDoc) {
    ui.horizontal(|ui| {
        let mut kind = model::kind(doc);
        let options = [
            (Kind::Constant, "Constant", "The same value at every wavelength"),
            (Kind::Points, "Points", "Control points with linear interpolation"),
            (Kind::Rgb, "RGB", "Linear sRGB components, upsampled to a smooth spectrum"),
        ];
        ui.scope(|ui| {
            ui.set_max_width(ui.available_width() - 78.0);
            if segmented(ui, field.name, &mut kind, &options) {
                *doc = model::converted(doc, kind);
            }
        });
        let preset = matches!(doc, SpectrumDoc::Preset(_));
        let button = Button::selectable(preset, "Presets").frame_when_inactive(true);
        let button = button.min_size(vec2(ui.available_width(), 0.0));
        let (response, _) = MenuButton::from_button(button).ui(ui, |ui| {
            for preset in presets::suiting(field.use_()) {
                let chosen = *doc == SpectrumDoc::Preset(preset.id.into());
                if ui.selectable_label(chosen, preset.id).on_hover_text(preset.summary).clicked() {
                    *doc = SpectrumDoc::Preset(preset.id.into());
                    ui.close();
                }
            }
            ui.separator();
            if ui.button("As opened").on_hover_text("Undo all edits of this spectrum").clicked() {
                *doc = field.opened.clone();
                ui.close();
            }
        });
        response.accessible_name(format!("{} presets", field.name));
    });
}

fn constant_ui(ui: &mut Ui, field: &SpectrumField<'_>, value: &mut f32) {
    let opened = match field.opened {
        SpectrumDoc::Constant(opened) => *opened,
        _ => *value,
    };
    let default = field.max().unwrap_or(1.0);
    let number = Value::of(field.key, value).labelled("Value").defaulting_to(default).opened(opened);
    let number = if field.max().is_some() { number.speed(0.004) } else { number.logarithmic() };
    number.named(format!("{} value", field.name)).show(ui);
}

fn rgb_ui(ui: &mut Ui, field: &SpectrumField<'_>, rgb: &mut [f32; 3]) {
    // A colour button would clip components above 1.
    if rgb.iter().all(|x| *x <= 1.0) {
        row(ui, "Colour", field.key.tip, |ui, _| {
            // The picker rounds by conversion to HSV: the document is changed only by actual edits.
            let mut picked = *rgb;
            let button = ui.color_edit_button_rgb(&mut picked);
            let button = button.accessible_name(format!("{} colour", field.name));
            if button.changed() {
                *rgb = picked;
            }
            hint(ui, "linear sRGB");
        });
    }
    for (channel, value) in ["Red", "Green", "Blue"].iter().zip(rgb) {
        let opened = *value;
        let number = Value::of(field.key, value).labelled(channel).defaulting_to(1.0).opened(opened);
        number.named(format!("{} {}", field.name, channel.to_lowercase())).show(ui);
    }
}
