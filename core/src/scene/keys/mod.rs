//! The table of keys: one row for every key of a scene file.
//!
//! ```text
//!   camera, medium, phase, lights, estimator, render, compare ──► all() ──► validation, panels, `majorant keys`,
//!                                                                           parts of documents, fingerprints, unbiased()
//! ```
//!
//! A row says which values make sense, what they mean, what they affect and when they bias the estimate. A new key is a
//! field of a document and a row here; tests hold each to the other.

mod biases;
mod camera;
mod check;
mod compare;
mod estimator;
mod lights;
mod medium;
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
    /// Where it stands: `medium.majorant.factor`; `*` stands for the number of a list's entry.
    pub path: &'static str,
    /// The kinds of its table that have it; empty: all.
    pub kinds: &'static [&'static str],
    /// What a value looks like.
    pub value: Type,
    /// The unit; empty: none.
    pub unit: &'static str,
    /// The value if the key is absent.
    pub default: Default,
    /// Name in panels.
    pub label: &'static str,
    /// Meaning, preferably with the equation that it stands in.
    pub tip: &'static str,
    /// What it affects.
    pub affects: Affects,
    /// When it biases the estimate; absent: never.
    pub biases: Option<&'static Bias>,
    /// How a value out of range is put right, at the end of the message.
    pub cure: &'static str,
}

/// What a key affects.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Affects {
    /// The expected image: what unbiased estimators converge to.
    Scene,
    /// How that image is estimated: its noise, its cost, its random numbers.
    Estimate,
    /// When rendering stops, and on how many threads it runs: no sample.
    Limits,
    /// What is shown, and what it is held against: no sample.
    View,
}

impl Affects {
    /// Its name in listings.
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

/// The value of an absent key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Default {
    /// A value, as it is written in a scene file.
    Is(&'static str),
    /// No value, and what that means.
    Absent(&'static str),
    /// The key has to be there.
    Required,
}

/// What a value looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Type {
    /// `true` or `false`.
    Bool,
    /// A real number.
    Number(Range),
    /// A whole number.
    Integer(Range),
    /// A whole number, or a word.
    IntegerOr(Range, &'static str),
    /// So many real numbers.
    Vector(usize, Range),
    /// So many whole numbers.
    Integers(usize, Range),
    /// Three numbers that are not all zero.
    Direction,
    /// Three rows of four numbers.
    Matrix(Range),
    /// Pairs of numbers.
    Pairs,
    /// A spectrum with values in this range.
    Spectrum(Range),
    /// One of these words.
    Choice(&'static [&'static str]),
    /// An id of a registry.
    Id(Registry),
    /// The name of a file, relative to the scene's.
    File,
    /// Any text.
    Text,
}

/// What ids are looked up in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Registry {
    /// `majorant estimators`.
    Estimators,
    /// [`TransmittanceKind`].
    Transmittance,
    /// Measures of error.
    Measures,
}

/// Numbers that make sense.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The least.
    pub min: f64,
    /// The largest.
    pub max: f64,
    /// Whether the ends themselves are left out.
    pub open: [bool; 2],
}

impl Range {
    /// A range with its ends.
    #[must_use]
    pub const fn closed(min: f64, max: f64) -> Self {
        Self { min, max, open: [false; 2] }
    }

    /// A range above its lower end.
    #[must_use]
    pub const fn above(min: f64, max: f64) -> Self {
        Self { min, max, open: [true, false] }
    }

    /// A range between its ends.
    #[must_use]
    pub const fn between(min: f64, max: f64) -> Self {
        Self { min, max, open: [true; 2] }
    }

    /// Whether a number of single precision is in it; ends count as single precision holds them.
    #[must_use]
    pub fn holds(&self, value: f32) -> bool {
        let [low, high] = [self.min as f32, self.max as f32];
        let above = if self.open[0] { value > low } else { value >= low };
        above && if self.open[1] { value < high } else { value <= high }
    }

    /// Whether a whole number is in it.
    #[must_use]
    pub fn holds_integer(&self, value: i64) -> bool {
        (self.min..=self.max).contains(&(value as f64))
    }

    /// The same range with both ends included, as sliders need it: an open end moves by a millionth of its scale, which
    /// single precision can tell.
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
/// Lengths.
const LENGTH: Range = Range::above(0.0, 1e9);
/// Shares.
const SHARE: Range = Range::closed(0.0, 1.0);
/// Limits that have to be positive.
const POSITIVE: Range = Range::above(0.0, f32::MAX as f64);
/// Numbers of samples.
const SAMPLES: Range = Range::closed(1.0, i64::MAX as f64);
/// Random seeds: what a scene file holds.
const SEEDS: Range = Range::closed(0.0, i64::MAX as f64);

impl Key {
    /// A key that affects the expected image, for all kinds, without a unit.
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

    /// Whether the frozen scene is built from it.
    #[must_use]
    pub fn is_frozen(&self) -> bool {
        let section = self.path.split('.').next().unwrap_or_default();
        ["camera", "film", "medium", "lights", "objects"].contains(&section)
    }

    /// The values of a choice or registry that a document may hold, as far as this room knows them.
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

    /// The range of its numbers, if it has any.
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

    /// The default as it is written.
    #[must_use]
    pub fn written_default(&self) -> Option<toml::Value> {
        let Default::Is(text) = self.default else { return None };
        toml::from_str::<toml::Table>(&format!("v = {text}")).ok()?.remove("v")
    }

    /// The default as a document holds it: in single precision.
    #[must_use]
    pub fn default_value(&self) -> Option<toml::Value> {
        self.written_default().map(rounded)
    }

    /// Whether it is a key of tables of this kind.
    fn is_of(&self, kind: Option<&str>) -> bool {
        self.kinds.is_empty() || kind.is_some_and(|kind| self.kinds.contains(&kind))
    }
}

/// A value with its numbers rounded to single precision.
fn rounded(value: toml::Value) -> toml::Value {
    match value {
        toml::Value::Float(x) => toml::Value::Float(f64::from(x as f32)),
        toml::Value::Array(entries) => toml::Value::Array(entries.into_iter().map(rounded).collect()),
        other => other,
    }
}

/// Every key, in the order of a scene file.
#[must_use]
pub fn all() -> &'static [Key] {
    static ALL: OnceLock<Vec<Key>> = OnceLock::new();
    ALL.get_or_init(|| {
        let own = [camera::KEYS, medium::KEYS].concat();
        let mut all = [own, phase::keys(), [lights::KEYS, estimator::KEYS, render::KEYS].concat()].concat();
        all.extend(compare::KEYS);
        all.extend(compare::of_views(&all));
        all.extend(window::KEYS);
        all
    })
}

/// The key at a path, for a kind of its table where that matters.
#[must_use]
pub fn find(path: &str, kind: Option<&str>) -> Option<&'static Key> {
    all().iter().find(|key| key.path == path && (kind.is_none() || key.is_of(kind)))
}

/// The name of a key that is made from others, for the life of the program: the table is made once.
fn named(path: String) -> &'static str {
    Box::leak(path.into_boxed_str())
}
