//! The curve of the majorant's factor, measured in the background while its panel shows it grow.

use majorant_core::bench::{FactorPoint, factor_curve};
use majorant_core::io::Library;
use majorant_core::scene::SceneDoc;
use majorant_core::transport::CancelToken;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::thread::JoinHandle;

/// What the thread tells.
enum News {
    Point(FactorPoint),
    Failed(String),
}

/// A measurement that runs.
struct Running {
    generation: Arc<AtomicU64>,
    news: Receiver<News>,
    thread: JoinHandle<()>,
}

/// A curve, what it is of, and the thread that measures it.
#[derive(Default)]
pub struct FactorCurve {
    points: Vec<FactorPoint>,
    /// What was measured, without the factor: the curve is of it only.
    of: Option<SceneDoc>,
    running: Option<Running>,
    leaving: Vec<JoinHandle<()>>,
    error: Option<String>,
}

/// The program waits for its threads when it ends.
impl Drop for FactorCurve {
    fn drop(&mut self) {
        self.cancel();
        for thread in self.leaving.drain(..) {
            // A panic in it has ended its news.
            let _ = thread.join();
        }
    }
}

/// Everything that the curve depends on.
fn subject(doc: &SceneDoc) -> SceneDoc {
    let mut doc = doc.clone();
    doc.medium.majorant.factor = 1.0;
    SceneDoc {
        title: String::new(),
        note: String::new(),
        view: SceneDoc::default().view,
        render: SceneDoc::default().render,
        compare: SceneDoc::default().compare,
        ..doc
    }
}

impl FactorCurve {
    /// The points so far.
    #[must_use]
    pub fn points(&self) -> &[FactorPoint] {
        &self.points
    }

    /// Whether it is being measured.
    #[must_use]
    pub fn is_running(&self) -> bool {
        self.running.is_some()
    }

    /// What went wrong.
    #[must_use]
    pub fn error(&self) -> Option<&str> {
        self.error.as_deref()
    }

    /// Whether the curve is of this document.
    #[must_use]
    pub fn is_of(&self, doc: &SceneDoc) -> bool {
        self.of.as_ref().is_some_and(|of| *of == subject(doc))
    }

    /// Measures anew, of a document whose files are named from anywhere in `resolved`; `wake` is called at every point.
    pub fn start(&mut self, doc: &SceneDoc, resolved: SceneDoc, wake: impl Fn() + Send + 'static) {
        self.cancel();
        self.points.clear();
        self.error = None;
        self.of = Some(subject(doc));
        let (sender, news) = channel();
        let generation = Arc::new(AtomicU64::new(0));
        let theirs = Arc::clone(&generation);
        let work = move || {
            let tell = |news: News| {
                // The window may be gone by now; then nobody wants to know.
                let _ = sender.send(news);
                wake();
            };
            let point = |point| tell(News::Point(point));
            let done =
                factor_curve("the scene", &resolved, Library::default(), CancelToken::new(&theirs, 0), point);
            if let Err(error) = done {
                tell(News::Failed(error.to_string()));
            }
            drop(sender);
            wake();
        };
        match std::thread::Builder::new().name("majorant-factors".into()).spawn(work) {
            Ok(thread) => self.running = Some(Running { generation, news, thread }),
            Err(error) => self.error = Some(format!("no thread could be started: {error}")),
        }
    }

    /// Ends a measurement that runs; its points stay.
    pub fn cancel(&mut self) {
        if let Some(running) = self.running.take() {
            running.generation.store(1, Ordering::Relaxed);
            self.leaving.push(running.thread);
        }
    }

    /// Takes note of what the thread has told.
    pub fn poll(&mut self) {
        self.leaving.retain(|thread| !thread.is_finished());
        let Some(running) = &self.running else { return };
        loop {
            match running.news.try_recv() {
                Ok(News::Point(point)) => self.points.push(point),
                Ok(News::Failed(error)) => self.error = Some(error),
                Err(TryRecvError::Empty) => return,
                Err(TryRecvError::Disconnected) => break,
            }
        }
        self.leaving.extend(self.running.take().map(|running| running.thread));
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
    fn it_is_measured_of_one_scene_and_says_of_which() {
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
        doc.medium.majorant.factor = 2.0;
        assert!(curve.is_of(&doc) && curve.error().is_none());
        doc.medium.scale = 2.0;
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
