//! Table of keys: one row per key of a scene file.
//!
//! ```text
//!   camera, medium, phase, lights, objects, estimator, render, compare, window
//!     ──► all() ──► validation, panels, `majorant keys`, parts of documents, fingerprints, unbiased()
//! ```
//!
//! A row holds the range of valid values, the meaning, what the key affects and when it biases the estimate.
//! A new key is a field of a document and a row here; tests compare the two.

mod biases;
mod camera;
mod check;
mod compare;
mod estimator;
mod lights;
mod medium;
mod objects;
mod part;
mod phase;
mod render;
#[cfg(test)]
mod tests;
mod text;
mod window;

pub use biases::Bias;
pub use part::{Leaf, changed, leaves};
pub use phase::key_of as phase_key;
pub use text::{json, markdown, value_in_words};

pub(super) use check::check;

use crate::transmittance::TransmittanceKind;
use std::sync::OnceLock;

/// One key of a scene file.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// Path, e.g. `medium.majorant.factor`; `*` stands for an index into a list.
    pub path: &'static str,
    /// Kinds of the enclosing table that have the key; empty: all.
    pub kinds: &'static [&'static str],
    /// Type and range of the value.
    pub value: Type,
    /// Unit; empty: none.
    pub unit: &'static str,
    /// Meaning of an absent key.
    pub default: Default,
    /// Label in panels.
    pub label: &'static str,
    /// Meaning, preferably with the equation in which the value occurs.
    pub tip: &'static str,
    /// What the key affects.
    pub affects: Affects,
    /// Rule by which it biases the estimate; `None`: never.
    pub biases: Option<&'static Bias>,
    /// Remedy at the end of the message about a value out of range.
    pub cure: &'static str,
}

/// What a key affects.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Affects {
    /// The expected image, to which unbiased estimators converge.
    Scene,
    /// The estimate of that image: noise, cost, random numbers.
    Estimate,
    /// Stopping limits and number of threads; no sample.
    Limits,
    /// Display and reference; no sample.
    View,
}

impl Affects {
    /// Name in listings.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Scene => "scene",
            Self::Estimate => "estimate",
            Self::Limits => "limits",
            Self::View => "view",
        }
    }
}

/// Meaning of an absent key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Default {
    /// A default value, as written in a scene file.
    Is(&'static str),
    /// No value, with a description of what that means.
    Absent(&'static str),
    /// The key is required.
    Required,
}

/// Type and range of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Type {
    /// `true` or `false`.
    Bool,
    /// A real number.
    Number(Range),
    /// An integer.
    Integer(Range),
    /// An integer, or a keyword.
    IntegerOr(Range, &'static str),
    /// A number of real numbers.
    Vector(usize, Range),
    /// A number of integers.
    Integers(usize, Range),
    /// Three numbers, not all zero.
    Direction,
    /// Three rows of four numbers.
    Matrix(Range),
    /// Pairs of numbers.
    Pairs,
    /// A spectrum with values in this range.
    Spectrum(Range),
    /// One of a list of words.
    Choice(&'static [&'static str]),
    /// An id in a registry.
    Id(Registry),
    /// A file name, relative to the scene file.
    File,
    /// Any text.
    Text,
}

/// Registry in which an id is looked up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Registry {
    /// Estimators, as listed by `majorant estimators`.
    Estimators,
    /// Transmittance estimators ([`TransmittanceKind`]).
    Transmittance,
    /// Error measures.
    Measures,
}

/// Range of valid numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Minimum.
    pub min: f64,
    /// Maximum.
    pub max: f64,
    /// Whether the lower and the upper end are excluded.
    pub open: [bool; 2],
}

impl Range {
    /// A range including both ends.
    #[must_use]
    pub const fn closed(min: f64, max: f64) -> Self {
        Self { min, max, open: [false; 2] }
    }

    /// A range excluding its lower end.
    #[must_use]
    pub const fn above(min: f64, max: f64) -> Self {
        Self { min, max, open: [true, false] }
    }

    /// A range excluding both ends.
    #[must_use]
    pub const fn between(min: f64, max: f64) -> Self {
        Self { min, max, open: [true; 2] }
    }

    /// Returns whether a single-precision number is in the range; the ends are rounded to single precision.
    #[must_use]
    pub fn holds(&self, value: f32) -> bool {
        let [low, high] = [self.min as f32, self.max as f32];
        let above = if self.open[0] { value > low } else { value >= low };
        above && if self.open[1] { value < high } else { value <= high }
    }

    /// Returns whether an integer is in the range.
    #[must_use]
    pub fn holds_integer(&self, value: i64) -> bool {
        (self.min..=self.max).contains(&(value as f64))
    }

    /// The range with both ends included, for sliders: an open end is moved inwards by a millionth of its
    /// magnitude, which single precision can resolve.
    #[must_use]
    pub fn inner(&self) -> std::ops::RangeInclusive<f64> {
        let low = 1e-6 * self.min.abs().max(self.max.abs().min(1.0));
        let high = 1e-6 * self.max.abs();
        let [low, high] =
            [(self.open[0], low), (self.open[1], high)].map(|(open, by)| if open { by } else { 0.0 });
        self.min + low..=self.max - high
    }
}

