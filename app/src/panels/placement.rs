//! Placement of a medium's box or of a mesh.

use crate::widgets::{Vector, hint, key, optional_key};
use egui::Ui;
use majorant_core::scene::PlacementDoc;

/// Shows the placement of a thing with this name in a collapsible section.
pub fn placement_ui(ui: &mut Ui, name: &str, placement: &mut PlacementDoc, opened: &PlacementDoc) {
    let title = egui::RichText::new("Placement").small();
    egui::CollapsingHeader::new(title).id_salt("placement").show_unindented(ui, |ui| {
        let fit = (&mut placement.fit, opened.fit);
        optional_key(ui, key("medium.placement.fit"), fit, 1.0, "as stored in the file", |v| {
            v.within(1e-4..=1e9).logarithmic()
        });
        if placement.matrix.is_some() {
            hint(ui, "The scene file gives the placement as a matrix.");
            if ui.button("Use translation, rotation and scale instead").clicked() {
                placement.matrix = None;
            }
            return;
        }
        Vector::of(
            key("medium.placement.translate"),
            format!("{name} translation"),
            &mut placement.translate,
        )
        .opened(opened.translate)
        .show(ui);
        Vector::of(key("medium.placement.rotate_deg"), format!("{name} rotation"), &mut placement.rotate_deg)
            .opened(opened.rotate_deg)
            .show(ui);
        Vector::of(key("medium.placement.scale"), format!("{name} scale"), &mut placement.scale)
            .opened(opened.scale)
            .show(ui);
    });
}
