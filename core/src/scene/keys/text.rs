//! Table of keys as JSON and as Markdown.

use super::check::words;
use super::{Default, Key, Registry, Type};
use serde_json::{Value, json};

impl Type {
    /// Name in listings.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Bool => "boolean".into(),
            Self::Number(_) => "number".into(),
            Self::Integer(_) => "integer".into(),
            Self::IntegerOr(_, word) => format!("integer or \"{word}\""),
            Self::Vector(n, _) => format!("{n} numbers"),
            Self::Integers(n, _) => format!("{n} integers"),
            Self::Direction => "direction".into(),
            Self::Matrix(_) => "3 rows of 4 numbers".into(),
            Self::Pairs => "pairs of numbers".into(),
            Self::Spectrum(_) => "spectrum".into(),
            Self::Choice(_) => "choice".into(),
            Self::Id(_) => "id".into(),
            Self::File => "file".into(),
            Self::Text => "text".into(),
        }
    }
}

/// One key as a JSON object with path, type, range, unit, default, label, tip, affects, biases; with kind
/// where only some kinds of its table have it, and values where it is a choice. `ids` lists the entries of
/// registries in higher modules.
#[must_use]
pub fn json(key: &Key, ids: &impl Fn(Registry) -> Vec<&'static str>) -> Value {
    let range = key.range().map(|range| json!([range.min, range.max]));
    let mut object = json!({
        "path": key.path,
        "type": key.value.name(),
        "range": range,
        "unit": (!key.unit.is_empty()).then_some(key.unit),
        "default": match key.default {
            Default::Is(_) => key.written_default().and_then(|v| serde_json::to_value(v).ok()),
            Default::Absent(_) | Default::Required => None,
        },
        "label": key.label,
        "tip": key.tip,
        "affects": key.affects.id(),
        "biases": key.biases.map(|bias| bias.when),
    });
    let Some(fields) = object.as_object_mut() else { return object };
    if !key.kinds.is_empty() {
        fields.insert("kind".into(), json!(key.kinds));
    }
    if let Some(range) = key.range().filter(|range| range.open.contains(&true)) {
        fields.insert("open".into(), json!(range.open));
    }
    match key.default {
        Default::Absent(meaning) => fields.insert("absent".into(), json!(meaning)),
        Default::Required => fields.insert("required".into(), json!(true)),
        Default::Is(_) => None,
    };
    let values = values(key, ids);
    if !values.is_empty() {
        fields.insert("values".into(), json!(values));
    }
    object
}

fn values(key: &Key, ids: &impl Fn(Registry) -> Vec<&'static str>) -> Vec<&'static str> {
    match key.value {
        Type::Id(registry @ (Registry::Estimators | Registry::Measures)) => ids(registry),
        _ => key.values(),
    }
}

/// Description of a value: its type, range and unit, or its choices.
#[must_use]
pub fn value_in_words(key: &Key, ids: &impl Fn(Registry) -> Vec<&'static str>) -> String {
    let unit = if key.unit.is_empty() { String::new() } else { format!(" {}", key.unit) };
    match (values(key, ids).as_slice(), key.range()) {
        ([], Some(range)) => format!("{}, {}{unit}", key.value.name(), words(range)),
        ([], None) => key.value.name(),
        (values, _) => values.join(", "),
    }
}

/// Keys as a Markdown table, without those of further views, which repeat the scene's.
#[must_use]
pub fn markdown(keys: &[Key]) -> String {
    let mut text =
        String::from("| key | value | default | what | affects |\n| --- | --- | --- | --- | --- |\n");
    for key in keys.iter().filter(|key| !key.path.starts_with("compare.views.")) {
        let kinds = if key.kinds.is_empty() { String::new() } else { format!(" ({})", key.kinds.join(", ")) };
        let value = value_in_words(key, &|_| Vec::new());
        let default = match key.default {
            Default::Is(text) => format!("`{text}`"),
            Default::Absent(meaning) => format!("absent: {meaning}"),
            Default::Required => "required".into(),
        };
        let bias = key.biases.map(|bias| format!("; **biases** {}", bias.when)).unwrap_or_default();
        let line = format!(
            "| `{}`{kinds} | {value} | {default} | {} | {}{bias} |\n",
            key.path,
            key.tip,
            key.affects.id()
        );
        text.push_str(&line);
    }
    text
}