/// Coordinates and angles: small enough that distances between them are finite.
const COORDINATE: Range = Range::closed(-1e9, 1e9);
/// Components of directions: small enough that their squares are finite.
const DIRECTION: Range = Range::closed(-1e18, 1e18);
/// Lengths, scene units.
const LENGTH: Range = Range::above(0.0, 1e9);
/// Fractions.
const SHARE: Range = Range::closed(0.0, 1.0);
/// Limits, which have to be positive.
const POSITIVE: Range = Range::above(0.0, f32::MAX as f64);
/// Numbers of samples, up to the largest integer of a scene file.
const SAMPLES: Range = Range::closed(1.0, i64::MAX as f64);
/// Random seeds, up to the largest integer of a scene file.
const SEEDS: Range = Range::closed(0.0, i64::MAX as f64);

impl Key {
    /// Creates a key that affects the expected image, for all kinds, without a unit.
    const fn new(
        path: &'static str,
        value: Type,
        default: Default,
        label: &'static str,
        tip: &'static str,
    ) -> Self {
        let affects = Affects::Scene;
        Self { path, kinds: &[], value, unit: "", default, label, tip, affects, biases: None, cure: "" }
    }

    const fn kinds(self, kinds: &'static [&'static str]) -> Self {
        Self { kinds, ..self }
    }

    const fn unit(self, unit: &'static str) -> Self {
        Self { unit, ..self }
    }

    const fn affects(self, affects: Affects) -> Self {
        Self { affects, ..self }
    }

    const fn biases(self, bias: &'static Bias) -> Self {
        Self { biases: Some(bias), ..self }
    }

    const fn cure(self, cure: &'static str) -> Self {
        Self { cure, ..self }
    }

    /// Returns whether the frozen scene is built from the key.
    #[must_use]
    pub fn is_frozen(&self) -> bool {
        let section = self.path.split('.').next().unwrap_or_default();
        ["camera", "film", "medium", "lights", "objects"].contains(&section)
    }

    /// Valid values of a choice or of a registry known to this module; empty otherwise.
    #[must_use]
    pub fn values(&self) -> Vec<&'static str> {
        match self.value {
            Type::Choice(values) => values.to_vec(),
            Type::Id(Registry::Transmittance) => {
                TransmittanceKind::all().iter().map(|kind| kind.entry().id).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Range of the numbers, if the value has any.
    #[must_use]
    pub fn range(&self) -> Option<Range> {
        match self.value {
            Type::Number(range)
            | Type::Integer(range)
            | Type::IntegerOr(range, _)
            | Type::Vector(_, range)
            | Type::Integers(_, range)
            | Type::Matrix(range)
            | Type::Spectrum(range) => Some(range),
            Type::Direction => Some(DIRECTION),
            Type::Bool | Type::Pairs | Type::Choice(_) | Type::Id(_) | Type::File | Type::Text => None,
        }
    }

    /// Default as written in a scene file.
    #[must_use]
    pub fn written_default(&self) -> Option<toml::Value> {
        let Default::Is(text) = self.default else { return None };
        toml::from_str::<toml::Table>(&format!("v = {text}")).ok()?.remove("v")
    }

    /// Default as stored in a document: rounded to single precision.
    #[must_use]
    pub fn default_value(&self) -> Option<toml::Value> {
        self.written_default().map(rounded)
    }

    /// Returns whether tables of this kind have the key.
    fn is_of(&self, kind: Option<&str>) -> bool {
        self.kinds.is_empty() || kind.is_some_and(|kind| self.kinds.contains(&kind))
    }
}

/// Rounds all numbers of a value to single precision.
fn rounded(value: toml::Value) -> toml::Value {
    match value {
        toml::Value::Float(x) => toml::Value::Float(f64::from(x as f32)),
        toml::Value::Array(entries) => toml::Value::Array(entries.into_iter().map(rounded).collect()),
        other => other,
    }
}

/// All keys, in the order of a scene file.
#[must_use]
pub fn all() -> &'static [Key] {
    static ALL: OnceLock<Vec<Key>> = OnceLock::new();
    ALL.get_or_init(|| {
        let own = [camera::KEYS, medium::KEYS].concat();
        let mut all =
            [own, phase::keys(), [lights::KEYS, objects::KEYS, estimator::KEYS, render::KEYS].concat()]
                .concat();
        all.extend(compare::KEYS);
        all.extend(compare::of_views(&all));
        all.extend(window::KEYS);
        all
    })
}

/// Returns the key at a path, for a kind of its table where that matters.
#[must_use]
pub fn find(path: &str, kind: Option<&str>) -> Option<&'static Key> {
    all().iter().find(|key| key.path == path && (kind.is_none() || key.is_of(kind)))
}

/// Leaks a derived path to give it a static lifetime; the table is built only once.
fn named(path: String) -> &'static str {
    Box::leak(path.into_boxed_str())
}
