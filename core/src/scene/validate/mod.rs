//! Refuses documents that make no sense, naming the key, the value and the cure.

mod compare;
mod medium;

use super::{LightDoc, Limits, ObjectDoc, SceneDoc};
use crate::spectrum::SpectrumDoc;
use glam::Vec3;
use std::fmt;

/// A value that makes no sense.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// The key in the document, e.g. `medium.albedo` or `lights[1].size`.
    pub path: String,
    /// What is wrong, and the cure.
    pub message: String,
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}: {}", self.path, self.message)
    }
}

/// The most pixels of a film: 8K. Film, snapshot and preview take about 120 bytes a pixel, 4 GB in all.
const MAX_PIXELS: u64 = 7680 * 4320;

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

    /// Coordinates and angles: finite, and small enough that distances between them are.
    fn finite(&mut self, path: impl Into<String>, values: &[f32]) {
        let good = values.iter().all(|v| v.abs() <= 1e9);
        self.check(good, path, "holds a number that is not finite, or beyond a billion");
    }

    /// Two points that must not coincide.
    fn apart(&mut self, path: &str, a: [f32; 3], b: [f32; 3]) {
        let distance = Vec3::from(a).distance(Vec3::from(b));
        let scale = Vec3::from(a).abs().max_element();
        self.check(
            distance > 1e-6 * scale && distance > 1e-9,
            path,
            "is where the thing itself stands: it has no direction to face; move one of the two",
        );
    }

    fn lengths(&mut self, path: impl Into<String>, values: &[f32]) {
        let good = values.iter().all(|v| *v > 0.0 && *v <= 1e9);
        self.check(good, path, "must be positive, and at most a billion");
    }

    fn range(&mut self, path: impl Into<String>, value: f32, lo: f32, hi: f32) {
        let message = format!("is {value}, outside {lo} to {hi}");
        self.check((lo..=hi).contains(&value), path, message);
    }

    fn spectrum(&mut self, path: &str, doc: &SpectrumDoc, max: f32) {
        for value in doc.values() {
            let message = format!("holds {value}; values from 0 to {max} make sense here");
            self.check((0.0..=max).contains(&value), path, message);
        }
        for point in doc.control_points().unwrap_or_default().0 {
            let message = format!(
                "has a control point at {}; wavelengths are in nanometres, 360 to 830 is visible",
                point.lambda_nm
            );
            self.check((100.0..=10_000.0).contains(&point.lambda_nm), path, message);
        }
    }

    fn direction(&mut self, path: &str, v: [f32; 3]) {
        let length = Vec3::from(v).length();
        self.check(length.is_finite() && length > 1e-9, path, format!("is {v:?}, which has no direction"));
    }
}

/// Every problem of a document, in the order of its keys; whether the estimator exists is
/// [`crate::estimator::validate`]'s to say.
#[must_use]
pub fn validate(doc: &SceneDoc) -> Vec<Problem> {
    let mut c = Checker { problems: scene_problems(doc) };
    compare::compare(&mut c, doc);
    c.problems
}

