//! Where the medium's box stands: part of the density panel.

use crate::widgets::{hint, optional, vector};
use egui::Ui;
use majorant_core::scene::PlacementDoc;

/// Shows the placement under its own small heading.
pub fn placement_ui(ui: &mut Ui, placement: &mut PlacementDoc, opened: &PlacementDoc) {
    let title = egui::RichText::new("Placement").small();
    egui::CollapsingHeader::new(title).id_salt("placement").show_unindented(ui, |ui| {
        let tip = "Centres the box on the origin and scales its longest side to this length";
        optional(ui, "Fit", &mut placement.fit, 1.0, "as stored in the file", tip, |v| {
            v.range(1e-4..=f64::from(f32::MAX)).logarithmic()
        });
        if placement.matrix.is_some() {
            hint(ui, "The scene file places the box by a matrix.");
            if ui.button("Use translation, rotation and scale instead").clicked() {
                placement.matrix = None;
            }
            return;
        }
        vector(
            ui,
            "Translate",
            "Medium translation",
            &mut placement.translate,
            0.01,
            "",
            "Moves the box, scene units",
        );
        vector(
            ui,
            "Rotate",
            "Medium rotation",
            &mut placement.rotate_deg,
            0.5,
            "°",
            "Turns about x, then y, then z",
        );
        vector(
            ui,
            "Scale",
            "Medium scale",
            &mut placement.scale,
            0.01,
            "",
            "Stretches the box along its axes",
        );
        if placement != opened && ui.small_button("↺  As opened").clicked() {
            *placement = opened.clone();
        }
    });
}
