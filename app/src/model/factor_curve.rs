//! Cost and bias as a function of the majorant's factor, measured in the background.

use crate::background::{Background, Reply};
use majorant_core::bench::{FactorPoint, factor_curve};
use majorant_core::io::Library;
use majorant_core::scene::SceneDoc;

/// One point of the curve, or an error message.
type Measured = Result<FactorPoint, String>;

/// A measured curve, its scene, and the worker that measures it.
pub struct FactorCurve {
    points: Vec<FactorPoint>,
    /// Measured scene with a factor of 1, because the curve does not depend on the factor.
    of: Option<SceneDoc>,
    worker: Background<SceneDoc, Measured>,
    error: Option<String>,
}

impl Default for FactorCurve {
    fn default() -> Self {
        Self { points: Vec::new(), of: None, worker: Background::new("factors", measure), error: None }
    }
}

fn measure(resolved: SceneDoc, reply: &Reply<'_, SceneDoc, Measured>) {
    let point = |point| reply.send(Ok(point));
    if let Err(error) = factor_curve("the scene", &resolved, Library::default(), reply.cancel(), point) {
        reply.send(Err(error.to_string()));
    }
}

/// Returns the document reduced to everything that the curve depends on.
fn subject(doc: &SceneDoc) -> SceneDoc {
    let mut doc = doc.clone();
    for medium in &mut doc.media {
        medium.majorant.factor = 1.0;
    }
    SceneDoc {
        title: String::new(),
        note: String::new(),
        view: SceneDoc::default().view,
        render: SceneDoc::default().render,
        compare: SceneDoc::default().compare,
        window: toml::Table::new(),
        ..doc
    }
}

impl FactorCurve {
    /// Points measured so far.
    #[must_use]
    pub fn points(&self) -> &[FactorPoint] {
        &self.points
    }

    /// Whether a measurement is in progress.
    #[must_use]
    pub fn is_running(&self) -> bool {
        self.worker.is_running()
    }

    /// Error of the last measurement.
    #[must_use]
    pub fn error(&self) -> Option<&str> {
        self.error.as_deref()
    }

    /// Whether the curve belongs to this document.
    #[must_use]
    pub fn is_of(&self, doc: &SceneDoc) -> bool {
        self.of.as_ref().is_some_and(|of| *of == subject(doc))
    }

    /// Starts a measurement. All file names in `resolved` are absolute; `wake` is called after every point.
    pub fn start(&mut self, doc: &SceneDoc, resolved: SceneDoc, wake: impl Fn() + Send + Sync + 'static) {
        self.points.clear();
        self.of = Some(subject(doc));
        self.worker.set_wake(wake);
        let started = self.worker.submit(resolved);
        self.error = started.err().map(|error| format!("no thread could be started: {error}"));
    }

    /// Cancels a measurement in progress and keeps its points.
    pub fn cancel(&mut self) {
        self.poll();
        self.worker.cancel();
    }

    /// Adds the points measured since the last call.
    pub fn poll(&mut self) {
        for measured in self.worker.poll() {
            match measured {
                Ok(point) => self.points.push(point),
                Err(error) => self.error = Some(error),
            }
        }
        if self.worker.has_failed() {
            self.error = Some("the measurement stopped with an internal error; measure again".into());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use majorant_core::bench::FACTORS;
    use majorant_core::io::scene_file;

    fn finish(curve: &mut FactorCurve) {
        while curve.is_running() {
            std::thread::sleep(std::time::Duration::from_millis(2));
            curve.poll();
        }
    }

    #[test]
    fn a_curve_belongs_to_the_scene_that_was_measured() {
        let doc = scene_file::parse(
            "majorant = 1\nlights = [{ kind = \"environment\" }]\nfilm = { width = 8, height = 8 }",
            "a cube",
        );
        let mut doc = doc.unwrap();
        let mut curve = FactorCurve::default();
        assert!(!curve.is_of(&doc));
        curve.start(&doc, doc.clone(), || {});
        finish(&mut curve);
        assert_eq!(curve.points().len(), FACTORS.len());
        doc.medium_mut().majorant.factor = 2.0;
        assert!(curve.is_of(&doc) && curve.error().is_none());
        doc.medium_mut().scale = 2.0;
        assert!(!curve.is_of(&doc));
    }

    #[test]
    fn a_file_that_is_missing_becomes_a_message() {
        let doc = "majorant = 1\n[medium]\ndensity = { kind = \"grid\", file = \"/none.vdb\" }";
        let mut curve = FactorCurve::default();
        let doc = scene_file::parse(doc, "missing").unwrap();
        curve.start(&doc, doc.clone(), || {});
        finish(&mut curve);
        assert!(curve.error().is_some_and(|e| e.contains("none.vdb")), "{:?}", curve.error());
    }
}
