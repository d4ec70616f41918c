//! Template context of the page, with every number as text.

use super::gallery::{Layer, layers};
use super::ranking::{Line, ranking, summary};
use super::settings::{Setting, settings};
use crate::compare::curve::Axis;
use crate::compare::report::gather::Gathered;
use crate::compare::report::{Formats, plot, words};
use crate::io::scene_file;
use crate::measure::{self, MEASURES};
use crate::scene::Fairness;
use serde::Serialize;

/// Context of the whole page.
#[derive(Serialize)]
pub(super) struct Context {
    title: String,
    note: String,
    version: &'static str,
    size: String,
    against: String,
    fairness: &'static str,
    /// Budget of the views, if it was the same for all.
    budget: Option<String>,
    /// Maximum number of images in a row.
    columns: usize,
    threads: usize,
    region: Option<String>,
    summary: String,
    /// Whether errors were measured.
    errors: bool,
    /// Selected measure, unless it is a column of the table anyway.
    other_measure: Option<&'static str>,
    ranking: Vec<Line>,
    layers: Vec<Layer>,
    plots: Vec<plot::Plot>,
    measure: &'static str,
    settings: Vec<Setting>,
    measures: Vec<Definition>,
    maps: Vec<Definition>,
    notes: Vec<String>,
    command: Option<String>,
    scene: String,
}

#[derive(Serialize)]
struct Definition {
    name: &'static str,
    formula: &'static str,
}

impl Context {
    pub fn of(gathered: &Gathered<'_>, what: &Formats) -> Result<Self, String> {
        let doc = &gathered.experiment.doc;
        let first = gathered.views.first().map(|v| &v.view.snapshot);
        let other_measure = (gathered.measure.id != "relmse").then_some(gathered.measure.name);
        Ok(Self {
            title: doc.title.clone(),
            note: doc.note.clone(),
            version: env!("CARGO_PKG_VERSION"),
            size: first.map_or_else(String::new, |s| format!("{} × {}", s.width, s.height)),
            against: gathered.compared_with(),
            fairness: match doc.compare.fairness {
                Fairness::Time => "CPU seconds of path tracing",
                Fairness::Samples => "samples per pixel",
                Fairness::Lookups => "look-ups of the medium",
            },
            budget: budget(gathered),
            columns: columns(gathered.views.len() + usize::from(gathered.reference().is_some())),
            threads: first.map_or(0, |s| s.threads),
            region: doc.compare.region.map(|[x0, y0, x1, y1]| {
                format!("columns {x0} to {} and rows {y0} to {}", x1.saturating_sub(1), y1.saturating_sub(1))
            }),
            summary: summary(&gathered.standings),
            errors: gathered.experiment.has_errors(),
            other_measure,
            ranking: ranking(gathered),
            layers: layers(gathered)?,
            plots: [Axis::Samples, Axis::Seconds]
                .into_iter()
                .filter_map(|a| plot::plot(gathered, a))
                .collect(),
            measure: gathered.measure.name,
            settings: settings(gathered),
            measures: measures(gathered),
            maps: gathered
                .maps
                .iter()
                .map(|(m, _)| Definition { name: m.name, formula: m.formula })
                .collect(),
            notes: what.notes.clone(),
            command: what.command.clone(),
            scene: scene_file::to_toml(doc),
        })
    }
}

fn budget(gathered: &Gathered<'_>) -> Option<String> {
    let first = gathered.standings.first()?;
    if gathered.standings.iter().all(|s| s.spp == first.spp) {
        return Some(format!("{} samples per pixel", first.spp));
    }
    gathered.experiment.doc.render.cpu_seconds.map(|s| format!("{} CPU seconds", words::tick(s.into())))
}

/// Number of columns: few rows, with images that are large enough, and no row with a single image.
fn columns(pictures: usize) -> usize {
    match pictures {
        0 => 1,
        1..=4 => pictures,
        5 | 6 => 3,
        _ => 4,
    }
}

/// Measures shown on the page.
fn measures(gathered: &Gathered<'_>) -> Vec<Definition> {
    let shown = ["relmse", gathered.measure.id];
    let shown = MEASURES.iter().filter(|m| shown.contains(&m.id));
    shown.map(|m: &measure::Measure| Definition { name: m.name, formula: m.formula }).collect()
}
