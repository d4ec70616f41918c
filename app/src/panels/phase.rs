//! The phase function: which way light scatters.

use super::{Column, Cx, Panel};
use crate::lab::Command;
use crate::widgets::{Value, phase_lobe, row, segmented};
use egui::Ui;
use majorant_core::phase::Phase;
use majorant_core::scene::PhaseDoc;

/// See the [module](self).
pub struct PhaseFunction;

/// Close to ±1 a lobe is a needle that single precision cannot hold.
const G_MAX: f64 = 0.999;

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Isotropic,
    HenyeyGreenstein,
    TwoLobe,
    Rayleigh,
}

fn kind(doc: PhaseDoc) -> Kind {
    match doc {
        PhaseDoc::Isotropic {} => Kind::Isotropic,
        PhaseDoc::HenyeyGreenstein { .. } => Kind::HenyeyGreenstein,
        PhaseDoc::TwoLobe { .. } => Kind::TwoLobe,
        PhaseDoc::Rayleigh {} => Kind::Rayleigh,
    }
}

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
    fn summary(&self, cx: &Cx<'_>) -> String {
        match cx.draft.medium.phase {
            PhaseDoc::Isotropic {} => "isotropic".into(),
            PhaseDoc::HenyeyGreenstein { g } => format!("g = {g}"),
            PhaseDoc::TwoLobe { g_forward, g_backward, .. } => format!("g = {g_forward}, {g_backward}"),
            PhaseDoc::Rayleigh {} => "Rayleigh".into(),
        }
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        let phase = &mut cx.draft.medium.phase;
        let mut chosen = kind(*phase);
        let options = [
            (Kind::Isotropic, "Isotropic", "p = 1 / 4π"),
            (Kind::HenyeyGreenstein, "HG", "Henyey–Greenstein: p = (1 − g²) / 4π (1 + g² − 2 g cos θ)^1.5"),
            (Kind::TwoLobe, "Two lobes", "A share of one Henyey–Greenstein lobe, the rest of another"),
            (Kind::Rayleigh, "Rayleigh", "Molecules: p = 3 (1 + cos² θ) / 16π"),
        ];
        if segmented(ui, "Phase function", &mut chosen, &options) {
            let mut templates = PhaseDoc::templates().into_iter().map(|(_, template)| template);
            *phase = templates.find(|template| kind(*template) == chosen).unwrap_or(*phase);
        }
        parameters_ui(ui, phase, cx.opened.medium.phase);
        phase_lobe(ui, &Phase::new(phase), cx.settings.log_lobe);
        row(ui, "Radius", "How far the curve is from the middle", |ui, _| {
            let mut log = cx.settings.log_lobe;
            let options = [
                (false, "Linear", "Radius proportional to p"),
                (true, "Logarithmic", "Three decades below the largest value"),
            ];
            if segmented(ui, "Lobe radius", &mut log, &options) {
                cx.commands.push(Command::ToggleLogLobe);
            }
        });
    }
}

fn parameters_ui(ui: &mut Ui, phase: &mut PhaseDoc, opened: PhaseDoc) {
    let mean = "Mean cosine of the scattering angle, −1 to 1; positive is forward";
    match phase {
        PhaseDoc::Isotropic {} | PhaseDoc::Rayleigh {} => {}
        PhaseDoc::HenyeyGreenstein { g } => {
            let before = if let PhaseDoc::HenyeyGreenstein { g } = opened { g } else { *g };
            let value = Value::new("g", g, 0.5).opened(before).range(-G_MAX..=G_MAX).speed(0.005);
            value.named("Phase g").tip(mean).show(ui);
        }
        PhaseDoc::TwoLobe { g_forward, g_backward, forward } => {
            let (a, b, c) = match opened {
                PhaseDoc::TwoLobe { g_forward, g_backward, forward } => (g_forward, g_backward, forward),
                _ => (*g_forward, *g_backward, *forward),
            };
            let lobe = |v: Value<'_, f32>, ui: &mut Ui| {
                v.range(-G_MAX..=G_MAX).speed(0.005).tip(mean).show(ui);
            };
            lobe(Value::new("First g", g_forward, 0.8).opened(a), ui);
            lobe(Value::new("Second g", g_backward, -0.3).opened(b), ui);
            let share = Value::new("Share of first", forward, 0.7).opened(c).range(0.0..=1.0).speed(0.004);
            share.tip("p = share · HG(first g) + (1 − share) · HG(second g)").show(ui);
        }
    }
}
