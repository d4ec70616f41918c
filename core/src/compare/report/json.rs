//! JSON output of a report.

use super::gather::Gathered;
use super::{Formats, ReportError, row};
use crate::compare::maps::Scale;
use crate::io::scene_file;
use serde_json::{Value, json};
use std::path::Path;

/// Serialises the report.
pub(super) fn document(gathered: &Gathered<'_>, what: &Formats) -> Result<String, ReportError> {
    let failed = |e| ReportError::write(Path::new("compare.json"), e);
    let experiment = gathered.experiment;
    let rows = row::of_standings(experiment, &gathered.standings);
    let views = rows.iter().map(serde_json::to_value).collect::<Result<Vec<Value>, _>>().map_err(failed)?;
    let maps = gathered.maps.iter().map(|(map, range)| {
        let by_decades = matches!(range.scale, Scale::Logarithmic);
        json!({
            "id": map.id, "name": map.name, "formula": map.formula,
            "lo": range.lo, "hi": range.hi, "logarithmic": by_decades,
        })
    });
    let measures = crate::measure::MEASURES
        .iter()
        .map(|m| json!({ "id": m.id, "name": m.name, "formula": m.formula, "slope": m.slope }));
    let reference = gathered.reference();
    let document = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "title": experiment.doc.title,
        "command": what.command,
        "fairness": experiment.doc.compare.fairness,
        "measure": gathered.measure.id,
        "region": experiment.doc.compare.region,
        "held_against": gathered.compared_with(),
        "reference": reference.map(|r| json!({
            "origin": r.origin, "target": r.target, "has_noise": r.standard_error().is_some(),
        })),
        "views": views,
        "maps": maps.collect::<Vec<_>>(),
        "measures": measures.collect::<Vec<_>>(),
        "notes": what.notes,
        "scene": scene_file::to_toml(&experiment.doc),
    });
    serde_json::to_string_pretty(&document).map_err(failed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::report::fixture;

    #[test]
    fn the_document_repeats_the_rows_and_the_scene() {
        let experiment = fixture::experiment("A cloud");
        let gathered = Gathered::of(&experiment);
        let what = Formats { notes: vec!["mind this".into()], ..Formats::all() };
        let read: Value = serde_json::from_str(&document(&gathered, &what).unwrap()).unwrap();
        let views = read["views"].as_array().unwrap();
        assert_eq!(views.len(), 3);
        for (view, standing) in views.iter().zip(&gathered.standings) {
            assert_eq!(view["label"], standing.label.as_str());
            assert_eq!(view["variance"], standing.variance);
        }
        assert_eq!(read["notes"][0], "mind this");
        let scene = scene_file::parse(read["scene"].as_str().unwrap(), "the report").unwrap();
        assert_eq!(scene, *experiment.doc);
    }
}
