//! *Help ▸ Self-check*: the check that the command line makes, in the window.
//!
//! `mod.rs` is its state: what is asked, the thread that works on it, what has come of it so far.
//! `dialog.rs` draws it, `table.rs` its table.

mod dialog;
mod table;

pub(super) use dialog::self_check_ui;

use crate::background::{Background, Reply};
use crate::model::{Work, work_after};
use majorant_core::check::{self, Case, Check, CheckError, Effort, Row, Verdict};
use majorant_core::io::Library;
use majorant_core::scene::SceneDoc;

/// What is checked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Subject {
    /// The cases that are part of the program.
    #[default]
    BuiltIn,
    /// The scene as it is edited.
    ThisScene,
}

/// How the last check ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// With all its rows, after some seconds.
    Finished(f64),
    /// By the user.
    Cancelled,
    /// With an error.
    Failed(String),
}

/// What to check: the user's scene with its name, or the built-in cases; `deep` for the long version.
struct Order {
    own: Option<(String, SceneDoc)>,
    deep: bool,
}

/// What the worker reports.
enum News {
    At { done: usize, total: usize, what: String },
    Rows(Vec<Row>),
    Notes(Vec<String>),
    Ended(Ending),
}

/// The self-check of the window.
pub struct SelfCheck {
    /// Whether it is shown.
    pub open: bool,
    subject: Subject,
    /// The scene that the rows are about, if it is one's own.
    of: Option<SceneDoc>,
    deep: bool,
    only_failures: bool,
    worker: Background<Order, News>,
    done: usize,
    total: usize,
    at: String,
    rows: Vec<Row>,
    notes: Vec<String>,
    ending: Option<Ending>,
}

impl Default for SelfCheck {
    fn default() -> Self {
        Self {
            open: false,
            subject: Subject::default(),
            of: None,
            deep: false,
            only_failures: false,
            worker: Background::new("self-check", work),
            done: 0,
            total: 0,
            at: String::new(),
            rows: Vec::new(),
            notes: Vec::new(),
            ending: None,
        }
    }
}

impl SelfCheck {
    /// The lines of the table so far.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// How the last check ended, once it has.
    #[must_use]
    pub fn ending(&self) -> Option<&Ending> {
        self.ending.as_ref()
    }

    /// Whether a check runs.
    #[must_use]
    pub fn is_running(&self) -> bool {
        self.worker.is_running()
    }

    /// Starts over; `wake` is called whenever there is news.
    pub fn start(&mut self, name: &str, doc: &SceneDoc, wake: impl Fn() + Send + Sync + 'static) {
        self.clear();
        let own = (self.subject == Subject::ThisScene).then(|| (name.to_owned(), doc.clone()));
        self.of = own.as_ref().map(|(_, doc)| doc.clone());
        self.worker.set_wake(wake);
        if let Err(error) = self.worker.submit(Order { own, deep: self.deep }) {
            self.ending = Some(Ending::Failed(format!("no thread could be started: {error}")));
        }
    }

    /// Shows it beside a scene: what was found of another, or of this one before an edit, is forgotten.
    pub fn show(&mut self, doc: &SceneDoc) {
        self.open = true;
        if self.of.as_ref().is_some_and(|of| work_after(of, doc) == Work::Render) {
            self.clear();
        }
    }

    /// Ends the check that runs; its rows stay.
    pub fn cancel(&mut self) {
        if self.worker.is_running() {
            self.worker.cancel();
            self.ending = Some(Ending::Cancelled);
        }
    }

    /// Forgets the last check: its rows would be read as those of what is chosen now.
    fn clear(&mut self) {
        self.cancel();
        (self.done, self.total) = (0, 0);
        self.at.clear();
        self.rows.clear();
        self.notes.clear();
        (self.of, self.ending) = (None, None);
    }

    /// Takes over what the worker has reported since the last call.
    pub fn poll(&mut self) {
        for news in self.worker.poll() {
            match news {
                News::At { done, total, what } => (self.done, self.total, self.at) = (done, total, what),
                News::Rows(rows) => self.rows.extend(rows),
                News::Notes(notes) => self.notes = notes,
                News::Ended(ending) => self.ending = Some(ending),
            }
        }
        if self.worker.has_failed() && self.ending.is_none() {
            self.ending = Some(Ending::Failed("it stopped on an internal error; run it again".into()));
        }
    }

