//! Extinction by wavelength.

use super::{Column, Cx, Panel, coefficients};
use crate::widgets::{SpectrumField, hint, key, spectrum_editor};
use egui::Ui;
use majorant_core::scene::{CoefficientsDoc, DensityDoc};
use majorant_core::spectrum::{Quantity, SpectrumDoc};

/// Panel of the extinction and the parametrisation of coefficients.
pub struct Extinction;

/// Short description of a spectrum.
pub(super) fn in_words(doc: &SpectrumDoc) -> String {
    match doc {
        SpectrumDoc::Constant(value) => crate::widgets::format_number(f64::from(*value)),
        SpectrumDoc::Points { points, .. } => format!("{} points", points.len()),
        SpectrumDoc::Rgb([r, g, b]) => format!("RGB {r:.2} {g:.2} {b:.2}"),
        SpectrumDoc::Preset(id) => id.clone(),
    }
}

impl Panel for Extinction {
    fn id(&self) -> &'static str {
        "extinction"
    }
    fn title(&self) -> &'static str {
        "Extinction"
    }
    fn column(&self) -> Column {
        Column::Scene
    }
    fn starts_open(&self) -> bool {
        true
    }
    fn is_of_medium(&self) -> bool {
        true
    }
    fn summary(&self, cx: &Cx<'_>) -> String {
        match &cx.draft.medium_at(cx.medium).coefficients {
            None => in_words(&cx.draft.medium_at(cx.medium).extinction),
            Some(CoefficientsDoc::AbsorptionScattering { absorption, scattering }) => {
                format!("σa {}, σs {}", in_words(absorption), in_words(scattering))
            }
            Some(CoefficientsDoc::MeanFreePathColour { mean_free_path, .. }) => {
                format!("path {}", in_words(mean_free_path))
            }
        }
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        coefficients::kind_ui(ui, cx);
        if matches!(cx.draft.medium_at(cx.medium).density, DensityDoc::RgbGrid(_)) {
            hint(ui, "The RGB grid contains the extinction; this spectrum is not used.");
        }
        if coefficients::spectra_ui(ui, cx) {
            return;
        }
        let medium = cx.draft.medium_at_mut(cx.medium);
        let field = SpectrumField {
            name: "Extinction",
            key: key("medium.extinction"),
            opened: &cx.opened.medium_at(cx.medium).extinction,
            quantity: Quantity::Coefficient,
            majorant: Some(&medium.majorant),
        };
        spectrum_editor(ui, &field, &mut medium.extinction);
    }
}
