//! Makes figures and study, and writes them as they come.
//!
//! Whoever stops it half-way keeps what was finished: after every figure and after every scene of the study all
//! tables and the page are written anew, each file in one step.

use super::render::{Rendered, render};
use super::study::{self, SceneStudy, VARIANTS};
use super::{Figure, FiguresError, Options, Strip, compose, write};
use crate::compare::report::make_folder;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// How far it is.
#[derive(Clone, Debug)]
pub struct Progress {
    /// From 0 to 1, by what the parts are expected to take.
    pub fraction: f64,
    /// What is being done.
    pub doing: String,
}

/// Everything that has come of it so far.
#[derive(Clone, Debug, Default)]
pub struct Results {
    /// Figures that are finished, with their rows.
    pub figures: Vec<(&'static Figure, Vec<Rendered>)>,
    /// Scenes of the study that are finished.
    pub studies: Vec<SceneStudy>,
    /// Seconds from the start.
    pub seconds: f64,
    /// The files that were written, each once.
    pub files: Vec<PathBuf>,
}

impl Results {
    /// The rows of all figures.
    pub fn rows(&self) -> impl Iterator<Item = &Rendered> {
        self.figures.iter().flat_map(|(_, rows)| rows)
    }

    /// What the study says, from its numbers.
    #[must_use]
    pub fn conclusion(&self) -> Vec<String> {
        study::conclusion(&self.studies)
    }

    /// What wants to be known, a sentence each.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        let mut notes: Vec<String> = Vec::new();
        for rendered in self.rows() {
            for note in &rendered.notes {
                let note = format!("{}: {note}", rendered.strip.name);
                if !notes.contains(&note) {
                    notes.push(note);
                }
            }
        }
        notes
    }
}

/// Renders these figures and runs the study on their scenes. Everything that was asked for is checked before
/// anything is rendered.
///
/// # Errors
/// When the folder cannot be written, a setting or volume makes no sense, or a scene cannot be rendered.
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

/// That every document makes sense, and every volume has a place.
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

/// Seconds that the parts of a row take on two cores, roughly: only the progress bar asks.
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
    /// One majorant for the whole medium is slower to fly through than local ones.
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
