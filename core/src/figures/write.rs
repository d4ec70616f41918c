//! Output files. Each is written under a temporary name and then renamed, so that no incomplete file is
//! visible.

use super::compose::png;
use super::render::Rendered;
use super::results::Results;
use super::{Figure, FiguresError, Options, compose, page};
use crate::bench;
use crate::compare::report::{ReportError, cell, csv_text};
use crate::io::export;
use image::RgbImage;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

fn put(dir: &Path, name: &str, bytes: &[u8], files: &mut Vec<PathBuf>) -> Result<(), FiguresError> {
    renamed(dir, name, files, |beside| {
        std::fs::write(beside, bytes).map_err(|e| ReportError::write(beside, e).into())
    })
}

fn renamed(
    dir: &Path,
    name: &str,
    files: &mut Vec<PathBuf>,
    write: impl FnOnce(&Path) -> Result<(), FiguresError>,
) -> Result<(), FiguresError> {
    let (path, beside) = (dir.join(name), dir.join(format!("{name}.part")));
    write(&beside)?;
    std::fs::rename(&beside, &path).map_err(|e| ReportError::write(&path, e))?;
    if !files.contains(&path) {
        files.push(path);
    }
    Ok(())
}

/// Writes PNG and EXR files of every panel of a row and of its reference.
pub(super) fn pictures(
    rendered: &Rendered,
    dir: &Path,
    files: &mut Vec<PathBuf>,
) -> Result<(), FiguresError> {
    let panels = rendered.experiment.views.iter().map(|(place, view)| (rendered.file(*place), view));
    let reference = (format!("{}-reference", rendered.strip.name), &rendered.reference);
    for (name, view) in panels.chain([reference]) {
        let picture = png(&compose::picture(view, &rendered.scene.view))?;
        put(dir, &format!("{name}.png"), &picture, files)?;
        renamed(dir, &format!("{name}.exr"), files, |beside| {
            Ok(export::write_exr(beside, &view.snapshot, &view.doc)?)
        })?;
    }
    Ok(())
}

/// Writes the composed figure.
pub(super) fn figure(
    figure: &Figure,
    image: &RgbImage,
    dir: &Path,
    files: &mut Vec<PathBuf>,
) -> Result<(), FiguresError> {
    put(dir, &format!("figure{}.png", figure.id), &png(image)?, files)
}

/// Writes tables, JSON and the page with all results so far.
pub(super) fn results(results: &mut Results, options: &Options, dir: &Path) -> Result<(), FiguresError> {
    let mut files = std::mem::take(&mut results.files);
    put(dir, "figures.csv", table(results)?.as_bytes(), &mut files)?;
    if !results.studies.is_empty() {
        let rows: Vec<_> = results.studies.iter().flat_map(|s| s.rows.iter().cloned()).collect();
        let text = bench::csv(&rows).map_err(|e| in_memory(&e))?;
        put(dir, "study.csv", text.as_bytes(), &mut files)?;
        put(dir, "answers.csv", answers(results)?.as_bytes(), &mut files)?;
    }
    let text = serde_json::to_string_pretty(&document(results, options)).map_err(|e| in_memory(&e))?;
    put(dir, "figures.json", text.as_bytes(), &mut files)?;
    put(dir, "index.html", page::render(results, options)?.as_bytes(), &mut files)?;
    results.files = files;
    Ok(())
}

fn in_memory(e: &dyn std::fmt::Display) -> ReportError {
    ReportError::write(Path::new("the tables"), e)
}

/// JSON document of all results.
fn document(results: &Results, options: &Options) -> Value {
    let figures = results.figures.iter().map(|(figure, rows)| {
        let strips = rows.iter().map(|r| {
            json!({
                "name": r.strip.name,
                "scene": r.strip.scene,
                "about": r.strip.about,
                "size": [r.scene.film.width, r.scene.film.height],
                "reference": {
                    "estimator": r.strip.reference.estimator,
                    "spp": r.reference.snapshot.spp,
                    "cpu_seconds": r.reference.snapshot.cpu_seconds,
                    "relative_error": r.reference.snapshot.relative_error(),
                    "png": format!("{}-reference.png", r.strip.name),
                    "exr": format!("{}-reference.exr", r.strip.name),
                },
                "panels": r.numbers(),
            })
        });
        json!({
            "figure": figure.id, "title": figure.title, "shows": figure.shows,
            "png": format!("figure{}.png", figure.id),
            "strips": strips.collect::<Vec<_>>(),
        })
    });
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "command": options.command,
        "seconds": results.seconds,
        "spp": options.spp,
        "reference_spp": options.reference_spp,
        "threads": options.threads,
        "volumes": options.volumes.iter().map(|v| v.file.display().to_string()).collect::<Vec<_>>(),
        "study_seconds": options.study.map(|s| s.seconds),
        "study_repeats": options.study.map(|s| s.repeats),
        "figures": figures.collect::<Vec<_>>(),
        "study": results.studies,
        "conclusion": results.conclusion(),
        "notes": results.notes(),
    })
}

/// One line per panel.
fn table(results: &Results) -> Result<String, ReportError> {
    let heading = [
        "strip",
        "panel",
        "estimator",
        "settings",
        "spp",
        "seconds",
        "lookups",
        "lookups_per_path",
        "relmse",
        "relmse_error",
        "rmse",
        "rmse_error",
        "variance",
        "variance_error",
        "chroma_variance",
        "verdict",
        "against",
        "seed",
    ];
    let mut table = vec![heading.map(str::to_owned).to_vec()];
    table.extend(results.rows().flat_map(Rendered::numbers).map(|n| {
        let mut line = vec![n.strip.to_owned(), n.panel.to_owned(), n.row.estimator, n.set.join(" ")];
        line.extend([n.row.spp.to_string(), cell(n.row.seconds), n.row.lookups.to_string()]);
        let relmse = n.row.relmse.unwrap_or(f64::NAN);
        let (variance, chroma) = (n.row.variance, n.row.chroma_variance);
        line.extend([n.row.lookups_per_path, relmse, n.relmse_error, n.rmse, n.rmse_error].map(cell));
        line.extend([variance, n.variance_error, chroma].map(cell));
        line.extend([n.row.verdict, n.row.against, n.row.seed.to_string()]);
        line
    }));
    csv_text(table)
}

/// One line per scene and question.
fn answers(results: &Results) -> Result<String, ReportError> {
    let heading =
        ["scene", "question", "variant", "against", "by", "ratio", "ratio_lo", "ratio_hi", "outcome"];
    let mut table = vec![heading.map(str::to_owned).to_vec()];
    for study in &results.studies {
        table.extend(study.answers.iter().map(|a| {
            let mut line = [study.scene, a.question, a.variant, a.against, a.by].map(str::to_owned).to_vec();
            line.extend([a.ratio.mean, a.ratio.lo, a.ratio.hi].map(cell));
            line.push(a.outcome.words().to_owned());
            line
        }));
    }
    csv_text(table)
}
