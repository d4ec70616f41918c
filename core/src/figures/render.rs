//! Rendering of a row of a figure: its panels and their reference.

use super::{FiguresError, Options, Strip};
use crate::compare::{self, Experiment, Finished, Reference, Standing, View};
use crate::io::Library;
use crate::measure;
use crate::scene::SceneDoc;
use std::sync::Arc;

/// A rendered row of a figure.
#[derive(Clone, Debug)]
pub struct Rendered {
    /// Definition of the row.
    pub strip: &'static Strip,
    /// Scene with its own settings.
    pub scene: SceneDoc,
    /// Panels as views, with the reference.
    pub experiment: Experiment,
    /// Measurements of the panels, in the same order.
    pub standings: Vec<Standing>,
    /// Reference as a view.
    pub reference: View,
    /// Notices, one sentence each.
    pub notes: Vec<String>,
}

/// Renders the panels of a strip and its reference. `progress` receives the completed fractions of the panels
/// and of the reference, each from 0 to 1.
///
/// # Errors
/// When a setting does not apply, or the scene cannot be rendered.
pub fn render(
    strip: &'static Strip,
    options: &Options,
    mut progress: impl FnMut(f64, f64),
) -> Result<Rendered, FiguresError> {
    let scene = strip.scene_doc(options)?;
    let run = |doc: &SceneDoc, progress: &mut dyn FnMut(f64)| {
        compare::run(doc, Library::default(), |p| progress(p.fraction))
            .map_err(|source| FiguresError::Render { figure: strip.name, source })
    };
    let panels = strip.panels_doc(&scene, options)?;
    let Finished { mut experiment, mut notes } = run(&panels, &mut |done| progress(done, 0.0))?;
    let doc = strip.reference_doc(&scene, options)?;
    let finished = run(&doc, &mut |done| progress(1.0, done))?;
    notes.extend(finished.notes.into_iter().filter(|n| !notes.contains(n)).collect::<Vec<_>>());
    let (_, reference) = finished
        .experiment
        .views
        .into_iter()
        .next()
        .ok_or(FiguresError::Render { figure: strip.name, source: compare::RunError::Stopped })?;
    experiment.reference = Some(Arc::new(compared_with(&reference)));
    let measures = ["relmse", "rmse"].into_iter().filter_map(measure::find).collect();
    let standings = experiment.rank(measures);
    Ok(Rendered { strip, scene, experiment, standings, reference, notes })
}

impl Rendered {
    /// Reference for error measurement.
    #[must_use]
    pub fn compared_with(&self) -> Reference {
        compared_with(&self.reference)
    }
}

fn compared_with(view: &View) -> Reference {
    let id = &view.doc.estimator.id;
    let name = crate::estimator::find(id).map_or(id.as_str(), |e| e.name);
    Reference::of(&view.snapshot, format!("{name}, {} samples per pixel", view.snapshot.spp))
}
