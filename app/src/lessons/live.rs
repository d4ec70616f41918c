//! Measured numbers in lesson text: `{{name}}` is replaced by the current value of a measurement.

use crate::wall::inspector::Inspector;
use crate::wall::{Wall, dock};
use majorant_core::compare::Verdict;

/// Names of the numbers.
pub const NAMES: &[&str] = &[
    "ray.truth",
    "ray.mean",
    "ray.error",
    "ray.lookups",
    "ray.spread",
    "A.lost",
    "B.lost",
    "A.lookups",
    "B.lookups",
    "A.speedup",
    "B.speedup",
    "A.verdict",
    "B.verdict",
    "A.variance over B.variance",
    "B.variance over A.variance",
];

/// Iterates over the names that a text uses.
pub fn names(text: &str) -> impl Iterator<Item = &str> {
    text.split("{{").skip(1).filter_map(|rest| rest.split_once("}}").map(|(name, _)| name.trim()))
}

/// Sources of the numbers.
pub struct Live<'a> {
    /// Views and their statistics.
    pub wall: &'a Wall,
    /// Measurements of rays and paths.
    pub inspector: &'a Inspector,
}

impl Live<'_> {
    /// Substitutes the numbers of a text; a number that is not measured yet becomes an ellipsis.
    #[must_use]
    pub fn fill(&self, text: &str) -> String {
        let mut filled = String::with_capacity(text.len());
        let mut rest = text;
        while let Some((before, after)) = rest.split_once("{{") {
            filled.push_str(before);
            let Some((name, after)) = after.split_once("}}") else {
                rest = after;
                break;
            };
            filled.push_str(&self.value(name.trim()).unwrap_or_else(|| "…".into()));
            rest = after;
        }
        filled.push_str(rest);
        filled
    }

    fn value(&self, name: &str) -> Option<String> {
        if let Some(name) = name.strip_prefix("ray.") {
            let ray = &self.inspector.ray;
            let bench = ray.query.answer_to(&dock::ray::question(self.wall, ray)?)?;
            let spread = || {
                let n = bench.estimates.len() as f64;
                bench.mean[1] * n.sqrt()
            };
            return Some(match name {
                "truth" => format!("{:.4}", bench.truth()),
                "mean" => format!("{:.4}", bench.mean[0]),
                "error" => format!("{:.4}", bench.mean[1]),
                "lookups" => format!("{:.2}", bench.lookups),
                _ => format!("{:.3}", spread()),
            });
        }
        if let Some((a, b)) = name.split_once(" over ") {
            let variance = |name: &str| Some(self.standing(name.split('.').next()?)?.variance);
            let ratio = variance(a)? / variance(b)?;
            return ratio.is_finite().then(|| format!("{ratio:.2}"));
        }
        let (view, what) = name.split_once('.')?;
        if what == "lost" {
            let which = usize::from(view == "B");
            let snapshot = self.wall.slots().get(which)?.picture()?;
            return Some(snapshot.tally.non_finite.to_string());
        }
        let standing = self.standing(view)?;
        Some(match what {
            "lookups" => format!("{:.2}", standing.lookups_per_path),
            "speedup" => format!("{:.2}", standing.speedup),
            _ => match standing.agreement.as_ref()?.verdict {
                Verdict::Agrees => "agrees".into(),
                Verdict::Differs => "differs".into(),
                Verdict::Undecided => "is too noisy to tell".into(),
            },
        })
    }

    fn standing(&self, label: &str) -> Option<&majorant_core::compare::Standing> {
        self.wall.analysis().standing(label)
    }
}
