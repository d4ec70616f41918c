//! The phase function: kind, parameters and polar plot.

use super::{Column, Cx, Panel, phase_table};
use crate::model::Command;
use crate::widgets::{Value, format_number, phase_lobe, row, segmented};
use egui::Ui;
use majorant_core::phase::{Parameter, Phase};
use majorant_core::scene::{PhaseDoc, keys};

/// Panel of the phase function.
pub struct PhaseFunction;

/// Number of kinds in a row.
const PER_ROW: usize = 4;

impl Panel for PhaseFunction {
    fn id(&self) -> &'static str {
        "phase"
    }
    fn title(&self) -> &'static str {
        "Phase function"
    }
    fn column(&self) -> Column {
        Column::Scene
    }
    fn is_of_medium(&self) -> bool {
        true
    }
    fn summary(&self, cx: &Cx<'_>) -> String {
        let phase = &cx.draft.medium_at(cx.medium).phase;
        let number = |(p, v): (&Parameter, f32)| match p.unit {
            "" => format_number(v.into()),
            unit => format!("{} {unit}", format_number(v.into())),
        };
        let numbers: Vec<String> = phase.parameters().into_iter().map(number).collect();
        match (phase, numbers.as_slice()) {
            (PhaseDoc::HenyeyGreenstein { .. }, [g]) => format!("g = {g}"),
            (_, []) => phase.kind().name.into(),
            (_, numbers) => format!("{}: {}", phase.kind().short, numbers.join(", ")),
        }
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        kind_ui(ui, &mut cx.draft.medium_at_mut(cx.medium).phase);
        parameters_ui(
            ui,
            &mut cx.draft.medium_at_mut(cx.medium).phase,
            &cx.opened.medium_at(cx.medium).phase,
        );
        if matches!(cx.draft.medium_at(cx.medium).phase, PhaseDoc::Tabulated { .. }) {
            phase_table::table_ui(ui, cx);
        }
        phase_lobe(ui, &current(cx), cx.settings.log_lobe);
        row(ui, "Radius", "Scale of the distance from the centre", |ui, _| {
            let mut log = cx.settings.log_lobe;
            let options = [
                (false, "Linear", "Radius proportional to p"),
                (true, "Logarithmic", "Three decades below the maximum"),
            ];
            if segmented(ui, "Lobe radius", &mut log, &options) {
                cx.commands.push(Command::ToggleLogLobe);
            }
        });
    }
}

/// Phase function as edited; points of a table file are taken from the session.
pub(super) fn current(cx: &Cx<'_>) -> Phase {
    match (&cx.draft.medium_at(cx.medium).phase, cx.medium_info()) {
        (PhaseDoc::Tabulated { angle, file, .. }, Some(info)) if !file.is_empty() => {
            let points = info.phase_points.clone();
            Phase::new(&PhaseDoc::Tabulated { angle: *angle, points, file: String::new() })
        }
        (doc, _) => Phase::new(doc),
    }
}

fn kind_ui(ui: &mut Ui, phase: &mut PhaseDoc) {
    let templates = PhaseDoc::templates();
    let kind = |doc: &PhaseDoc| templates.iter().position(|t| t.kind() == doc.kind()).unwrap_or_default();
    let before = kind(phase);
    let mut chosen = before;
    let kinds: Vec<_> = templates.iter().map(PhaseDoc::kind).enumerate().collect();
    for line in kinds.chunks(PER_ROW) {
        let options: Vec<_> = line.iter().map(|(index, kind)| (*index, kind.short, kind.about)).collect();
        segmented(ui, "Phase function", &mut chosen, &options);
    }
    if let Some(template) = templates.get(chosen).filter(|_| chosen != before) {
        phase.clone_from(template);
    }
}

fn parameters_ui(ui: &mut Ui, phase: &mut PhaseDoc, opened: &PhaseDoc) {
    let templates = PhaseDoc::templates();
    let default = templates.iter().find(|t| t.kind() == phase.kind()).map(PhaseDoc::parameters);
    // The opened parameters are used if they are of the same kind.
    let opened = if opened.kind() == phase.kind() { opened.parameters() } else { Vec::new() };
    let default = default.unwrap_or_default();
    let kind = phase.clone();
    for (index, (parameter, value)) in phase.parameters_mut().into_iter().enumerate() {
        let of = |from: &[(&Parameter, f32)]| from.get(index).map(|(_, value)| *value);
        let (before, default) = (of(&opened).unwrap_or(*value), of(&default).unwrap_or(*value));
        // The meaning of a key may depend on the kind.
        let Some(key) = keys::phase_key(&kind, parameter) else { continue };
        let field = Value::of(key, value).defaulting_to(default).opened(before);
        let field = field.named(format!("Phase {}", parameter.label));
        let field = if parameter.logarithmic { field.logarithmic() } else { field.speed(0.005) };
        field.show(ui);
    }
}