    /// Rows in all, that agree, and that differ or are not finite.
    fn counts(&self) -> (usize, usize, usize) {
        let agree = self.rows.iter().filter(|row| row.verdict == Verdict::Agrees).count();
        let wrong = self.rows.iter().filter(|row| !row.passes()).count();
        (self.rows.len(), agree, wrong)
    }

    /// The table as comma-separated values.
    fn csv(&self) -> String {
        let mut text =
            "scene,estimator,mode,measured,error,expected,z,worst_z,critical_z,detectable,paths,verdict\n"
                .to_owned();
        for r in &self.rows {
            let mode = table::mode(r);
            text += &format!(
                "\"{}\",{},{mode},{},{},{},{},{},{},{},{},\"{}\"\n",
                r.scene.replace('"', "\"\""),
                r.estimator,
                r.measured,
                r.error,
                r.expected,
                r.z,
                r.worst_z,
                r.critical_z,
                r.detectable,
                r.paths,
                r.verdict
            );
        }
        text
    }
}

fn plan(own: Option<(String, SceneDoc)>, deep: bool) -> Result<Check, CheckError> {
    let Some((name, doc)) = own else {
        let effort = if deep { Effort::DEEP } else { Effort::QUICK };
        return Ok(Check { cases: check::built_in(deep)?, effort });
    };
    let case: Case = check::own_scene(name, &doc, Library::default());
    let effort = Effort::own_scenes(deep, case.estimators().len());
    Ok(Check { cases: vec![case], effort })
}

fn work(order: Order, reply: &Reply<'_, Order, News>) {
    let result = plan(order.own, order.deep).and_then(|check| {
        check.run(reply.cancel(), |p| {
            let what = format!("{}  ·  {}", p.scene, p.estimator);
            reply.send(News::At { done: p.done, total: p.total, what });
            if !p.rows.is_empty() {
                reply.send(News::Rows(p.rows.to_vec()));
            }
        })
    });
    reply.send(match result {
        Ok(Some(report)) => {
            reply.send(News::Notes(report.notes));
            News::Ended(Ending::Finished(report.seconds))
        }
        Ok(None) => News::Ended(Ending::Cancelled),
        Err(error) => News::Ended(Ending::Failed(error.to_string())),
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use majorant_core::estimator::REGISTRY;
    use std::time::Duration;

    fn finished(check: &mut SelfCheck) -> &Ending {
        while check.is_running() {
            std::thread::sleep(Duration::from_millis(2));
            check.poll();
        }
        check.ending().expect("it has ended")
    }

    fn scene(toml: &str) -> SceneDoc {
        majorant_core::io::scene_file::parse(toml, "test").expect("a scene")
    }

    #[test]
    fn a_scene_of_ones_own_ends_in_rows() {
        let mut check = SelfCheck { subject: Subject::ThisScene, ..SelfCheck::default() };
        let doc = scene(
            "majorant = 1\nmedium = { extinction = 1.0 }\nlights = [{ kind = \"environment\" }]\n\
             film = { width = 8, height = 8 }",
        );
        check.start("mine", &doc, || {});
        assert!(matches!(finished(&mut check), Ending::Finished(_)));
        let all = REGISTRY.len();
        assert_eq!(check.counts(), (all, all, 0));
        assert_eq!(check.csv().lines().count(), 1 + all);
        assert!(check.csv().contains("\"mine\",nee,spectral,"));
    }

    #[test]
    fn a_file_that_is_missing_becomes_a_message() {
        let mut check = SelfCheck { subject: Subject::ThisScene, ..SelfCheck::default() };
        let doc = scene("majorant = 1\n[medium]\ndensity = { kind = \"grid\", file = \"/none.vdb\" }");
        check.start("mine", &doc, || {});
        let Ending::Failed(message) = finished(&mut check) else { panic!("it should have failed") };
        assert!(message.contains("none.vdb"), "{message}");
    }

    #[test]
    fn cancelling_keeps_the_rows_and_ends_the_thread() {
        let mut check = SelfCheck { deep: true, ..SelfCheck::default() };
        check.start("", &SceneDoc::default(), || {});
        while check.rows().is_empty() {
            std::thread::sleep(Duration::from_millis(2));
            check.poll();
        }
        check.cancel();
        assert!(!check.is_running() && !check.rows().is_empty());
        assert_eq!(check.ending(), Some(&Ending::Cancelled));
    }
}
