//! Albedo by wavelength: the fraction of real collisions that scatter.

use super::{Column, Cx, Panel, extinction};
use crate::widgets::{SpectrumField, hint, key, spectrum_editor};
use egui::Ui;
use majorant_core::scene::CoefficientsDoc;
use majorant_core::spectrum::Quantity;

/// Panel of the albedo spectrum.
pub struct Albedo;

impl Panel for Albedo {
    fn id(&self) -> &'static str {
        "albedo"
    }
    fn title(&self) -> &'static str {
        "Albedo"
    }
    fn column(&self) -> Column {
        Column::Scene
    }
    fn is_of_medium(&self) -> bool {
        true
    }
    fn summary(&self, cx: &Cx<'_>) -> String {
        let medium = cx.draft.medium_at(cx.medium);
        match (&medium.albedo_grid, &medium.coefficients) {
            (Some(_), _) => "RGB grid".into(),
            (None, None) => extinction::in_words(&medium.albedo),
            (None, Some(CoefficientsDoc::AbsorptionScattering { .. })) => "from σa, σs".into(),
            (None, Some(CoefficientsDoc::MeanFreePathColour { .. })) => "from the colour".into(),
        }
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        if let Some(grid) = &cx.draft.medium_at(cx.medium).albedo_grid {
            hint(ui, &format!("The RGB grid {} is used instead of a spectrum.", grid.file));
            if ui.button("Use the spectrum").clicked() {
                cx.draft.medium_at_mut(cx.medium).albedo_grid = None;
            }
            return;
        }
        if cx.draft.medium_at(cx.medium).coefficients.is_some() {
            hint(ui, "Derived from the spectra under Extinction.");
            return;
        }
        let field = SpectrumField {
            name: "Albedo",
            key: key("medium.albedo"),
            opened: &cx.opened.medium_at(cx.medium).albedo,
            quantity: Quantity::Coefficient,
            majorant: None,
        };
        spectrum_editor(ui, &field, &mut cx.draft.medium_at_mut(cx.medium).albedo);
    }
}
