//! Choice of the estimator from the registry, and the axes of all estimators.

mod axes;
mod card;

use super::{Column, Cx, Panel};
use crate::theme::Palette;
use crate::widgets::{callout, hint};
use egui::{Color32, Ui};
use majorant_core::estimator::{self, REGISTRY};

/// Panel of the estimator.
pub struct Estimator;

impl Panel for Estimator {
    fn id(&self) -> &'static str {
        "estimator"
    }
    fn title(&self) -> &'static str {
        "Estimator"
    }
    fn column(&self) -> Column {
        Column::Method
    }
    fn starts_open(&self) -> bool {
        true
    }
    fn summary(&self, cx: &Cx<'_>) -> String {
        let id = &cx.draft.estimator.id;
        estimator::find(id).map_or_else(|| format!("{id}?"), |entry| entry.name.to_owned())
    }
    fn alert(&self, cx: &Cx<'_>, palette: &Palette) -> Option<Color32> {
        estimator::find(&cx.draft.estimator.id).is_none().then_some(palette.error)
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        let doc = &mut cx.draft.estimator;
        if estimator::find(&doc.id).is_none() {
            let text = format!("The scene uses the unknown estimator `{}`. Choose one of these.", doc.id);
            callout(ui, Palette::get(ui).error, &text);
        }
        for entry in REGISTRY {
            if card::ui(ui, entry, doc.id == entry.id) {
                entry.id.clone_into(&mut doc.id);
            }
        }
        // Below the cards, so that their positions do not depend on the choice.
        if let Some(entry) = estimator::find(&doc.id) {
            hint(ui, entry.reference);
        }
        ui.add_space(crate::theme::UNIT);
        axes::ui(ui, doc, &cx.opened.estimator);
    }
}
