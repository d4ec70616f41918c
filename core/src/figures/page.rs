//! HTML page of figures and study: one self-contained file.

use super::compose::png;
use super::results::Results;
use super::study::{Matrix, SceneStudy, name};
use super::{FiguresError, Options};
use crate::bench::Row;
use crate::compare::report::{ReportError, words};
use base64::Engine;
use minijinja::Environment;
use serde_json::{Value, json};
use std::path::Path;

/// Template with style; every inserted value is escaped.
const TEMPLATE: &str = include_str!("../../../assets/figures.html");

/// Renders the page.
pub(super) fn render(results: &Results, options: &Options) -> Result<String, FiguresError> {
    let failed = |e: minijinja::Error| ReportError::write(Path::new("index.html"), format!("{e:#}"));
    let mut environment = Environment::new();
    // The extension of the template name enables escaping.
    environment.add_template("figures.html", TEMPLATE).map_err(failed)?;
    let context = minijinja::Value::from(minijinja::value::Serde(context(results, options)?));
    Ok(environment.get_template("figures.html").and_then(|t| t.render(context)).map_err(failed)?)
}

fn context(results: &Results, options: &Options) -> Result<Value, FiguresError> {
    let mut figures = Vec::new();
    for (figure, rows) in &results.figures {
        let mut strips = Vec::new();
        for rendered in rows {
            let mut cells = Vec::new();
            for placed in rendered.cells() {
                let base64 = base64::engine::general_purpose::STANDARD.encode(png(&placed.image)?);
                let (width, height) = placed.image.dimensions();
                cells.push(json!({
                    "label": placed.label, "note": placed.note, "png": base64, "width": width, "height": height,
                }));
            }
            let panels = rendered.numbers().into_iter().map(|n| {
                json!({
                    "label": n.panel,
                    "spp": n.row.spp,
                    "seconds": words::number(n.row.seconds),
                    "lookups": words::number(n.row.lookups_per_path),
                    "relmse": words::quantity(n.row.relmse.unwrap_or(f64::NAN), n.relmse_error),
                    "rmse": words::quantity(n.rmse, n.rmse_error),
                    "variance": words::quantity(n.row.variance, n.variance_error),
                    "chroma": words::percent(n.row.chroma_variance / n.row.variance),
                    "verdict": n.row.verdict,
                    "against": n.row.against,
                })
            });
            strips.push(json!({
                "name": rendered.strip.name, "about": rendered.strip.about,
                "cells": cells, "panels": panels.collect::<Vec<_>>(),
            }));
        }
        figures.push(json!({
            "id": figure.id, "title": figure.title, "shows": figure.shows, "strips": strips,
        }));
    }
    let threads = results.rows().map(|r| r.reference.snapshot.threads).max().unwrap_or(0);
    Ok(json!({
        "version": env!("CARGO_PKG_VERSION"),
        "figures": figures,
        "conclusion": results.conclusion(),
        "matrix": matrix(&Matrix::of(&results.studies)),
        "studies": results.studies.iter().map(study).collect::<Vec<_>>(),
        "notes": results.notes(),
        "command": options.command,
        "spp": options.spp,
        "reference_spp": options.reference_spp,
        "threads": threads,
        "study_seconds": options.study.map(|s| words::tick(s.seconds)),
        "study_repeats": options.study.map(|s| s.repeats),
    }))
}

/// Ratios by topic; the CSS class of a cell is its outcome.
fn matrix(matrix: &Matrix) -> Value {
    let blocks = matrix.blocks.iter().map(|(heading, lines)| {
        let lines = lines.iter().map(|line| {
            let cells = line.cells.iter().map(|cell| match cell {
                Some((text, outcome)) => json!({ "text": text, "words": outcome.words() }),
                None => json!({ "text": "–", "words": "did not run" }),
            });
            json!({
                "variant": line.variant, "against": line.against, "by": line.by,
                "cells": cells.collect::<Vec<_>>(),
            })
        });
        json!({ "heading": heading, "lines": lines.collect::<Vec<_>>() })
    });
    json!({ "scenes": matrix.scenes, "blocks": blocks.collect::<Vec<_>>() })
}

fn study(study: &SceneStudy) -> Value {
    let row = |row: &Row| {
        json!({
            "name": name(&row.estimator),
            "spp": words::number(row.spp),
            "paths": words::number(row.paths_per_second),
            "lookups": words::number(row.lookups_per_path),
            "lost": if row.lost > 0.0 { format!("{} %", words::number(100.0 * row.lost)) } else { "0".into() },
            "relmse": row.relmse.in_words(),
            "efficiency": row.efficiency.in_words(),
            "star": row.heavy_tailed,
        })
    };
    let left_out = study.left_out.iter().map(|l| json!({ "name": name(l.variant), "reason": l.reason }));
    json!({
        "name": study.scene,
        "about": study.about,
        "rows": study.rows.iter().map(row).collect::<Vec<_>>(),
        "left_out": left_out.collect::<Vec<_>>(),
    })
}
