//! Edits a spectrum: kind, points on a plot, exact numbers, presets.
//!
//! | file | does |
//! | --- | --- |
//! | `model.rs` | what can be done to a spectrum, without a widget |
//! | `axes.rs` | axes, curve, strip of colours |
//! | `plot.rs` | the plot with what is drawn and clicked on it |
//! | `grip.rs` | one point on the plot |
//! | `table.rs` | the points as numbers |

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

/// What the edited spectrum stands for.
pub struct SpectrumField<'a> {
    /// Its name, which starts the names of all its widgets.
    pub name: &'a str,
    /// Its key: which values make sense, and what they mean.
    pub key: &'static Key,
    /// The spectrum when the scene was opened or saved.
    pub opened: &'a SpectrumDoc,
    /// What it is a spectrum of; decides how RGB becomes one.
    pub quantity: Quantity,
    /// The majorant that is drawn over an extinction.
    pub majorant: Option<&'a MajorantDoc>,
}

impl SpectrumField<'_> {
    /// The least and the greatest value that the key allows.
    fn values(&self) -> [f32; 2] {
        self.key.range().map_or([0.0, f32::MAX], |range| [range.min as f32, range.max as f32])
    }

    /// Greatest value if it is of the order of those that are edited, as of a share.
    fn max(&self) -> Option<f32> {
        Some(self.values()[1]).filter(|most| *most <= 1.0)
    }

    /// What presets have to suit.
    fn use_(&self) -> presets::Use {
        match (self.quantity, self.max()) {
            (Quantity::Radiance, _) => presets::Use::Light,
            (Quantity::Coefficient, Some(_)) => presets::Use::Albedo,
            (Quantity::Coefficient, None) => presets::Use::Extinction,
        }
    }
}

/// Shows the editor.
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
            hint(ui, &format!("Preset {id}: {summary}. Drag a point to make it your own."));
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
            (Kind::Points, "Points", "Control points, linear between"),
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
            if ui.button("As opened").on_hover_text("Take all edits of this spectrum back").clicked() {
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
    // A colour button cannot show, and would clip, what is brighter than white.
    if rgb.iter().all(|x| *x <= 1.0) {
        row(ui, "Colour", field.key.tip, |ui, _| {
            // The picker rounds through HSV: only what it really changed may reach the document.
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
