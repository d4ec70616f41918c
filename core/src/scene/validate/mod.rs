//! Validation of documents: problems name the key, the value and the remedy.

mod compare;
mod medium;
mod object;

use super::{LightDoc, SceneDoc, keys};
use glam::Vec3;
use std::fmt;

/// An invalid value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Key in the document, e.g. `medium.albedo` or `lights[1].size`.
    pub path: String,
    /// Description of the problem and its remedy.
    pub message: String,
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}: {}", self.path, self.message)
    }
}

/// Maximum number of pixels of a film: 8K. Film, snapshot and preview take about 120 bytes per pixel, 4 GB in
/// total.
pub(super) const MAX_PIXELS: u64 = 7680 * 4320;

#[derive(Default)]
struct Checker {
    problems: Vec<Problem>,
}

impl Checker {
    fn check(&mut self, good: bool, path: impl Into<String>, message: impl Into<String>) {
        if !good {
            self.problems.push(Problem { path: path.into(), message: message.into() });
        }
    }

    /// Requires that two points do not coincide.
    fn apart(&mut self, path: &str, a: [f32; 3], b: [f32; 3]) {
        let distance = Vec3::from(a).distance(Vec3::from(b));
        let scale = Vec3::from(a).abs().max_element();
        self.check(
            distance > 1e-6 * scale && distance > 1e-9,
            path,
            "coincides with the position, which leaves the direction undefined: move one of the two",
        );
    }
}

/// Returns all problems of a document, in the order of its keys, except for unknown estimators (see
/// [`crate::estimator::validate`]).
#[must_use]
pub fn validate(doc: &SceneDoc) -> Vec<Problem> {
    let mut c = Checker { problems: scene_problems(doc) };
    compare::compare(&mut c, doc);
    c.problems
}

/// Problems of the scene without its further views: values out of the ranges of their keys, and invalid
/// combinations.
fn scene_problems(doc: &SceneDoc) -> Vec<Problem> {
    let mut c = Checker { problems: keys::check(doc) };
    let (width, height) = (doc.film.width, doc.film.height);
    c.check(
        u64::from(width) * u64::from(height) <= MAX_PIXELS,
        "film",
        format!("{width} × {height} pixels exceed the maximum of {} million", MAX_PIXELS / 1_000_000),
    );
    c.apart("camera.target", doc.camera.target, doc.camera.origin);
    medium::media(&mut c, doc);
    for (i, light) in doc.lights.iter().enumerate() {
        match light {
            LightDoc::Rectangle { center, target, .. } => {
                c.apart(&format!("lights[{i}].target"), *target, *center);
            }
            LightDoc::EnvironmentMap { file, .. } => {
                let path = format!("lights[{i}].file");
                c.check(!file.is_empty(), path, "names no image: choose an EXR or HDR file");
            }
            LightDoc::Sphere { .. } | LightDoc::Sun { .. } | LightDoc::Environment { .. } => {}
        }
    }
    object::objects(&mut c, doc);
    c.problems
}
