//! Documents as lists of key values: differences, and the parts that determine a result.

use super::{Affects, Key, all};
use crate::scene::SceneDoc;
use std::collections::{BTreeMap, HashMap};
use std::sync::OnceLock;
use toml::{Table, Value};

/// A key and its value in a document.
#[derive(Clone, Debug, PartialEq)]
pub struct Leaf {
    /// Index of the key in the table.
    index: usize,
    /// Path with list indices, e.g. `lights[1].size`.
    pub path: String,
    /// Value.
    pub value: Value,
}

impl Leaf {
    /// Returns the key.
    #[must_use]
    pub fn key(&self) -> &'static Key {
        &all()[self.index]
    }

    /// Returns whether the value equals the default of the key.
    #[must_use]
    pub fn is_default(&self) -> bool {
        self.key().default_value().as_ref() == Some(&self.value)
    }
}

/// Section of the media: a list in a file, whose keys have no index.
const MEDIUM: &str = "medium";

/// Name of the list of media in a file.
const MEDIA: &str = "media";

/// Indices of keys in the table, by path.
fn places() -> &'static HashMap<&'static str, Vec<usize>> {
    static PLACES: OnceLock<HashMap<&'static str, Vec<usize>>> = OnceLock::new();
    PLACES.get_or_init(|| {
        let mut places = HashMap::<_, Vec<usize>>::new();
        for (index, key) in all().iter().enumerate() {
            places.entry(key.path).or_default().push(index);
        }
        places
    })
}

/// Returns the values of a document in the order of the table; lists are ordered by entry.
///
/// # Errors
/// When a value cannot be represented in a scene file.
pub fn leaves(doc: &SceneDoc) -> Result<Vec<Leaf>, toml::ser::Error> {
    let mut found = Vec::new();
    if let Value::Table(table) = Value::try_from(doc)? {
        walk(table, "", "", &mut found);
    }
    let first = |leaf: &Leaf| {
        let of_media = leaf.path.starts_with("medium[").then_some(MEDIUM);
        let list = of_media.or(leaf.key().path.split_once(".*").map(|(list, _)| list));
        let section = list.and_then(|list| all().iter().position(|key| key.path.starts_with(list)));
        let number =
            leaf.path.split_once('[').and_then(|(_, rest)| rest.split_once(']')?.0.parse::<usize>().ok());
        (section.unwrap_or(leaf.index), number, leaf.index)
    };
    found.sort_by_cached_key(first);
    Ok(found)
}

fn walk(table: Table, pattern: &str, path: &str, found: &mut Vec<Leaf>) {
    let kind = table.get("kind").and_then(Value::as_str).map(str::to_owned);
    let dot = if pattern.is_empty() { "" } else { "." };
    for (name, value) in table {
        let name = if pattern.is_empty() && name == MEDIA { MEDIUM.to_owned() } else { name };
        let (pattern, path) = (format!("{pattern}{dot}{name}"), format!("{path}{dot}{name}"));
        let places = places().get(pattern.as_str()).map(Vec::as_slice).unwrap_or_default();
        if let Some(index) = places.iter().find(|index| all()[**index].is_of(kind.as_deref())) {
            found.push(Leaf { index: *index, path, value });
            continue;
        }
        match value {
            Value::Table(inner) => walk(inner, &pattern, &path, found),
            // Keys of media have no index: most scenes have one medium.
            Value::Array(entries) if pattern == MEDIUM => {
                let is_only = entries.len() == 1;
                for (number, entry) in entries.into_iter().enumerate() {
                    let path = if is_only { path.clone() } else { format!("{path}[{number}]") };
                    if let Value::Table(entry) = entry {
                        walk(entry, MEDIUM, &path, found);
                    }
                }
            }
            Value::Array(entries) => {
                for (number, entry) in entries.into_iter().enumerate() {
                    if let Value::Table(entry) = entry {
                        walk(entry, &format!("{pattern}.*"), &format!("{path}[{number}]"), found);
                    }
                }
            }
            _ => {}
        }
    }
}

/// Inserts a value at a path, creating tables and list entries on the way. List entries have to come in
/// order.
pub(super) fn put(table: &mut Table, path: &str, value: Value) {
    let Some((first, rest)) = path.split_once('.') else {
        table.insert(path.to_owned(), value);
        return;
    };
    let (name, number) = match first.split_once('[') {
        Some((name, number)) => (name, number.trim_end_matches(']').parse::<usize>().ok()),
        None => (first, None),
    };
    let Some(number) = number else {
        if let Value::Table(inner) = table.entry(name).or_insert_with(|| Value::Table(Table::new())) {
            put(inner, rest, value);
        }
        return;
    };
    if let Value::Array(entries) = table.entry(name).or_insert_with(|| Value::Array(Vec::new())) {
        while entries.len() <= number {
            entries.push(Value::Table(Table::new()));
        }
        if let Value::Table(entry) = &mut entries[number] {
            put(entry, rest, value);
        }
    }
}

/// Returns the keys in which two documents differ, in the order of the table; `None` if one of them cannot be
/// serialised.
#[must_use]
pub fn changed(a: &SceneDoc, b: &SceneDoc) -> Option<Vec<&'static Key>> {
    let values = |doc| Some(leaves(doc).ok()?.into_iter().map(|l| ((l.index, l.path), l.value)).collect());
    let (a, b): (BTreeMap<_, _>, BTreeMap<_, _>) = (values(a)?, values(b)?);
    let mut changed: Vec<usize> = Vec::new();
    for (place, other) in a.keys().chain(b.keys()).map(|place| (place, [a.get(place), b.get(place)])) {
        let default = all()[place.0].default_value();
        let [a, b] = other.map(|value| value.or(default.as_ref()));
        if a != b && !changed.contains(&place.0) {
            changed.push(place.0);
        }
    }
    changed.sort_unstable();
    Some(changed.into_iter().map(|index| &all()[index]).collect())
}

impl SceneDoc {
    /// Keeps the values of some keys and resets all others to their defaults. A document that cannot be
    /// serialised is returned unchanged, so that it equals only itself.
    fn part(&self, keep: impl Fn(&Key) -> bool) -> Self {
        let Ok(leaves) = leaves(self) else { return self.clone() };
        let mut table = Table::new();
        for leaf in leaves {
            if leaf.key().path == "majorant" || keep(leaf.key()) {
                put(&mut table, &leaf.path, leaf.value);
            }
        }
        table.try_into().unwrap_or_else(|_| self.clone())
    }

    /// The part that the frozen scene depends on, all other keys at their defaults: documents with equal
    /// parts share one frozen scene.
    #[must_use]
    pub fn scene_part(&self) -> Self {
        self.part(Key::is_frozen)
    }

    /// The part that the estimate depends on: documents with equal parts give the same image after the same
    /// number of samples. Excludes limits, title, display and further views.
    #[must_use]
    pub fn render_part(&self) -> Self {
        self.part(|key| {
            matches!(key.affects, Affects::Scene | Affects::Estimate) && !key.path.starts_with("compare.")
        })
    }

    /// The part that the *expected* image depends on, all other keys at their defaults: documents with equal
    /// parts converge to the same image under every unbiased estimator.
    #[must_use]
    pub fn target_part(&self) -> Self {
        self.part(|key| key.affects == Affects::Scene && !key.path.starts_with("compare."))
    }
}
