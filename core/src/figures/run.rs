//! Execution of figures and study, with incremental output.
//!
//! Results are kept if the run is interrupted: after every figure and after every scene of the study all
//! tables and the page are written again, each file atomically.

use super::render::render;
use super::results::Results;
use super::study::{self, VARIANTS};
use super::{Figure, FiguresError, Options, Strip, compose, write};
use crate::compare::report::make_folder;
use std::path::Path;
use std::time::Instant;

/// Progress of figures and study.
#[derive(Clone, Debug)]
pub struct Progress {
    /// Fraction of the expected duration, from 0 to 1.
    pub fraction: f64,
    /// Description of the current step.
    pub doing: String,
}

/// Renders the given figures and runs the study on their scenes. All options are checked before rendering
/// starts.
///
/// # Errors
/// When the folder cannot be written, a setting or volume is invalid, or a scene cannot be rendered.
pub fn run(
    figures: &[&'static Figure],
    options: &Options,
    dir: &Path,
    mut progress: impl FnMut(&Progress),
) -> Result<Results, FiguresError> {
    check(figures, options)?;
    make_folder(dir)?;
    let began = Instant::now();
    let total: f64 = figures.iter().flat_map(|f| f.strips).map(|s| cost(s, options).sum()).sum();
    let mut done = 0.0;
    let mut report = |seconds: f64, doing: String| {
        progress(&Progress { fraction: f64::min(seconds / total, 1.0), doing });
    };
    let mut results = Results::default();
    for figure in figures {
        let mut rows = Vec::new();
        for strip in figure.strips {
            let cost = cost(strip, options);
            let rendered = render(strip, options, |panels, reference| {
                let what = if panels < 1.0 { "panels" } else { "reference" };
                report(
                    done + panels * cost.panels + reference * cost.reference,
                    format!("{}  {what}", strip.name),
                );
            })?;
            done += cost.panels + cost.reference;
            write::pictures(&rendered, dir, &mut results.files)?;
            rows.push(rendered);
        }
        write::figure(figure, &compose::compose(figure, &rows), dir, &mut results.files)?;
        results.figures.push((figure, rows));
        results.seconds = began.elapsed().as_secs_f64();
        write::results(&mut results, options, dir)?;
    }
    let Some(study) = options.study else { return Ok(results) };
    for i in 0..results.rows().count() {
        let Some(rendered) = results.rows().nth(i) else { break };
        let cost = cost(rendered.strip, options).study;
        let found = study::run(rendered, study, options, |p| {
            report(done + cost * p.done as f64 / p.of.max(1) as f64, format!("study  {}", p.next));
        })?;
        done += cost;
        results.studies.push(found);
        results.seconds = began.elapsed().as_secs_f64();
        write::results(&mut results, options, dir)?;
    }
    Ok(results)
}

/// Checks that every document is valid and that every volume is used.
fn check(figures: &[&'static Figure], options: &Options) -> Result<(), FiguresError> {
    let strips = || figures.iter().flat_map(|figure| figure.strips);
    for own in &options.volumes {
        if !strips().any(|strip| options.volume(strip.stage) == Some(own)) {
            return Err(FiguresError::Unused { file: own.file.display().to_string() });
        }
    }
    for strip in strips() {
        let scene = strip.scene_doc(options)?;
        strip.panels_doc(&scene, options)?;
        strip.reference_doc(&scene, options)?;
    }
    Ok(())
}

/// Approximate seconds of the parts of a row on two cores, used by the progress bar only.
#[derive(Clone, Copy)]
struct Cost {
    panels: f64,
    reference: f64,
    study: f64,
}

impl Cost {
    fn sum(self) -> f64 {
        self.panels + self.reference + self.study
    }
}

fn cost(strip: &Strip, options: &Options) -> Cost {
    const PATHS_PER_SECOND: f64 = 1e6;
    /// One majorant for the whole medium is slower than local majorants.
    const GLOBAL_MAJORANT: f64 = 3.0;
    let [w, h] = options.size.unwrap_or(strip.size).map(f64::from);
    let paths = |spp: u64| w * h * spp as f64 / PATHS_PER_SECOND;
    let runs = options.study.map_or(0.0, |s| s.seconds * f64::from(s.repeats)) * VARIANTS.len() as f64;
    Cost {
        panels: GLOBAL_MAJORANT * strip.panels.len() as f64 * paths(options.spp),
        reference: paths(options.reference_spp),
        study: runs,
    }
}
