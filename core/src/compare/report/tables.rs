//! Ranking and error curves as comma-separated values.

use super::gather::Gathered;
use super::{ReportError, row};
use crate::measure::MEASURES;
use std::path::Path;

/// One line per view: its row, and every measure with its standard error and the contribution of the
/// reference noise.
pub(super) fn ranking(gathered: &Gathered<'_>) -> Result<String, ReportError> {
    let mut heading: Vec<String> = [
        "label",
        "estimator",
        "name",
        "mode",
        "seed",
        "spp",
        "seconds",
        "wall_seconds",
        "lookups",
        "lookups_per_path",
        "variance",
        "variance_error",
        "chroma_variance",
        "efficiency",
        "speedup",
        "speedup_lo",
        "speedup_hi",
        "verdict",
        "against",
        "declared_bias",
        "difference",
        "difference_error",
        "bias_z",
        "p",
        "pixels",
        "excluded",
    ]
    .map(str::to_owned)
    .to_vec();
    for measure in MEASURES {
        heading.extend(["", "_error", "_reference_share"].map(|part| format!("{}{part}", measure.id)));
    }
    let mut table = vec![heading];
    let rows = row::of_standings(gathered.experiment, &gathered.standings);
    for (row, standing) in rows.into_iter().zip(&gathered.standings) {
        let mode = if row.mode == crate::scene::Mode::Rgb { "rgb" } else { "spectral" };
        let found = standing.agreement;
        let mut line = vec![
            row.label,
            row.estimator,
            standing.name.clone(),
            mode.to_owned(),
            row.seed.to_string(),
            row.spp.to_string(),
            cell(row.seconds),
            cell(row.wall_seconds),
            row.lookups.to_string(),
            cell(row.lookups_per_path),
            cell(row.variance),
            cell(standing.variance_error),
            cell(row.chroma_variance),
            cell(row.efficiency),
            cell(row.speedup),
            cell(row.speedup_ci[0]),
            cell(row.speedup_ci[1]),
            row.verdict,
            row.against,
            row.declared_bias.unwrap_or_default().to_owned(),
            cell(found.map(|a| a.difference)),
            cell(found.map(|a| a.error)),
            cell(row.bias_z),
            cell(row.p),
            standing.pixels.to_string(),
            row.excluded.to_string(),
        ];
        for measure in MEASURES {
            let found = standing.error(measure.id);
            let parts =
                [found.map(|m| m.corrected()), found.map(|m| m.error), found.map(|m| m.reference_share)];
            line.extend(parts.map(cell));
        }
        table.push(line);
    }
    text(table)
}

/// One line per checkpoint and measure; look-ups are per pixel.
pub(super) fn curves(gathered: &Gathered<'_>) -> Result<String, ReportError> {
    let heading = ["view", "spp", "cpu_seconds", "lookups", "measure", "value", "error"];
    let mut table = vec![heading.map(str::to_owned).to_vec()];
    for shown in &gathered.views {
        for (measure, points) in &shown.curves {
            for point in points {
                let [spp, seconds, lookups] = point.along.map(cell);
                let (value, error) = (cell(point.value), cell(point.error));
                let view = shown.view.label.clone();
                table.push(vec![view, spp, seconds, lookups, measure.id.to_owned(), value, error]);
            }
        }
    }
    text(table)
}

/// Formats a number in full precision; empty if it is missing or not finite.
pub(crate) fn cell(value: impl Into<Option<f64>>) -> String {
    value.into().filter(|x| x.is_finite()).map_or_else(String::new, |x| x.to_string())
}

/// Formats lines as CSV.
pub(crate) fn text(lines: Vec<Vec<String>>) -> Result<String, ReportError> {
    // Writing to memory does not fail in practice; an error is reported nevertheless.
    let failed = |e: &dyn std::fmt::Display| ReportError::write(Path::new("the table"), e);
    let mut writer = csv::Writer::from_writer(Vec::new());
    for line in lines {
        writer.write_record(&line).map_err(|e| failed(&e))?;
    }
    let bytes = writer.into_inner().map_err(|e| failed(&e))?;
    String::from_utf8(bytes).map_err(|e| failed(&e))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::report::fixture;

    fn records(text: &str) -> Vec<csv::StringRecord> {
        csv::Reader::from_reader(text.as_bytes()).records().map(Result::unwrap).collect()
    }

    #[test]
    fn tables_hold_the_standings_and_the_curves() {
        let experiment = fixture::experiment("A cloud, \"quoted\"");
        let gathered = Gathered::of(&experiment);
        let text = ranking(&gathered).unwrap();
        let heading: Vec<&str> = text.lines().next().unwrap().split(',').collect();
        let column = |name: &str| heading.iter().position(|h| *h == name).unwrap();
        let lines = records(&text);
        assert_eq!(lines.len(), 3);
        for (line, standing) in lines.iter().zip(&gathered.standings) {
            assert_eq!(line[column("label")], standing.label);
            let number = |name: &str| line[column(name)].parse::<f64>().unwrap();
            assert_eq!(number("efficiency"), standing.efficiency);
            assert_eq!(number("relmse"), standing.error("relmse").unwrap().corrected());
            assert_eq!(number("flip_error"), standing.error("flip").unwrap().error);
            assert_eq!(line[column("verdict")], standing.verdict().to_string());
        }
        let lines = records(&curves(&gathered).unwrap());
        let points: usize = gathered.views.iter().map(|v| v.curves[0].1.len()).sum();
        assert!(points >= 9);
        assert_eq!(lines.len(), points * (MEASURES.len() - 1));
        // Every curve ends with the image of the table.
        let last = lines.iter().rfind(|l| &l[0] == "A" && &l[4] == "relmse").unwrap();
        assert_eq!(&last[1], "8");
        let error = gathered.standings[0].error("relmse").unwrap().corrected();
        assert_eq!(last[5].parse::<f64>().unwrap(), error);
    }
}
