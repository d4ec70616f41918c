//! Details of one event: its random numbers and densities, and the path weights of every component.

use crate::theme::Palette;
use egui::{Color32, Grid, Label, RichText, ScrollArea, Ui};
use majorant_core::inspect::{Branch, Ledger, Row, Step};
use majorant_core::spectrum::Carried;

pub(super) fn event_ui(ui: &mut Ui, row: &Row, kept_names: [&str; 3], ledger: &Ledger) {
    ui.add_space(3.0);
    ui.separator();
    ScrollArea::vertical().id_salt("event").auto_shrink(false).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 1.0;
        summary_ui(ui, row, ledger);
        let lines = lines(row, kept_names, ledger.carried.count());
        let palette = Palette::get(ui);
        Grid::new("event at every component").spacing([12.0, 1.0]).min_row_height(0.0).show(ui, |ui| {
            ui.label("");
            for name in components(&ledger.carried) {
                ui.label(RichText::new(name).small().color(palette.weak));
            }
            ui.end_row();
            for (name, values) in lines {
                ui.label(RichText::new(name).small().color(palette.weak));
                for value in values {
                    let text = RichText::new(value).small().monospace().color(palette.text);
                    ui.add(Label::new(text).extend());
                }
                ui.end_row();
            }
        });
    });
}

/// Draws the quantities that are common to all components.
fn summary_ui(ui: &mut Ui, row: &Row, ledger: &Ledger) {
    let palette = Palette::get(ui);
    let weak = |ui: &mut Ui, text: String| {
        ui.add(Label::new(RichText::new(text).small().monospace().color(palette.weak)).truncate());
    };
    ui.horizontal(|ui| {
        ui.label(RichText::new(row.step.to_string()).small().color(colour(row, palette)));
        if !row.numbers.is_empty() {
            let numbers: Vec<_> = row.numbers.iter().map(|u| short(*u)).collect();
            weak(ui, format!("random numbers {}", numbers.join("  ")));
        }
    });
    match (row.step, &row.contribution) {
        (_, Some(contribution)) => {
            let (technique, nulls) = (contribution.technique.name(), contribution.nulls);
            weak(
                ui,
                format!("{technique}, scattering order {}, {nulls} null collisions", contribution.order),
            );
            if ledger.contributions().all(|contribution| contribution.by_definition.is_none()) {
                weak(ui, "this estimator has no path densities for comparison".to_owned());
            }
        }
        (Step::Direction(value, density), _) => {
            weak(
                ui,
                format!("phase function or cosine lobe {value:.5}, sampled with density {density:.5} /sr"),
            );
        }
        (Step::Connect(value, walk, light), _) => {
            weak(ui, format!("phase function {value:.5}, density of unidirectional sampling {walk:.5} /sr"));
            weak(ui, format!("density of light sampling {light:.5} /sr"));
        }
        _ => {}
    }
}

/// Rows of the table: a name and a value for each component.
fn lines<'a>(row: &Row, kept_names: [&'a str; 3], count: usize) -> Vec<(&'a str, Vec<String>)> {
    let numbers = |values: &[f32]| values[..count].iter().map(|v| short(*v)).collect::<Vec<_>>();
    let mut lines: Vec<(&str, Vec<String>)> = [("f", &row.f), ("p uni", &row.uni), ("p nee", &row.nee)]
        .map(|(name, products)| (name, products[..count].iter().map(ToString::to_string).collect()))
        .into();
    if let Some(kept) = &row.kept {
        let named = kept_names.into_iter().zip(&kept.values).filter(|(name, _)| !name.is_empty());
        lines.extend(named.map(|(name, values)| (name, numbers(values))));
    }
    if let Some(contribution) = &row.contribution {
        lines.push(("emitted", numbers(&contribution.emitted)));
        lines.push(("added", numbers(&contribution.value)));
        lines.extend(contribution.by_definition.iter().map(|values| ("Le f / mean p", numbers(values))));
    } else if let Some(found) = &row.found {
        lines.push(("μa", numbers(&found.absorption)));
        lines.push(("μs", numbers(&found.scattering)));
        lines.push(("μn", numbers(&found.null)));
        lines.push(("majorant", numbers(&found.majorant)));
    }
    lines
}

/// Names of the components, hero first.
fn components(carried: &Carried) -> Vec<String> {
    match carried {
        Carried::Wavelengths(nm, n) => nm[..*n].iter().map(|nm| format!("{nm:.0} nm")).collect(),
        Carried::Channels(channels, n) => {
            channels[..*n].iter().map(|c| ["red", "green", "blue"][*c as usize].to_owned()).collect()
        }
        Carried::Grey => vec!["all colours".to_owned()],
    }
}

/// Formats a number with four decimals, or in scientific notation if it is very small or large.
fn short(value: f32) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if (1e-3..1e5).contains(&size) => format!("{value:.4}"),
        _ => format!("{value:.2e}"),
    }
}

/// Colour of an event, in the 3D view and in the table.
pub(super) fn colour(row: &Row, palette: &Palette) -> Color32 {
    match (row.step, row.branch) {
        (Step::Contribution, _) => palette.warning,
        (Step::Absorb | Step::Terminate(_), _) => palette.error,
        (Step::Null, Branch::Path | Branch::LightWalk) => palette.weak,
        (Step::Null, _) => Color32::from_rgb(196, 140, 88),
        (Step::Scatter | Step::Reflect, _) => palette.accent,
        (Step::Connect(..) | Step::NoContribution | Step::Transmittance, _) => {
            Color32::from_rgb(228, 138, 62)
        }
        _ => palette.text,
    }
}
