//! Axes of the covering array, and rows of their values.
//!
//! The axes are the keys of the table that affect the estimate, with their values; the registry lists the
//! axes that each estimator uses. A new key must become an axis, or the test of the axes fails; a new value
//! or estimator is covered automatically.

use super::array::Target;
use super::scene::{Boundary, Density, Known, Place};
use majorant_core::estimator::{self, Axis, Entry, REGISTRY};
use majorant_core::math::Sampler;
use majorant_core::scene::SceneDoc;
use majorant_core::scene::keys::{self, Affects, Key, Registry, Type};
use std::collections::BTreeMap;
use std::sync::{LazyLock, Mutex};

/// Axis of the density, which is not a key of the table: a uniform density and three grids.
pub const DENSITY: &str = "density";

/// Axis of the boundary of the medium, which is not a key of the estimate: its own box, or an object of the same
/// extent.
pub const BOUNDARY: &str = "boundary";

/// Axis of the number of media, which is not a key of the table: the medium as a whole, or as the sum of two.
pub const MEDIA: &str = "media";

/// Keys that affect the estimate but are not axes, with the reason.
pub const NO_AXES: [(&str, &str); 2] = [
    ("render.seed", "it selects the random numbers: every row has its own"),
    (
        "estimator.fault",
        "every value but the default is declared biased, and a separate test measures the bias",
    ),
];

/// Keys that affect both the expected image and its estimate.
const IMAGES: [&str; 2] = ["estimator.mode", "medium.precision"];

/// Values of numeric keys, the default first if there is one.
const NUMBERS: [(&str, &[&str]); 3] = [
    ("medium.majorant.factor", &["1.0", "0.5", "1.7"]),
    ("medium.majorant.resolution", &["1", "4"]),
    ("estimator.roulette_depth", &["16", "1"]),
];

/// Axis with its values.
pub struct Values {
    pub key: &'static str,
    /// Axis of the registry, for settings that not every estimator uses.
    pub axis: Option<Axis>,
    /// Values as written in a scene file; the first is the default, if there is one.
    pub values: Vec<String>,
}

impl Values {
    /// Returns the axis of a key of the table; without values if these are unknown.
    fn of(key: &Key) -> Self {
        let numbers = NUMBERS.iter().filter(|(path, _)| *path == key.path).flat_map(|(_, values)| *values);
        let mut values: Vec<String> = match key.value {
            Type::Bool => ["false", "true"].map(str::to_owned).to_vec(),
            Type::Id(Registry::Estimators) => REGISTRY.iter().map(|e| written(e.id)).collect(),
            Type::Choice(_) | Type::Id(_) => key.values().into_iter().map(written).collect(),
            Type::IntegerOr(_, word) => numbers.map(|v| (*v).to_owned()).chain([written(word)]).collect(),
            _ => numbers.map(|v| (*v).to_owned()).collect(),
        };
        if let Some(default) = key.written_default() {
            values.sort_by_key(|value| *value != default.to_string());
        }
        Self { key: key.path, axis: Axis::ALL.into_iter().find(|axis| axis.key() == key.path), values }
    }

    pub fn used_by(&self, entry: &Entry) -> bool {
        self.axis.is_none_or(|axis| entry.uses(axis))
    }

    /// Whether the value can occur with an estimator; on the estimator axis each has exactly one value.
    pub fn admits(&self, value: usize, entry: &Entry) -> bool {
        self.key != "estimator.id" || self.words(value) == entry.id
    }

    /// Returns a value without quotation marks.
    pub fn words(&self, value: usize) -> &str {
        self.values[value].trim_matches('"')
    }

    /// Returns the index of a value given with or without quotation marks.
    fn find(&self, text: &str) -> usize {
        let found = (0..self.values.len()).find(|i| self.words(*i) == text.trim_matches('"'));
        found.unwrap_or_else(|| panic!("{} = {text}", self.key))
    }
}

