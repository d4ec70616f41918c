//! Text table of a benchmark.

use majorant_core::bench::Row;
use majorant_core::compare::report::words;

const WIDTHS: [usize; 9] = [14, 13, 7, 7, 9, 8, 9, 27, 22];

/// Heading of the table.
pub(super) fn heading() -> String {
    let cells =
        ["scene", "estimator", "spp", "CPU s", "Mpaths/s", "look-ups", "relMSE", "efficiency", "speed-up"];
    padded(cells.map(str::to_owned))
}

/// Formats a row.
pub(super) fn line(row: &Row) -> String {
    let star = if row.heavy_tailed { "*" } else { "" };
    padded([
        row.scene.clone(),
        row.estimator.clone(),
        words::number(row.spp),
        words::number(row.cpu_seconds),
        format!("{:.3}", row.paths_per_second / 1e6),
        format!("{:.2}", row.lookups_per_path),
        words::number(row.relmse.mean),
        format!("{}{star}", row.efficiency.in_words()),
        row.speedup.in_words(),
    ])
}

fn padded(cells: [String; 9]) -> String {
    let cell = |(i, text): (usize, &String)| {
        if !(2..=6).contains(&i) {
            format!("{text:<0$}", WIDTHS[i])
        } else {
            format!("{text:>0$}", WIDTHS[i])
        }
    };
    cells.iter().enumerate().map(cell).collect::<Vec<_>>().join("  ").trim_end().to_owned()
}

/// Notes below the table: the references, and a warning about heavy-tailed errors.
pub(super) fn notes(rows: &[Row]) -> Vec<String> {
    let mut notes: Vec<String> = Vec::new();
    for row in rows {
        let note = format!("{}: errors against {}", row.scene, row.reference);
        if !notes.contains(&note) {
            notes.push(note);
        }
    }
    if rows.iter().any(|row| row.heavy_tailed) {
        notes.push("* one run has most of the error: use more or longer repeats".into());
    }
    notes
}
