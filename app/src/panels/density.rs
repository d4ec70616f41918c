//! Density of the medium: source, scale and placement.

use super::{Column, Cx, Panel, placement};
use crate::model::{Command, GridLists, Purpose};
use crate::widgets::{Value, hint, key, path_field, row, row_of, segmented};
use egui::{ComboBox, Ui};
use majorant_core::medium::{Interpolation, Precision};
use majorant_core::scene::{DensityDoc, GridRef, Within};
use std::path::Path;

/// Panel of the density.
pub struct Density;

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Uniform,
    Grid,
    Rgb,
}

impl Panel for Density {
    fn id(&self) -> &'static str {
        "density"
    }
    fn title(&self) -> &'static str {
        "Density"
    }
    fn column(&self) -> Column {
        Column::Scene
    }
    fn is_of_medium(&self) -> bool {
        true
    }
    fn summary(&self, cx: &Cx<'_>) -> String {
        match cx.draft.medium_at(cx.medium).density.grid() {
            None if cx.draft.medium_at(cx.medium).within != Within::Grid => "uniform".into(),
            None => "uniform cube".into(),
            Some(grid) => Path::new(&grid.file)
                .file_name()
                .map_or_else(String::new, |n| n.to_string_lossy().into_owned()),
        }
    }

    fn ui(&self, ui: &mut Ui, cx: &mut Cx<'_>) {
        Value::of(key("medium.scale"), &mut cx.draft.medium_at_mut(cx.medium).scale)
            .opened(cx.opened.medium_at(cx.medium).scale)
            .logarithmic()
            .named("Density scale")
            .show(ui);
        source_ui(ui, cx);
        storage_ui(ui, cx);
        // A medium without a box of its own has no placement.
        let medium = cx.draft.medium_at(cx.medium);
        let has_box = match medium.within {
            Within::Grid => true,
            Within::Object(_) => !medium.is_uniform(),
            Within::Everywhere => false,
        };
        if has_box {
            placement::placement_ui(
                ui,
                "Medium",
                &mut cx.draft.medium_at_mut(cx.medium).placement,
                &cx.opened.medium_at(cx.medium).placement,
            );
        }
    }
}

/// Storage and interpolation of grids, and the resulting memory and error.
fn storage_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    if cx.draft.medium_at(cx.medium).density.grid().is_none()
        && cx.draft.medium_at(cx.medium).albedo_grid.is_none()
    {
        return;
    }
    let medium = cx.draft.medium_at_mut(cx.medium);
    row_of(ui, key("medium.precision"), |ui, _| {
        let options = [
            (Precision::F32, "32", "Single precision"),
            (Precision::F16, "16", "Half floats: relative error up to 1/2048"),
            (Precision::U8, "8", "255 steps up to the maximum"),
        ];
        segmented(ui, "Precision", &mut medium.precision, &options);
    });
    row_of(ui, key("medium.interpolation"), |ui, _| {
        let options = [
            (Interpolation::Trilinear, "Trilinear", "Weighted mean of eight voxels"),
            (
                Interpolation::Stochastic,
                "One sample",
                "One of the eight voxels at random: unbiased, cheaper, noisier",
            ),
        ];
        segmented(ui, "Interpolation", &mut medium.interpolation, &options);
    });
    let Some(info) = cx.medium_info() else { return };
    if let Some([x, y, z]) = info.grid_size {
        let megabytes = info.memory_bytes as f64 / 1e6;
        let occupied = 100.0 * info.occupied_voxels as f64 / (x * y * z) as f64;
        let error = match info.storage_error {
            0.0 => String::new(),
            error => format!(" Values differ by up to {error:.1e}."),
        };
        hint(
            ui,
            &format!(
                "{x} × {y} × {z} voxels, {occupied:.0} % not empty, {megabytes:.1} MB. Maximum density {:.3}, \
                 mean {:.3}.{error}",
                info.max_density, info.mean_density
            ),
        );
    }
}

fn source_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    let density = &mut cx.draft.medium_at_mut(cx.medium).density;
    let mut kind = match density {
        DensityDoc::Uniform {} => Kind::Uniform,
        DensityDoc::Grid(_) => Kind::Grid,
        DensityDoc::RgbGrid(_) => Kind::Rgb,
    };
    row_of(ui, key("medium.density.kind"), |ui, _| {
        let options = [
            (Kind::Uniform, "Uniform", "1 everywhere in a unit cube: a homogeneous medium"),
            (Kind::Grid, "Grid", "A scalar grid from an OpenVDB, .npy or .vol file"),
            (
                Kind::Rgb,
                "RGB grid",
                "Density × extinction per colour channel; the extinction spectrum is not used",
            ),
        ];
        if segmented(ui, "Density source", &mut kind, &options) {
            let grid = density.grid().cloned().unwrap_or_default();
            *density = match kind {
                Kind::Uniform => DensityDoc::Uniform {},
                Kind::Grid => DensityDoc::Grid(grid),
                Kind::Rgb => DensityDoc::RgbGrid(grid),
            };
        }
    });
    let Cx { draft, grids, commands, state, medium, .. } = cx;
    if let DensityDoc::Grid(grid) | DensityDoc::RgbGrid(grid) = &mut draft.medium_at_mut(*medium).density {
        let chosen =
            state.scene.as_ref().and_then(|info| info.medium(*medium)).map(|info| info.density_grid.as_str());
        grid_ui(ui, ("density", chosen), grid, grids, commands, Purpose::DensityFile);
    } else {
        hint(ui, "Drop a .vdb, .npy or .vol file anywhere in the window to use it as density.");
    }
}

/// Shows file and grid of the quantity `name`; `chosen` is the grid that was read, `purpose` that of a chosen
/// file.
pub(super) fn grid_ui(
    ui: &mut Ui,
    (name, chosen): (&str, Option<&str>),
    grid: &mut GridRef,
    lists: &GridLists,
    commands: &mut Vec<Command>,
    purpose: Purpose,
) {
    let tip = "OpenVDB, .npy or Mitsuba .vol; relative to the scene file";
    if path_field(ui, "File", &format!("{name} file"), "cloud.vdb", &mut grid.file, tip) {
        commands.push(Command::Ask(purpose));
    }
    if grid.file.is_empty() {
        hint(ui, "Choose a file, or drop one into the window.");
        return;
    }
    let Some(names) = lists.names(&grid.file) else {
        if !lists.is_listed(&grid.file) {
            commands.push(Command::ListGrids(grid.file.clone()));
        }
        return;
    };
    row(ui, "Grid", "Grid of the file to use", |ui, label| {
        let by_default = match chosen {
            Some(chosen) if names.iter().any(|name| name == chosen) => format!("by default: {chosen}"),
            _ => "by default".into(),
        };
        let shown = grid.grid.clone().unwrap_or(by_default);
        let combo = ComboBox::from_id_salt((name, "grid")).selected_text(shown).width(ui.available_width());
        let response = combo.show_ui(ui, |ui| {
            ui.selectable_value(&mut grid.grid, None, "by default");
            for name in names {
                ui.selectable_value(&mut grid.grid, Some(name.clone()), name);
            }
        });
        response.response.labelled_by(label);
    });
}
