//! Lesson file format: Markdown with a TOML header per step that lists its settings.
//!
//! ```text
//!   +++
//!   title = "Beer and Lambert"
//!   about = "One line for the list."
//!   +++ predict
//!   scene = "furnace"
//!   set = ["medium.extinction=2"]
//!   choices = ["half", "a quarter"]
//!   right = 1
//!   +++
//!   What will be left after another unit?
//!   +++ see
//!   …
//! ```
//!
//! TOML is enclosed by `+++ kind` and the next `+++`; the step's text follows, with TeX equations between
//! dollar signs.

use super::live;
use super::prose::damaged_equation;
use crate::wall::dock::TABS;
use majorant_core::io::{embedded, scene_file};
use majorant_core::scene::SceneDoc;
use majorant_core::transmittance::{Shape, TransmittanceKind};
use serde::Deserialize;

/// Purpose of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// The reader chooses an answer.
    Predict,
    /// The window shows the result.
    See,
    /// The text gives the reason.
    Explain,
}

impl Stage {
    /// Display name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Predict => "Predict",
            Self::See => "See",
            Self::Explain => "Explain",
        }
    }

    fn find(text: &str) -> Option<Self> {
        [Self::Predict, Self::See, Self::Explain].into_iter().find(|s| s.name().eq_ignore_ascii_case(text))
    }
}

/// Settings of the *Ray* tab.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RaySet {
    /// Name of an analytic shape; `None` for the ray of the picked pixel.
    pub through: Option<String>,
    /// Maximum extinction of the shape, per unit of length.
    pub extinction: Option<f32>,
    /// Number of cells of the shape's majorant.
    pub cells: Option<u32>,
    /// Majorant divided by the tight bound.
    pub factor: Option<f32>,
    /// Id of the transmittance estimator.
    pub kind: Option<String>,
}

/// Settings that a step applies to the window. Absent keys leave settings unchanged.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Stop {
    /// Name of an embedded scene; without it, a step continues from the scene of the previous step.
    pub scene: Option<String>,
    /// Assignments `key=value` of scene keys, as on the command line.
    pub set: Vec<String>,
    /// Number of views.
    pub views: Option<usize>,
    /// Id of the tab below the images; `none` closes the tabs.
    pub tab: Option<String>,
    /// Picked pixel, column and row.
    pub pick: Option<[usize; 2]>,
    /// Settings of the *Ray* tab.
    pub ray: Option<RaySet>,
    /// Answers to choose from.
    pub choices: Vec<String>,
    /// Index of the correct answer, from 0.
    pub right: usize,
}

/// One step of a lesson.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Purpose.
    pub stage: Stage,
    /// Settings.
    pub stop: Stop,
    /// Text, in Markdown.
    pub text: String,
}

/// A parsed lesson.
#[derive(Clone, Debug, PartialEq)]
pub struct Lesson {
    /// File name without extension.
    pub id: String,
    /// Title.
    pub title: String,
    /// One-line summary for the list of lessons.
    pub about: String,
    /// Steps, at least one.
    pub steps: Vec<Step>,
}

/// Error of a lesson file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{file}, line {line}: {reason}")]
pub struct LessonError {
    /// File name.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Problem and remedy.
    pub reason: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Head {
    title: String,
    #[serde(default)]
    about: String,
}

/// A header and the text that follows it.
struct Part<'a> {
    line: usize,
    kind: &'a str,
    toml: String,
    text: String,
}

fn parts(source: &str) -> Vec<Part<'_>> {
    let mut parts: Vec<Part<'_>> = Vec::new();
    let mut in_header = false;
    for (number, line) in source.lines().enumerate() {
        match line.strip_prefix("+++") {
            // A header ends at the next `+++` without a kind.
            Some(rest) if in_header && rest.trim().is_empty() => in_header = false,
            Some(rest) => {
                in_header = true;
                parts.push(Part {
                    line: number + 1,
                    kind: rest.trim(),
                    toml: String::new(),
                    text: String::new(),
                });
            }
            None => {
                if let Some(part) = parts.last_mut() {
                    let to = if in_header { &mut part.toml } else { &mut part.text };
                    to.push_str(line);
                    to.push('\n');
                }
            }
        }
    }
    parts
}

