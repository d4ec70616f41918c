//! Points of a tabulated phase function, typed or from a file.

use super::Cx;
use crate::model::{Command, Purpose};
use crate::theme::Palette;
use crate::widgets::{buffered_text, callout, hint, path_field, row, segmented};
use egui::Ui;
use majorant_core::io::phase_table;
use majorant_core::phase::check_table;
use majorant_core::scene::{Angle, PhaseDoc};

/// Maximum number of points that can be edited in the panel.
const SHOWN: usize = 200;

/// Shows the table of a tabulated phase function.
pub(super) fn table_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    let read = cx.medium_info().map(|info| info.phase_points.as_slice()).unwrap_or_default();
    let PhaseDoc::Tabulated { angle, points, file } = &mut cx.draft.medium_at_mut(cx.medium).phase else {
        return;
    };
    row(ui, "First column", "Meaning of the first number of each point", |ui, _| {
        let options = [
            (Angle::Cosine, "cos θ", "−1 is backward, 1 forward"),
            (Angle::Degrees, "θ in °", "0 is forward, 180 backward"),
        ];
        let before = *angle;
        if segmented(ui, "First column", angle, &options) && file.is_empty() {
            *points = converted(points, before, *angle);
        }
    });
    let tip = "A text file with an angle and a value on each line, relative to the scene file; if empty, the points below are used";
    let mut named = file.clone();
    if path_field(ui, "File", "phase table", "lobe.csv", &mut named, tip) {
        cx.commands.push(Command::Ask(Purpose::PhaseTable));
    }
    if named != *file {
        if !named.is_empty() {
            points.clear();
        }
        *file = named;
    }
    if !file.is_empty() {
        hint(ui, &format!("{} points, interpolated linearly in cos θ.", read.len()));
        if !read.is_empty() && ui.button("Copy the points into the scene").clicked() {
            *points = read.to_vec();
            file.clear();
        }
        return;
    }
    if points.len() > SHOWN {
        hint(ui, &format!("{} points, too many to edit here.", points.len()));
    } else {
        points_ui(ui, points);
    }
    if let Err(problem) = check_table(*angle, points) {
        callout(ui, Palette::get(ui).error, &format!("The table {problem}."));
    }
}

fn points_ui(ui: &mut Ui, points: &mut Vec<[f32; 2]>) {
    let lines: Vec<String> = points.iter().map(|[at, value]| format!("{at}, {value}")).collect();
    let before = lines.join("\n");
    let mut text = before.clone();
    let id = ui.make_persistent_id("phase points");
    let rows = lines.len().clamp(4, 12);
    let response = buffered_text(ui, id, "Phase points", "angle, value", &mut text, rows);
    response.on_hover_text(
        "An increasing angle and a value on each line; the values are scaled to integrate to 1",
    );
    if text != before {
        // An edit with invalid lines is ignored.
        if let Ok(read) = phase_table::parse(&text, "points") {
            *points = read;
        }
    }
}

/// Converts the points to another angle, in increasing order, with six digits.
fn converted(points: &[[f32; 2]], from: Angle, to: Angle) -> Vec<[f32; 2]> {
    let short = |x: f64| format!("{x:.5e}").parse().unwrap_or(x as f32);
    let angle = |at: f32| match (from, to) {
        (Angle::Cosine, Angle::Degrees) => short(f64::from(at).clamp(-1.0, 1.0).acos().to_degrees()),
        (Angle::Degrees, Angle::Cosine) => short(f64::from(at).to_radians().cos()),
        (Angle::Cosine, Angle::Cosine) | (Angle::Degrees, Angle::Degrees) => at,
    };
    let mut points: Vec<[f32; 2]> = points.iter().map(|[at, value]| [angle(*at), *value]).collect();
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    points.dedup_by(|b, a| b[0] <= a[0]);
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conversion_between_angles_keeps_the_lobe() {
        let degrees = vec![[0.0, 3.0], [60.0, 2.0], [90.0, 1.0], [180.0, 0.5]];
        let cosines = converted(&degrees, Angle::Degrees, Angle::Cosine);
        assert_eq!(cosines.first(), Some(&[-1.0, 0.5]));
        assert_eq!(cosines.last(), Some(&[1.0, 3.0]));
        assert_eq!(cosines[2], [0.5, 2.0]);
        assert!(check_table(Angle::Cosine, &cosines).is_ok());
        let back = converted(&cosines, Angle::Cosine, Angle::Degrees);
        for (a, b) in degrees.iter().zip(&back) {
            assert!((a[0] - b[0]).abs() < 1e-3 && a[1] == b[1], "{a:?} {b:?}");
        }
    }
}