fn put(table: &mut toml::Value, path: &str, value: &toml::Value) {
    let mut at = table;
    let mut names: Vec<_> = path.split('.').collect();
    let name = names.pop().unwrap();
    for folder in names {
        at = &mut at.as_table_mut().unwrap()[folder];
    }
    at.as_table_mut().unwrap().insert(name.into(), value.clone());
}

fn written(word: &str) -> String {
    format!("{word:?}")
}

/// Returns the keys of the table that affect the estimate, except those of comparison views.
pub fn keys_of_the_estimate() -> impl Iterator<Item = &'static Key> {
    keys::all()
        .iter()
        .filter(|key| key.affects == Affects::Estimate || IMAGES.contains(&key.path))
        .filter(|key| !key.path.starts_with("compare."))
}

pub static AXES: LazyLock<Vec<Values>> = LazyLock::new(|| {
    let is_axis = |key: &&Key| NO_AXES.iter().all(|(path, _)| *path != key.path);
    let mut axes: Vec<_> = keys_of_the_estimate().filter(is_axis).map(Values::of).collect();
    let densities = Density::ALL.map(|density| written(density.name())).to_vec();
    axes.push(Values { key: DENSITY, axis: None, values: densities });
    let media = ["one", "two"].map(written).to_vec();
    axes.push(Values { key: MEDIA, axis: None, values: media });
    let boundaries = Boundary::ALL.map(|boundary| written(boundary.name())).to_vec();
    axes.push(Values { key: BOUNDARY, axis: None, values: boundaries });
    axes
});

pub fn axis(key: &str) -> usize {
    AXES.iter().position(|a| a.key == key).unwrap_or_else(|| panic!("no axis {key}"))
}

/// One value of every axis, and a scene. Axes that the estimator does not use have their first value.
#[derive(Clone, Debug)]
pub struct Row {
    values: Vec<usize>,
    pub known: Known,
    pub coloured: bool,
    /// Density scale in per cent; `None` selects it from the values.
    pub percent: Option<u32>,
    /// Length scale in per cent.
    pub size: u32,
}

/// Value of each axis that the estimator of a row uses, and whether the axis has an effect in that row.
pub struct AtWork(Vec<Option<(usize, bool)>>);

impl AtWork {
    /// Whether the row has the values of a target; with `idle`, values without effect count as well.
    pub fn covers(&self, target: &Target, idle: bool) -> bool {
        target
            .iter()
            .all(|(a, value)| self.0[*a].is_some_and(|(has, works)| has == *value && (works || idle)))
    }
}

impl Row {
    /// Returns the row with the first value of every axis except those in `but`.
    pub fn plain(estimator: &str, but: &[(&str, &str)]) -> Self {
        let mut row = Self {
            values: vec![0; AXES.len()],
            known: Known::Single,
            coloured: true,
            percent: None,
            size: 100,
        };
        row.set("estimator.id", estimator);
        for (key, value) in but {
            row.set(key, value);
        }
        row
    }

    /// Returns the rows with the values of a target and defaults elsewhere, in every scene, for all
    /// estimators that use its axes.
    pub fn plainest(target: &Target) -> impl Iterator<Item = Self> {
        let with = target.clone();
        let usable = |entry: &&Entry| {
            with.iter().all(|(a, value)| AXES[*a].used_by(entry) && AXES[*a].admits(*value, entry))
        };
        let (place, given) = (axis(DENSITY), target.iter().any(|(a, _)| AXES[*a].key == DENSITY));
        let densities = if given { 1 } else { AXES[place].values.len() };
        let mut rows = Vec::new();
        for entry in REGISTRY.iter().filter(usable) {
            for density in 0..densities {
                for known in Known::of(entry) {
                    for coloured in [true, false] {
                        let mut row = Self::plain(entry.id, &[]);
                        (row.known, row.coloured) = (*known, coloured);
                        row.values[place] = density;
                        row.take(target);
                        rows.push(row);
                    }
                }
            }
        }
        rows.into_iter()
    }

    fn take(&mut self, target: &Target) {
        for (axis, value) in target {
            self.values[*axis] = *value;
        }
    }