impl Lesson {
    /// Parses a lesson; `id` is its file name without extension.
    ///
    /// # Errors
    /// A malformed header, an unknown scene, tab, shape, estimator or number, invalid TeX, or no step.
    pub fn parse(id: &str, source: &str) -> Result<Self, LessonError> {
        let error = |line: usize, reason: String| LessonError { file: format!("{id}.md"), line, reason };
        let parts = parts(source);
        let mut parts = parts.iter();
        let head = parts.next().filter(|part| part.kind.is_empty());
        let head = head.ok_or_else(|| error(1, "a lesson begins with +++, a title and +++".into()))?;
        let Head { title, about } =
            toml::from_str(&head.toml).map_err(|e| error(head.line, e.message().into()))?;
        let mut steps = Vec::new();
        for part in parts {
            let stage = Stage::find(part.kind).ok_or_else(|| {
                error(part.line, format!("`{}` is no kind of step: use predict, see or explain", part.kind))
            })?;
            let stop: Stop = toml::from_str(&part.toml).map_err(|e| error(part.line, e.message().into()))?;
            if !stop.choices.is_empty() && stop.right >= stop.choices.len() {
                return Err(error(
                    part.line,
                    "`right` counts from 0, and must be the index of a choice".into(),
                ));
            }
            stop.check().map_err(|reason| error(part.line, reason))?;
            if let Some(name) = live::names(&part.text).find(|name| !live::NAMES.contains(name)) {
                return Err(error(part.line, format!("`{name}` is no number: {}", live::NAMES.join(", "))));
            }
            if let Some(reason) = damaged_equation(&part.text) {
                return Err(error(part.line, reason));
            }
            steps.push(Step { stage, stop, text: part.text.trim().to_owned() });
        }
        if steps.is_empty() {
            return Err(error(1, "the lesson has no step: begin one with +++ see".into()));
        }
        let lesson = Self { id: id.to_owned(), title, about, steps };
        // Scenes are validated here, so that no step of an open lesson can fail.
        let mut doc = SceneDoc::default();
        for (i, step) in lesson.steps.iter().enumerate() {
            doc = step.stop.scene(&doc).map_err(|reason| error(1, format!("step {}: {reason}", i + 1)))?;
        }
        Ok(lesson)
    }

    /// Returns the settings of a step, with those left unset inherited from earlier steps.
    #[must_use]
    pub fn stop_at(&self, step: usize) -> Option<Stop> {
        let steps = self.steps.get(..=step)?;
        Some(steps.iter().fold(Stop::default(), |stop, step| stop.then(&step.stop)))
    }

    /// Returns the scene of a step, with the edits of all steps up to it applied.
    #[must_use]
    pub fn scene_at(&self, step: usize) -> Option<SceneDoc> {
        let mut doc = SceneDoc::default();
        for step in self.steps.get(..=step)? {
            doc = step.stop.scene(&doc).ok()?;
        }
        Some(doc)
    }
}

impl Stop {
    /// Combines the settings of two successive steps, except those of the scene.
    fn then(self, next: &Self) -> Self {
        let or = |before: Option<String>, after: &Option<String>| after.clone().or(before);
        let ray = match (self.ray, &next.ray) {
            (Some(before), Some(after)) => Some(RaySet {
                through: or(before.through, &after.through),
                extinction: after.extinction.or(before.extinction),
                cells: after.cells.or(before.cells),
                factor: after.factor.or(before.factor),
                kind: or(before.kind, &after.kind),
            }),
            (before, after) => after.clone().or(before),
        };
        Self { tab: or(self.tab, &next.tab), pick: next.pick.or(self.pick), ray, ..next.clone() }
    }