/// Every problem of the scene as its own view sees it.
fn scene_problems(doc: &SceneDoc) -> Vec<Problem> {
    let mut c = Checker::default();
    let pixels = u64::from(doc.film.width) * u64::from(doc.film.height);
    for (key, side) in [("film.width", doc.film.width), ("film.height", doc.film.height)] {
        c.check(side > 0, key, "is 0: an image needs at least one pixel");
    }
    c.check(
        pixels <= MAX_PIXELS,
        "film",
        format!(
            "{} × {} pixels are too many: at most {} million fit",
            doc.film.width,
            doc.film.height,
            MAX_PIXELS / 1_000_000
        ),
    );
    let camera = &doc.camera;
    c.finite("camera.origin", &camera.origin);
    c.finite("camera.target", &camera.target);
    c.apart("camera.target", camera.target, camera.origin);
    c.direction("camera.up", camera.up);
    c.check(
        camera.fov_deg > 0.0 && camera.fov_deg < 179.0,
        "camera.fov_deg",
        format!("is {}; a field of view lies between 0 and 179 degrees", camera.fov_deg),
    );
    medium::medium(&mut c, &doc.medium);
    for (i, light) in doc.lights.iter().enumerate() {
        check_light(&mut c, &format!("lights[{i}]"), light);
    }
    for (i, object) in doc.objects.iter().enumerate() {
        check_object(&mut c, &format!("objects[{i}]"), object);
    }
    c.check(
        doc.estimator.max_depth != Some(0),
        "estimator.max_depth",
        "is 0; 1 is emission only, 2 single scattering; leave it out for no limit",
    );
    c.check(
        i64::try_from(doc.render.seed).is_ok(),
        "render.seed",
        "is above 2^63 − 1, the largest number that a scene file holds",
    );
    c.check(doc.render.spp != Some(0), "render.spp", "is 0: leave it out for no limit");
    c.check(
        doc.render.spp.is_none_or(|spp| spp <= Limits::MOST_SAMPLES),
        "render.spp",
        "is above 2^63 − 1: leave it out for no limit",
    );
    c.check(
        doc.render.seconds.is_none_or(|s| s > 0.0 && s.is_finite()),
        "render.seconds",
        "must be positive: leave it out for no limit",
    );
    c.check(
        doc.render.cpu_seconds.is_none_or(|s| s > 0.0 && s.is_finite()),
        "render.cpu_seconds",
        "must be positive: leave it out for no limit",
    );
    c.check(
        doc.render.relative_error.is_none_or(|e| e > 0.0 && e.is_finite()),
        "render.relative_error",
        "must be positive: 0.01 is one percent of the mean; leave it out for no limit",
    );
    c.check(
        doc.render.threads.is_none_or(|t| (1..=1024).contains(&t)),
        "render.threads",
        "must lie between 1 and 1024: leave it out for one per core",
    );
    c.range("view.exposure_ev", doc.view.exposure_ev, -64.0, 64.0);
    c.check(
        doc.view.gamma.is_none_or(|g| (0.1..=10.0).contains(&g)),
        "view.gamma",
        "lies between 0.1 and 10: leave it out for the sRGB curve",
    );
    c.problems
}

fn check_light(c: &mut Checker, path: &str, doc: &LightDoc) {
    let key = |name: &str| format!("{path}.{name}");
    let scale = match doc {
        LightDoc::Rectangle { center, target, up, size, radiance, scale, .. } => {
            c.finite(key("center"), center);
            c.finite(key("target"), target);
            c.apart(&key("target"), *target, *center);
            c.direction(&key("up"), *up);
            c.lengths(key("size"), size);
            c.spectrum(&key("radiance"), radiance, 1e9);
            scale
        }
        LightDoc::Sphere { center, radius, radiance, scale, .. } => {
            c.finite(key("center"), center);
            c.lengths(key("radius"), &[*radius]);
            c.spectrum(&key("radiance"), radiance, 1e9);
            scale
        }
        LightDoc::Sun { toward, angular_diameter_deg, irradiance, scale, .. } => {
            c.direction(&key("toward"), *toward);
            c.check(
                (0.05..=170.0).contains(angular_diameter_deg),
                key("angular_diameter_deg"),
                format!("is {angular_diameter_deg}; from 0.05 to 170 degrees a scattered path can meet it"),
            );
            c.spectrum(&key("irradiance"), irradiance, 1e9);
            scale
        }
        LightDoc::Environment { radiance, scale, .. } => {
            c.spectrum(&key("radiance"), radiance, 1e9);
            scale
        }
        LightDoc::EnvironmentMap { file, rotate_deg, scale, .. } => {
            c.finite(key("rotate_deg"), &[*rotate_deg]);
            c.check(!file.is_empty(), key("file"), "names no picture: choose an EXR or HDR file");
            scale
        }
    };
    c.range(key("scale"), *scale, 0.0, 1e9);
}

fn check_object(c: &mut Checker, path: &str, doc: &ObjectDoc) {
    let key = |name: &str| format!("{path}.{name}");
    let albedo = match doc {
        ObjectDoc::Ground { point, normal, albedo } => {
            c.finite(key("point"), point);
            c.direction(&key("normal"), *normal);
            albedo
        }
        ObjectDoc::Box { center, size, rotate_deg, albedo } => {
            c.finite(key("center"), center);
            c.finite(key("rotate_deg"), rotate_deg);
            c.lengths(key("size"), size);
            albedo
        }
    };
    c.spectrum(&key("albedo"), albedo, 1.0);
}
