//! Parametrisation of the medium's coefficients, and the spectra of each parametrisation.

use super::{Cx, phase};
use crate::widgets::{SpectrumField, hint, key, segmented, spectrum_editor};
use egui::Ui;
use majorant_core::scene::keys::Key;
use majorant_core::scene::{CoefficientsDoc, CoefficientsKind, MediumDoc};
use majorant_core::spectrum::{Quantity, SpectrumDoc};

/// Chooses the parametrisation; the coefficients are converted.
pub(super) fn kind_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    let mut kind = cx.draft.medium_at(cx.medium).coefficients_kind();
    let options = [
        (CoefficientsKind::ExtinctionAlbedo, "σt, albedo", "Extinction σt and its scattered fraction α"),
        (
            CoefficientsKind::AbsorptionScattering,
            "σa, σs",
            "Absorption and scattering coefficients: σt = σa + σs, α = σs / σt",
        ),
        (
            CoefficientsKind::MeanFreePathColour,
            "Path, colour",
            "Mean free path 1/σt, and the diffuse reflectance of a half-space. The albedo follows from it by van de \
             Hulst's formula and the phase function's mean cosine",
        ),
    ];
    if segmented(ui, "Coefficients", &mut kind, &options) {
        let mean_cosine = phase::current(cx).mean_cosine();
        *cx.draft.medium_at_mut(cx.medium) = cx.draft.medium_at(cx.medium).given_by(kind, mean_cosine);
    }
}

/// Shows the spectra of a medium that is not given by extinction and albedo; returns `false` for other media.
pub(super) fn spectra_ui(ui: &mut Ui, cx: &mut Cx<'_>) -> bool {
    if cx.draft.medium_at(cx.medium).coefficients.is_none() {
        return false;
    }
    let mean_cosine = phase::current(cx).mean_cosine();
    let Some(doc) = &mut cx.draft.medium_at_mut(cx.medium).coefficients else { return false };
    let opened = opened(cx.opened.medium_at(cx.medium), doc, mean_cosine);
    match doc {
        CoefficientsDoc::AbsorptionScattering { absorption, scattering } => {
            edit(ui, key("medium.coefficients.absorption"), &opened[0], absorption);
            edit(ui, key("medium.coefficients.scattering"), &opened[1], scattering);
        }
        CoefficientsDoc::MeanFreePathColour { mean_free_path, colour } => {
            edit(ui, key("medium.coefficients.mean_free_path"), &opened[0], mean_free_path);
            edit(ui, key("medium.coefficients.colour"), &opened[1], colour);
            hint(
                ui,
                &format!(
                    "The albedo that gives this colour depends on the phase function, whose mean cosine is \
                     {mean_cosine:.3}."
                ),
            );
        }
    }
    true
}

/// Spectra of the opened scene, converted to the present parametrisation.
fn opened(medium: &MediumDoc, as_now: &CoefficientsDoc, mean_cosine: f32) -> [SpectrumDoc; 2] {
    let kind = match as_now {
        CoefficientsDoc::AbsorptionScattering { .. } => CoefficientsKind::AbsorptionScattering,
        CoefficientsDoc::MeanFreePathColour { .. } => CoefficientsKind::MeanFreePathColour,
    };
    match medium.given_by(kind, mean_cosine).coefficients {
        Some(CoefficientsDoc::AbsorptionScattering { absorption: a, scattering: b })
        | Some(CoefficientsDoc::MeanFreePathColour { mean_free_path: a, colour: b }) => [a, b],
        None => [medium.extinction.clone(), medium.albedo.clone()],
    }
}

fn edit(ui: &mut Ui, key: &'static Key, opened: &SpectrumDoc, doc: &mut SpectrumDoc) {
    ui.strong(key.label);
    let (name, quantity) = (key.label, Quantity::Coefficient);
    spectrum_editor(ui, &SpectrumField { name, key, opened, quantity, majorant: None }, doc);
}
