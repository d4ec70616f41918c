//! Thermal emission of the medium: temperature and scale.

use super::{Column, Cx, Panel, density};
use crate::model::Purpose;
use crate::widgets::{Value, format_number, hint, key, row, segmented, switch};
use egui::Ui;
use majorant_core::scene::{DensityDoc, EmissionDoc, GridRef};

/// Panel of the emission.
pub struct Emission;

impl Panel for Emission {
    fn id(&self) -> &'static str {
        "emission"
    }
    fn title(&self) -> &'static str {
        "Emission"
    }
    fn column(&self) -> Column {
        Column::Scene
    }
    fn is_of_medium(&self) -> bool {
        true
    }
    fn summary(&self, cx: &Cx<'_>) -> String {
        match &cx.draft.medium_at(cx.medium).emission {
            None => "none".into(),
            Some(EmissionDoc { temperature: None, kelvin, .. }) => {
                format!("{} K", format_number(f64::from(*kelvin)))
            }
            Some(EmissionDoc { temperature: Some(grid), .. }) => {
                grid.grid.clone().unwrap_or_else(|| grid.file.clone())
            }
        }
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        let Cx { draft, opened, grids, commands, state, medium: medium_index, .. } = cx;
        let mut emits = draft.medium_at(*medium_index).emission.is_some();
        switch(
            ui,
            "Thermal",
            "Thermal emission",
            &mut emits,
            "emission as a black body",
            "Thermal emission at the temperature of the medium; requires absorption",
        );
        if !emits {
            draft.medium_at_mut(*medium_index).emission = None;
            return;
        }
        let initial = opened.medium_at(*medium_index).emission.clone().unwrap_or_default();
        let density = draft.medium_at(*medium_index).density.clone();
        let emission = draft.medium_at_mut(*medium_index).emission.get_or_insert_with(|| initial.clone());
        let mut by_grid = emission.temperature.is_some();
        row(ui, "Temperature", "Source of the temperature", |ui, _| {
            let options = [
                (false, "Uniform", "The same everywhere in the box"),
                (true, "Grid", "A scalar grid over the same box as the density"),
            ];
            segmented(ui, "Temperature", &mut by_grid, &options);
        });
        if by_grid {
            // The density file usually contains a temperature grid.
            let grid = emission.temperature.get_or_insert_with(|| match &density {
                DensityDoc::Grid(grid) | DensityDoc::RgbGrid(grid) => {
                    GridRef { file: grid.file.clone(), grid: Some("temperature".into()) }
                }
                DensityDoc::Uniform {} => GridRef::default(),
            });
            let chosen = state
                .scene
                .as_ref()
                .and_then(|info| info.medium(*medium_index))
                .map(|info| info.temperature_grid.as_str());
            density::grid_ui(ui, ("temperature", chosen), grid, grids, commands, Purpose::TemperatureFile);
        } else {
            emission.temperature = None;
        }
        Value::of(key("medium.emission.kelvin"), &mut emission.kelvin)
            .opened(initial.kelvin)
            .within(0.001..=15_000.0)
            .logarithmic()
            .tip(if by_grid {
                "Kelvins per unit of the temperature grid"
            } else {
                "Temperature of the medium"
            })
            .show(ui);
        Value::of(key("medium.emission.scale"), &mut emission.scale)
            .opened(initial.scale)
            .within(0.0..=1e6)
            .logarithmic()
            .named("Emission scale")
            .show(ui);
        hint(
            ui,
            "Emission coefficient σa(λ) B(λ, T): only absorbing media emit; at an albedo of 1 there is no emission.",
        );
    }
}
