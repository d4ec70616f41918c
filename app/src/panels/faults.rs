//! Deliberate faults: mistakes of real renderers, and the tools of the lab that detect them.

use super::{Column, Cx, Panel};
use crate::model::Command;
use crate::theme::Palette;
use crate::widgets::{callout, hint};
use egui::{Color32, RadioButton, RichText, Ui};
use majorant_core::scene::{Fault, SceneDoc, WhenExceeded};
use majorant_core::transmittance::TransmittanceKind;

/// Panel of the faults.
pub struct Faults;

/// A biased setting of the scene that is offered as a fault, although the code is correct.
struct Foil {
    name: &'static str,
    summary: &'static str,
    is_on: fn(&SceneDoc) -> bool,
    set: fn(&mut SceneDoc, bool),
}

const FOILS: [Foil; 2] = [
    Foil {
        name: "Clamped majorant",
        summary: "Half the largest extinction as majorant, with extinction clamped to it: the medium is too thin.",
        is_on: |doc| {
            doc.enabled_media()
                .map(|medium| &medium.majorant)
                .any(|majorant| majorant.factor < 1.0 && majorant.when_exceeded == WhenExceeded::Clamp)
        },
        set: |doc, on| {
            for medium in &mut doc.media {
                (medium.majorant.factor, medium.majorant.when_exceeded) =
                    if on { (0.5, WhenExceeded::Clamp) } else { (1.0, WhenExceeded::Weighted) };
            }
        },
    },
    Foil {
        name: "Ray marching",
        summary: "Connections sum extinction at equidistant steps: e to the minus of a noisy sum is too bright on average.",
        is_on: |doc| doc.estimator.id == "nee" && doc.estimator.transmittance == "marching",
        set: |doc, on| {
            let id = if on { "marching" } else { TransmittanceKind::ALONG_THE_PATH.entry().id };
            id.clone_into(&mut doc.estimator.transmittance);
            if on {
                "nee".clone_into(&mut doc.estimator.id);
            }
        },
    },
];

/// Name of the enabled fault of a document, if any.
#[must_use]
pub fn planted(doc: &SceneDoc) -> Option<&'static str> {
    let fault = doc.estimator.fault.entry().filter(|_| doc.estimator.id == "uni-nee-mis");
    let foil = || FOILS.iter().find(|foil| (foil.is_on)(doc)).map(|foil| foil.name);
    fault.map(|entry| entry.name).or_else(foil)
}

/// Disables all faults of a document.
pub fn remove(doc: &mut SceneDoc) {
    doc.estimator.fault = Fault::None;
    for foil in &FOILS {
        if (foil.is_on)(doc) {
            (foil.set)(doc, false);
        }
    }
}

impl Panel for Faults {
    fn id(&self) -> &'static str {
        "faults"
    }

    fn title(&self) -> &'static str {
        "What goes wrong"
    }

    fn column(&self) -> Column {
        Column::Method
    }

    fn summary(&self, cx: &Cx<'_>) -> String {
        planted(cx.draft).map_or("none enabled".into(), |_| "fault enabled".into())
    }

    fn alert(&self, cx: &Cx<'_>, palette: &Palette) -> Option<Color32> {
        planted(cx.draft).map(|_| palette.error)
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        let palette = Palette::get(ui);
        hint(
            ui,
            "Mistakes of real renderers, reproduced deliberately. Each is detected by comparison with a correct view.",
        );
        let now = planted(cx.draft);
        let mut chosen = None;
        let mut line = |ui: &mut Ui, name: &'static str, summary: &str, thread: &str| {
            let on = now == Some(name);
            let text = RichText::new(name).color(if on { palette.strong } else { palette.text });
            let response = ui.add(RadioButton::new(on, text));
            if response.clicked() {
                chosen = Some(name);
            }
            ui.indent(name, |ui| {
                hint(ui, summary);
                if !thread.is_empty() {
                    ui.label(RichText::new(thread).small().color(palette.accent));
                }
            });
        };
        for entry in Fault::ALL.iter().filter_map(|fault| fault.entry()) {
            line(ui, entry.name, entry.summary, entry.thread);
        }
        for foil in &FOILS {
            line(ui, foil.name, foil.summary, "");
        }
        if let Some(name) = chosen {
            let again = now == Some(name);
            remove(cx.draft);
            if !again {
                plant(cx.draft, name);
            }
        }
        if let Some(name) = planted(cx.draft) {
            callout(ui, palette.error, &format!("Fault enabled: {name}. The image is incorrect."));
            let prove = ui.button("Compare with the correct image");
            let tip = "Adds two views of the same scene without the fault; their samples decide the verdict";
            if prove.on_hover_text(tip).clicked() {
                cx.commands.push(Command::CompareWithCorrect);
            }
        }
    }
}

fn plant(doc: &mut SceneDoc, name: &str) {
    if let Some(fault) = Fault::ALL.into_iter().find(|fault| fault.entry().is_some_and(|e| e.name == name)) {
        "uni-nee-mis".clone_into(&mut doc.estimator.id);
        doc.estimator.fault = fault;
    }
    if let Some(foil) = FOILS.iter().find(|foil| foil.name == name) {
        (foil.set)(doc, true);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use majorant_core::scene::{DensityDoc, GridRef};

    #[test]
    fn every_fault_is_named_and_biased_and_can_be_disabled() {
        let names =
            Fault::ALL.iter().filter_map(|f| f.entry()).map(|e| e.name).chain(FOILS.iter().map(|f| f.name));
        for name in names {
            let mut doc = SceneDoc::default();
            // Ray marching is exact in constant extinction.
            let cloud = GridRef { file: "embedded:cloud.vdb".into(), grid: None };
            doc.medium_mut().density = DensityDoc::Grid(cloud);
            plant(&mut doc, name);
            assert_eq!(planted(&doc), Some(name));
            let entry = majorant_core::estimator::find(&doc.estimator.id).unwrap();
            assert!(entry.bias(&doc).is_some(), "{name}");
            assert_eq!(majorant_core::estimator::validate(&doc), []);
            remove(&mut doc);
            assert_eq!((planted(&doc), entry.bias(&doc)), (None, None));
        }
    }
}