    /// Returns a row with the values of a target and random values elsewhere; `None` if its estimator does
    /// not use the axes of the target.
    pub fn random(target: &Target, random: &mut Sampler) -> Option<Self> {
        let mut draw = |n: usize| ((random.next_1d() * n as f32) as usize).min(n - 1);
        let mut row = Self::plain(REGISTRY[0].id, &[]);
        row.values = AXES.iter().map(|axis| draw(axis.values.len())).collect();
        row.coloured = draw(2) == 0;
        row.take(target);
        let entry = row.entry();
        row.known = Known::of(entry)[draw(Known::of(entry).len())];
        for (a, _) in AXES.iter().enumerate().filter(|(_, axis)| !axis.used_by(entry)) {
            if target.iter().any(|(axis, _)| *axis == a) {
                return None;
            }
            row.values[a] = 0;
        }
        Some(row)
    }

    /// Returns the rows of the same estimator that differ from this one in the value of one axis, or in their
    /// colours.
    pub fn neighbours(&self) -> Vec<Self> {
        let entry = self.entry();
        let mut rows = Vec::new();
        let free = |axis: &Values| axis.used_by(entry) && axis.key != "estimator.id";
        for (a, axis) in AXES.iter().enumerate().filter(|(_, axis)| free(axis)) {
            for value in (0..axis.values.len()).filter(|value| *value != self.values[a]) {
                let mut row = self.clone();
                row.values[a] = value;
                rows.push(row);
            }
        }
        rows.push(Self { coloured: !self.coloured, ..self.clone() });
        rows
    }

    pub fn value(&self, key: &str) -> &str {
        let a = axis(key);
        AXES[a].words(self.values[a])
    }

    pub fn set(&mut self, key: &str, value: &str) {
        let a = axis(key);
        self.values[a] = AXES[a].find(value);
    }

    /// Whether the estimator uses an axis.
    pub fn uses(&self, key: &str) -> bool {
        AXES[axis(key)].used_by(self.entry())
    }