    /// Checks that the named tab, shape and estimator exist.
    fn check(&self) -> Result<(), String> {
        let known = |what: &str, name: &Option<String>, all: Vec<&str>| match name {
            Some(name) if !all.contains(&name.as_str()) => {
                Err(format!("`{name}` is no {what}: {}", all.join(", ")))
            }
            _ => Ok(()),
        };
        known("tab", &self.tab, TABS.iter().map(|tab| tab.id()).chain(["none"]).collect())?;
        let ray = self.ray.clone().unwrap_or_default();
        known("shape", &ray.through, Shape::ALL.iter().map(|shape| shape.name()).collect())?;
        let kinds = TransmittanceKind::all();
        known("estimator of transmittance", &ray.kind, kinds.iter().map(|kind| kind.entry().id).collect())
    }

    /// Applies the step's edits to the scene of the previous step.
    fn scene(&self, before: &SceneDoc) -> Result<SceneDoc, String> {
        let mut doc = match &self.scene {
            None => before.clone(),
            Some(name) => {
                let scene =
                    embedded::find(name).ok_or_else(|| format!("there is no embedded scene `{name}`"))?;
                scene_file::parse(scene.toml, scene.name).map_err(|e| e.to_string())?
            }
        };
        if let Some(views) = self.views {
            doc = crate::model::edited(&doc, &crate::model::WallEdit::Count(views));
        }
        let doc = scene_file::override_keys(&doc, &self.set).map_err(|e| e.to_string())?;
        match majorant_core::estimator::validate(&doc).first() {
            Some(problem) => Err(problem.to_string()),
            None => Ok(doc),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TWO: &str = "+++\ntitle = \"T\"\n+++ predict\nscene = \"furnace\"\nchoices = [\"a\", \"b\"]\nright = 1\n+++\nHow much?\n+++ see\nset = [\"medium.albedo=0.5\"]\n+++\nThis.\n";

    #[test]
    fn steps_are_read_and_scenes_add_up() {
        let lesson = Lesson::parse("two", TWO).unwrap();
        assert_eq!((lesson.title.as_str(), lesson.steps.len()), ("T", 2));
        assert_eq!((lesson.steps[0].stage, lesson.steps[1].text.as_str()), (Stage::Predict, "This."));
        let [first, second] = [0, 1].map(|i| lesson.scene_at(i).unwrap());
        assert!(first.title == second.title && first.medium().albedo != second.medium().albedo);
        assert!(lesson.scene_at(2).is_none());
    }

    #[test]
    fn unset_settings_are_inherited_from_earlier_steps() {
        let first = "right = 1\ntab = \"ray\"\nray = { cells = 4, kind = \"ratio\" }";
        let text = TWO.replace("right = 1", first).replace("set =", "ray = { cells = 8 }\nset =");
        let stop = Lesson::parse("two", &text).unwrap().stop_at(1).unwrap();
        let ray = stop.ray.unwrap();
        assert_eq!(
            (stop.tab.as_deref(), ray.cells, ray.kind.as_deref()),
            (Some("ray"), Some(8), Some("ratio"))
        );
        assert!(stop.choices.is_empty(), "choices are not inherited");
    }

    #[test]
    fn errors_name_line_and_problem() {
        let said = |source: &str| Lesson::parse("x", source).unwrap_err().to_string();
        assert!(said("hello").contains("begins with +++"));
        assert!(said("+++\ntitle = \"T\"\n+++").contains("no step"));
        assert!(said(&TWO.replace("+++ see", "+++ look")).contains("line 9: `look` is no kind"));
        assert!(said(&TWO.replace("right = 1", "right = 2")).contains("counts from 0"));
        assert!(said(&TWO.replace("furnace", "moon")).contains("step 1: there is no embedded scene `moon`"));
        assert!(said(&TWO.replace("albedo=0.5", "albedo=7")).contains("step 2"));
        assert!(said(&TWO.replace("This.", "{{luck}}")).contains("`luck` is no number"));
        assert!(said(&TWO.replace("right = 1", "right = 1\ntab = \"moon\"")).contains("`moon` is no tab"));
        assert!(said(&TWO.replace("This.", "$\\nosuch{1}$")).contains("line 9: the equation"));
        assert!(said(&TWO.replace("choices", "options")).contains("options"));
    }
}
