//! The axes of the covering array, and rows of their values.

use super::array::Target;
use super::scene::{Density, Known, Place};
use majorant_core::estimator::{self, Axis, Entry, REGISTRY};
use majorant_core::math::Sampler;
use majorant_core::scene::SceneDoc;
use std::sync::LazyLock;

/// A choice with its values. Keys with a dot are keys of a scene; the others are axes of the scenes that the array makes up.
pub struct Values {
    pub key: &'static str,
    /// The axis of the registry, for choices that not every estimator uses.
    pub axis: Option<Axis>,
    /// As a scene file writes them.
    pub values: Vec<String>,
}

impl Values {
    pub fn used_by(&self, entry: &Entry) -> bool {
        self.axis.is_none_or(|axis| entry.uses(axis))
    }

    /// Whether an estimator can have a value: the axis of estimators has one for each.
    pub fn admits(&self, value: usize, entry: &Entry) -> bool {
        self.key != "estimator.id" || self.values[value] == entry.id
    }
}

fn choices(key: &'static str, axis: Option<Axis>, values: &[&str]) -> Values {
    Values { key, axis, values: values.iter().map(|v| (*v).to_owned()).collect() }
}

pub static AXES: LazyLock<Vec<Values>> = LazyLock::new(|| {
    let ids: Vec<_> = REGISTRY.iter().map(|e| e.id).collect();
    let transmittance: Vec<_> =
        majorant_core::transmittance::TransmittanceKind::all().iter().map(|k| k.entry().id).collect();
    vec![
        choices("estimator.id", None, &ids),
        choices("estimator.distances", Some(Axis::Distances), &["delta", "weighted-delta", "decomposition"]),
        choices("medium.majorant.factor", None, &["0.5", "1.0", "1.7"]),
        choices("medium.majorant.when_exceeded", None, &["weighted", "clamp", "progressive"]),
        choices("density", None, &["uniform", "constant", "rough", "colours"]),
        choices("estimator.absorption", Some(Axis::Absorption), &["weighted", "analogue", "roulette"]),
        choices(
            "estimator.heuristics.components",
            Some(Axis::Components),
            &["balance", "power", "maximum", "hero-only"],
        ),
        choices("estimator.heuristics.techniques", Some(Axis::Techniques), &["balance", "power", "maximum"]),
        choices(
            "estimator.bookkeeping",
            Some(Axis::Bookkeeping),
            &["rescaled", "apart-f32", "apart-f64", "pairwise"],
        ),
        choices("estimator.tracking", Some(Axis::Tracking), &["history", "average", "maximum"]),
        choices("estimator.transmittance", Some(Axis::Transmittance), &transmittance),
        choices("estimator.lights", Some(Axis::Lights), &["uniform", "power", "contribution"]),
        choices("estimator.light_sampling", Some(Axis::LightSampling), &["emitter", "product"]),
        choices("estimator.light_walk", Some(Axis::LightWalk), &["fused", "separate"]),
        choices("estimator.directions", None, &["phase", "towards-lights", "product"]),
        choices("estimator.sampler", None, &["independent", "lattice", "sobol"]),
        choices("estimator.mode", None, &["spectral", "rgb"]),
        choices("estimator.wavelengths", None, &["sensor", "uniform"]),
        choices("estimator.roulette_depth", None, &["16", "\"never\"", "1"]),
        choices("medium.majorant.shared", None, &["false", "true"]),
        choices("medium.majorant.resolution", None, &["1", "4"]),
        choices("medium.interpolation", None, &["trilinear", "stochastic"]),
        choices("medium.precision", None, &["f32", "f16", "u8"]),
        choices("known", None, &["transmittance", "single", "furnace"]),
        choices("coloured", None, &["true", "false"]),
    ]
});

fn axis(key: &str) -> usize {
    AXES.iter().position(|a| a.key == key).unwrap_or_else(|| panic!("no axis {key}"))
}

/// One value of every axis; those of axes that the estimator does not use are at their first.
#[derive(Clone, Debug)]
pub struct Row(Vec<usize>);

impl Row {
    /// A row with the values of a target and random ones elsewhere; `None` if its estimator cannot have the target.
    pub fn random(target: &Target, random: &mut Sampler) -> Option<Self> {
        let mut draw = |n: usize| ((random.next_1d() * n as f32) as usize).min(n - 1);
        let mut row = Self(AXES.iter().map(|axis| draw(axis.values.len())).collect());
        for (axis, value) in target {
            row.0[*axis] = *value;
        }
        let entry = row.entry();
        let kept = |a: usize| target.iter().any(|(axis, _)| *axis == a);
        for (a, axis) in AXES.iter().enumerate() {
            if !axis.used_by(entry) {
                if kept(a) {
                    return None;
                }
                row.0[a] = 0;
            }
        }
        Some(row)
    }

    pub fn value(&self, key: &str) -> &str {
        let a = axis(key);
        &AXES[a].values[self.0[a]]
    }

