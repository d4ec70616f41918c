//! Where the medium's box stands: part of the density panel.

use crate::widgets::{Vector, hint, optional};
use egui::Ui;
use majorant_core::scene::PlacementDoc;

/// Shows the placement under its own small heading.
pub fn placement_ui(ui: &mut Ui, placement: &mut PlacementDoc, opened: &PlacementDoc) {
    let title = egui::RichText::new("Placement").small();
    egui::CollapsingHeader::new(title).id_salt("placement").show_unindented(ui, |ui| {
        let tip = "Centres the box on the origin and scales its longest side to this length";
        optional(ui, "Fit", (&mut placement.fit, opened.fit), 1.0, "as stored in the file", tip, |v| {
            v.range(1e-4..=f64::from(f32::MAX)).logarithmic()
        });
        if placement.matrix.is_some() {
            hint(ui, "The scene file places the box by a matrix.");
            if ui.button("Use translation, rotation and scale instead").clicked() {
                placement.matrix = None;
            }
            return;
        }
        let default = PlacementDoc::default();
        Vector::new("Translate", "Medium translation", &mut placement.translate, default.translate)
            .opened(opened.translate)
            .tip("Moves the box, scene units")
            .show(ui);
        Vector::new("Rotate", "Medium rotation", &mut placement.rotate_deg, default.rotate_deg)
            .opened(opened.rotate_deg)
            .degrees()
            .tip("Turns about x, then y, then z")
            .show(ui);
        Vector::new("Scale", "Medium scale", &mut placement.scale, default.scale)
            .opened(opened.scale)
            .tip("Stretches the box along its axes")
            .show(ui);
    });
}