    pub fn entry(&self) -> &'static Entry {
        estimator::find(self.value("estimator.id")).unwrap()
    }

    pub fn place(&self) -> Place {
        let density = Density::ALL.into_iter().find(|d| d.name() == self.value(DENSITY)).unwrap();
        let factor: f32 = self.value("medium.majorant.factor").parse().unwrap();
        // The weights that compensate for an exceeded majorant vary by e^(3τ) over an optical depth of τ.
        let thin = if factor < 1.0 { 40 } else { 100 };
        let thin = if self.known == Known::Transmittance { thin / 2 } else { thin };
        Place {
            known: self.known,
            density,
            chromatic: self.coloured,
            spectral: self.value("estimator.mode") == "spectral",
            percent: self.percent.unwrap_or(thin),
            size: self.size,
            two: self.value(MEDIA) == "two",
            boundary: Boundary::ALL.into_iter().find(|b| b.name() == self.value(BOUNDARY)).unwrap(),
        }
    }

    /// Scene document of the row.
    pub fn document(&self) -> SceneDoc {
        static PLACES: Mutex<BTreeMap<Place, toml::Value>> = Mutex::new(BTreeMap::new());
        static PARSED: Mutex<BTreeMap<&str, toml::Value>> = Mutex::new(BTreeMap::new());
        let place = self.place();
        let mut tree = PLACES
            .lock()
            .unwrap()
            .entry(place)
            .or_insert_with(|| toml::Value::try_from(place.document()).unwrap())
            .clone();
        let mut parsed = PARSED.lock().unwrap();
        for (a, axis) in
            AXES.iter().enumerate().filter(|(_, axis)| ![DENSITY, MEDIA, BOUNDARY].contains(&axis.key))
        {
            let text = &axis.values[self.values[a]];
            let value = parsed.entry(text).or_insert_with(|| {
                toml::from_str::<toml::Table>(&format!("v = {text}")).unwrap().remove("v").unwrap()
            });
            let (section, path) = axis.key.split_once('.').unwrap();
            let section = if section == "medium" { "media" } else { section };
            match &mut tree[section] {
                // All media have the same settings.
                toml::Value::Array(media) => media.iter_mut().for_each(|medium| put(medium, path, value)),
                table => put(table, path, value),
            }
        }
        drop(parsed);
        tree.try_into().unwrap()
    }

    /// Returns the reason why the image of the row is not compared with a reference: it is invalid, biased or
    /// of infinite variance.
    pub fn rule_against(&self) -> Option<String> {
        let doc = self.document();
        let entry = self.entry();
        if let Some(problem) = estimator::validate(&doc).into_iter().next() {
            return Some(format!("not valid: {problem}"));
        }
        let bias = entry.bias(&doc);
        let ruled = || keys::all().iter().any(|key| key.biases.is_some_and(|bias| (bias.holds)(&doc)));
        assert!(bias.is_none() || ruled(), "{bias:?} without a rule in the table: {}", self.words());
        bias.map(|why| format!("biased: {why}"))
            .or_else(|| (entry.infinite_variance)(&doc).map(|why| format!("infinite variance: {why}")))
    }

    /// Whether an axis has an effect in this row.
    fn is_at_work(&self, key: &str) -> bool {
        let place = self.place();
        let grid = !matches!(place.density, Density::Uniform);
        match key {
            // Achromatic media carry one component for all.
            "estimator.heuristics.components" | "medium.majorant.shared" => !place.achromatic(),
            "estimator.wavelengths" => place.spectral,
            "medium.interpolation" | "medium.precision" | "medium.majorant.resolution" => grid,
            // A furnace has no absorption; a transmittance scene has no scattering.
            "estimator.absorption" => place.known != Known::Furnace,
            "estimator.directions" | "estimator.roulette_depth" => place.known != Known::Transmittance,
            _ => true,
        }
    }

    /// Returns the values and effects of the axes in this row.
    pub fn at_work(&self) -> AtWork {
        let entry = self.entry();
        let value = |(a, axis): (usize, &Values)| {
            axis.used_by(entry).then(|| (self.values[a], self.is_at_work(axis.key)))
        };
        AtWork(AXES.iter().enumerate().map(value).collect())
    }

    /// Approximate running time relative to a row of defaults.
    pub fn cost(&self) -> f64 {
        let costly = [
            ("medium.majorant.factor", "0.5", 3.0),
            ("estimator.id", "equiangular-mis", 2.0),
            ("estimator.heuristics.components", "maximum", 4.0),
            ("estimator.heuristics.components", "hero-only", 2.0),
            ("estimator.heuristics.components", "power", 1.3),
            ("estimator.heuristics.techniques", "maximum", 1.3),
            ("estimator.wavelengths", "uniform", 1.5),
            ("estimator.mode", "spectral", 1.3),
            ("estimator.sampler", "independent", 1.3),
            ("estimator.transmittance", "unbiased-marching", 2.0),
            ("estimator.transmittance", "delta", 1.5),
            ("estimator.distances", "weighted-delta", 1.3),
            ("estimator.absorption", "analogue", 1.3),
        ];
        let values: f64 = costly
            .iter()
            .filter(|(key, value, _)| self.uses(key) && self.value(key) == *value)
            .map(|(_, _, factor)| factor)
            .product();
        let furnace = self.known == Known::Furnace && self.entry().connects();
        // A path sampled by the hero may have a large weight at wavelengths far from the hero's.
        let steep = self.uses("estimator.heuristics.components")
            && self.value("estimator.heuristics.components") == "maximum"
            && self.place().spectral;
        [(furnace, 2.5), (steep, 3.0)].iter().filter(|(has, _)| *has).fold(values, |cost, (_, by)| cost * by)
    }

    pub fn words(&self) -> String {
        let entry = self.entry();
        let used = AXES.iter().enumerate().filter(|(_, axis)| axis.used_by(entry));
        let parts: Vec<_> = used.map(|(a, axis)| axis.words(self.values[a])).collect();
        let colour = if self.coloured { "coloured" } else { "grey" };
        format!("{} {:?} {colour}", parts.join(" "), self.known)
    }
}