    pub fn entry(&self) -> &'static Entry {
        estimator::find(self.value("estimator.id")).unwrap()
    }

    pub fn place(&self) -> Place {
        Place {
            known: match self.value("known") {
                "transmittance" => Known::Transmittance,
                "single" => Known::Single,
                _ => Known::Furnace,
            },
            density: match self.value("density") {
                "uniform" => Density::Uniform,
                "constant" => Density::Constant,
                "rough" => Density::Rough,
                _ => Density::Colours,
            },
            chromatic: self.value("coloured") == "true",
            spectral: self.value("estimator.mode") == "spectral",
        }
    }

    /// The scene.
    pub fn document(&self) -> SceneDoc {
        let mut tree = toml::Value::try_from(self.place().document()).unwrap();
        for (a, axis) in AXES.iter().enumerate().filter(|(_, axis)| axis.key.contains('.')) {
            let text = &axis.values[self.0[a]];
            let table = toml::from_str::<toml::Table>(&format!("v = {text}"))
                .or_else(|_| toml::from_str::<toml::Table>(&format!("v = {text:?}")));
            let value = table.unwrap().remove("v").unwrap();
            let mut at = &mut tree;
            let (folders, name) = axis.key.rsplit_once('.').unwrap();
            for folder in folders.split('.') {
                at = &mut at.as_table_mut().unwrap()[folder];
            }
            at.as_table_mut().unwrap().insert(name.into(), value);
        }
        tree.try_into().unwrap()
    }

    /// What is declared of the row: why its image is not held against an answer.
    pub fn rule_against(&self) -> Option<String> {
        // Without scattering connections have nothing to do.
        if self.place().known == Known::Transmittance && self.entry().connects() {
            return Some("known: connections need scattering".into());
        }
        // Weights below a majorant that bounds vary the more the longer the paths are.
        if self.place().known == Known::Furnace && self.value("medium.majorant.factor") == "0.5" {
            return Some("known: an exceeded majorant is held by single scattering and transmittance".into());
        }
        let doc = self.document();
        let entry = self.entry();
        if let Some(problem) = estimator::validate(&doc).into_iter().next() {
            return Some(format!("not valid: {problem}"));
        }
        entry
            .bias(&doc)
            .map(|why| format!("biased: {why}"))
            .or_else(|| (entry.infinite_variance)(&doc).map(|why| format!("infinite variance: {why}")))
    }

    /// Whether the value of an axis can change anything in this row.
    fn is_at_work(&self, key: &str) -> bool {
        let place = self.place();
        let grid = !matches!(place.density, Density::Uniform);
        match key {
            // One component is carried for all.
            "estimator.heuristics.components" | "medium.majorant.shared" => !place.achromatic(),
            "estimator.wavelengths" => place.spectral,
            "medium.interpolation" | "medium.precision" | "medium.majorant.resolution" => grid,
            // Nothing is absorbed in a furnace.
            "estimator.absorption" => place.known != Known::Furnace,
            // Along single scattering no path reaches it.
            "estimator.roulette_depth" => place.known == Known::Furnace || self.value(key) != "16",
            _ => true,
        }
    }

    /// The values that can change something in this row.
    pub fn at_work(&self) -> AtWork {
        let entry = self.entry();
        let value = |(a, axis): (usize, &Values)| {
            (axis.used_by(entry) && self.is_at_work(axis.key)).then_some(self.0[a])
        };
        AtWork(AXES.iter().enumerate().map(value).collect())
    }

    /// Roughly how much noisier the row is than a plain one.
    pub fn cost(&self) -> f64 {
        let costly: [(&str, &str, f64); 8] = [
            ("medium.majorant.factor", "0.5", 2.0),
            ("estimator.heuristics.components", "hero-only", 3.0),
            ("estimator.heuristics.components", "maximum", 2.0),
            ("estimator.heuristics.components", "power", 1.5),
            ("estimator.heuristics.techniques", "maximum", 1.3),
            ("estimator.wavelengths", "uniform", 3.0),
            ("estimator.distances", "weighted-delta", 1.5),
            ("estimator.absorption", "roulette", 1.5),
        ];
        costly
            .iter()
            .filter(|(key, value, _)| self.value(key) == *value)
            .map(|(_, _, factor)| factor)
            .product()
    }

    pub fn words(&self) -> String {
        let entry = self.entry();
        let used = AXES.iter().enumerate().filter(|(_, axis)| axis.used_by(entry));
        let parts: Vec<_> =
            used.map(|(a, axis)| axis.values[self.0[a]].trim_matches('"').to_owned()).collect();
        parts.join(" ")
    }
}

/// Values that can change something in a row, by axis.
pub struct AtWork(Vec<Option<usize>>);

impl AtWork {
    pub fn covers(&self, target: &Target) -> bool {
        target.iter().all(|(a, value)| self.0[*a] == Some(*value))
    }
}

impl Row {
    /// The first value of every axis, but for some.
    pub fn plain(estimator: &str, but: &[(&str, &str)]) -> Self {
        let mut row = Self(vec![0; AXES.len()]);
        row.set("estimator.id", estimator);
        row.set("medium.majorant.factor", "1.0");
        for (key, value) in but {
            row.set(key, value);
        }
        row
    }

    pub fn set(&mut self, key: &str, value: &str) {
        let a = axis(key);
        self.0[a] =
            AXES[a].values.iter().position(|v| v == value).unwrap_or_else(|| panic!("{key} = {value}"));
    }

    /// Whether the estimator uses an axis.
    pub fn uses(&self, key: &str) -> bool {
        AXES[axis(key)].used_by(self.entry())
    }
}
