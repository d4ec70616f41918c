//! *Help ▸ Self-check*: the check of `majorant check`, in the window.
//!
//! `mod.rs` contains its state, worker thread and results, `dialog.rs` the dialog, and `table.rs` the table.

mod dialog;
mod table;

pub(super) use dialog::self_check_ui;

use crate::background::{Background, Reply};
use crate::model::{Work, work_after};
use majorant_core::check::{self, Case, Check, CheckError, Effort, Row, Verdict};
use majorant_core::io::Library;
use majorant_core::scene::SceneDoc;

/// Subject of a check.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Subject {
    /// The built-in cases.
    #[default]
    BuiltIn,
    /// The scene that is being edited.
    ThisScene,
}

/// End of a check.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// Completed, after this many seconds.
    Finished(f64),
    /// Cancelled by the user.
    Cancelled,
    /// Failed with this error message.
    Failed(String),
}

/// Subject of a check: the user's scene with its name, or the built-in cases; `deep` for the long version.
struct Order {
    own: Option<(String, SceneDoc)>,
    deep: bool,
}

/// Report of the worker.
enum News {
    At { done: usize, total: usize, what: String },
    Rows(Vec<Row>),
    Notes(Vec<String>),
    Ended(Ending),
}

/// State of the self-check dialog.
pub struct SelfCheck {
    /// Whether the dialog is shown.
    pub open: bool,
    subject: Subject,
    /// Scene of the rows, if the user's scene was checked.
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
    /// Rows of the table so far.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// End of the last check, once it has ended.
    #[must_use]
    pub fn ending(&self) -> Option<&Ending> {
        self.ending.as_ref()
    }

    /// Whether a check is running.
    #[must_use]
    pub fn is_running(&self) -> bool {
        self.worker.is_running()
    }

    /// Starts a new check; `wake` is called after every report of the worker.
    pub fn start(&mut self, name: &str, doc: &SceneDoc, wake: impl Fn() + Send + Sync + 'static) {
        self.clear();
        let own = (self.subject == Subject::ThisScene).then(|| (name.to_owned(), doc.clone()));
        self.of = own.as_ref().map(|(_, doc)| doc.clone());
        self.worker.set_wake(wake);
        if let Err(error) = self.worker.submit(Order { own, deep: self.deep }) {
            self.ending = Some(Ending::Failed(format!("no thread could be started: {error}")));
        }
    }

    /// Opens the dialog for a scene; results for a different scene, or for this one before an edit, are
    /// discarded.
    pub fn show(&mut self, doc: &SceneDoc) {
        self.open = true;
        if self.of.as_ref().is_some_and(|of| work_after(of, doc) == Work::Render) {
            self.clear();
        }
    }

    /// Cancels a running check and keeps its rows.
    pub fn cancel(&mut self) {
        if self.worker.is_running() {
            self.worker.cancel();
            self.ending = Some(Ending::Cancelled);
        }
    }

    /// Discards the last check, whose rows would be taken for those of the current choice.
    fn clear(&mut self) {
        self.cancel();
        (self.done, self.total) = (0, 0);
        self.at.clear();
        self.rows.clear();
        self.notes.clear();
        (self.of, self.ending) = (None, None);
    }

    /// Takes over the reports of the worker since the last call.
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
            self.ending =
                Some(Ending::Failed("the check stopped with an internal error; run it again".into()));
        }
    }

    /// Number of all rows, of those that agree, and of those that differ or are not finite.
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
        check.ending().expect("the check has ended")
    }

    fn scene(toml: &str) -> SceneDoc {
        majorant_core::io::scene_file::parse(toml, "test").expect("a scene")
    }

    #[test]
    fn a_user_scene_ends_in_rows() {
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
        let Ending::Failed(message) = finished(&mut check) else { panic!("the check should have failed") };
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
