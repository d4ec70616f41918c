//! Text table of the ranking.

use majorant_core::compare::report::words;
use majorant_core::compare::{Experiment, Standing};
use majorant_core::measure::{self, Measure, Measured};

/// Lines of the table, heading first, followed by the images that the views were compared with.
pub(super) fn lines(experiment: &Experiment) -> Vec<String> {
    let chosen = measure::find(&experiment.doc.compare.measure.0).filter(|m| m.id != "relmse");
    let measures: Vec<&'static Measure> = measure::find("relmse").into_iter().chain(chosen).collect();
    let standings = experiment.rank(measures.clone());
    let mut table = vec![heading(&measures)];
    table.extend(standings.iter().map(|s| cells(s, &measures)));
    let width = |column: usize| table.iter().map(|l| l[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..table[0].len()).map(width).collect();
    let last = widths.len() - 1;
    let line = |cells: &Vec<String>| {
        let padded = cells.iter().enumerate().map(|(i, cell)| match i {
            0 | 1 => format!("{cell:<0$}", widths[i]),
            _ if i == last => cell.clone(),
            _ => format!("{cell:>0$}", widths[i]),
        });
        padded.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    let mut lines: Vec<String> = table.iter().map(line).collect();
    for against in against(&standings) {
        lines.push(against);
    }
    lines
}

fn heading(measures: &[&Measure]) -> Vec<String> {
    let mut cells: Vec<String> =
        ["", "estimator", "spp", "CPU s", "look-ups/path"].map(str::to_owned).to_vec();
    cells.extend(measures.iter().map(|m| m.name.to_owned()));
    cells.extend(["variance", "chroma", "efficiency", "speed-up", "verdict"].map(str::to_owned));
    cells
}

fn cells(s: &Standing, measures: &[&Measure]) -> Vec<String> {
    let mut cells = vec![
        s.label.clone(),
        s.estimator.clone(),
        s.spp.to_string(),
        words::number(s.cpu_seconds),
        words::number(s.lookups_per_path),
    ];
    let text = |m: &Measured| words::quantity(m.corrected(), m.error);
    cells.extend(measures.iter().map(|m| s.error(m.id).map_or_else(|| "–".into(), text)));
    cells.extend([
        words::number(s.variance),
        words::percent(s.chroma_variance / s.variance),
        words::number(s.efficiency),
        [words::speedup(s), words::interval(s).unwrap_or_default()].join(" ").trim_end().to_owned(),
        words::verdict(s),
    ]);
    cells
}

/// One line per reference, with the views that were compared with it.
fn against(standings: &[Standing]) -> Vec<String> {
    let mut all: Vec<(String, Vec<&str>)> = Vec::new();
    for s in standings {
        let text = words::against(&s.against);
        match all.iter_mut().find(|(known, _)| *known == text) {
            Some((_, labels)) => labels.push(&s.label),
            None => all.push((text, vec![&s.label])),
        }
    }
    all.into_iter().map(|(text, labels)| format!("{} against {text}", labels.join(", "))).collect()
}
