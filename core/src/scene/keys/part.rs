//! Documents as the values of their keys: what they agree in, and the parts that something depends on.

use super::{Affects, Key, all};
use crate::scene::SceneDoc;
use std::collections::{BTreeMap, HashMap};
use std::sync::OnceLock;
use toml::{Table, Value};

/// A key with its value in a document.
#[derive(Clone, Debug, PartialEq)]
pub struct Leaf {
    /// The key's place in the table.
    index: usize,
    /// Where it stands, with numbers of entries: `lights[1].size`.
    pub path: String,
    /// Its value.
    pub value: Value,
}

impl Leaf {
    /// The key.
    #[must_use]
    pub fn key(&self) -> &'static Key {
        &all()[self.index]
    }

    /// Whether it is what the key's absence means.
    #[must_use]
    pub fn is_default(&self) -> bool {
        self.key().default_value().as_ref() == Some(&self.value)
    }
}

/// Places of keys by their paths.
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

/// The values of a document, key by key in the order of the table, entry by entry in lists.
///
/// # Errors
/// When a value cannot be written into a scene file.
pub fn leaves(doc: &SceneDoc) -> Result<Vec<Leaf>, toml::ser::Error> {
    let mut found = Vec::new();
    if let Value::Table(table) = Value::try_from(doc)? {
        walk(table, "", "", &mut found);
    }
    let first = |leaf: &Leaf| {
        let list = leaf.key().path.split_once(".*").map(|(list, _)| list);
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
        let (pattern, path) = (format!("{pattern}{dot}{name}"), format!("{path}{dot}{name}"));
        let places = places().get(pattern.as_str()).map(Vec::as_slice).unwrap_or_default();
        if let Some(index) = places.iter().find(|index| all()[**index].is_of(kind.as_deref())) {
            found.push(Leaf { index: *index, path, value });
            continue;
        }
        match value {
            Value::Table(inner) => walk(inner, &pattern, &path, found),
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

/// Puts a value to its place, making tables and entries on the way. Entries come in their order.
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

/// The keys in which two documents differ, in the order of the table; `None` if one of them cannot be written.
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
    /// The values of some of its keys, everything else at its default. One that cannot be written stays whole: it
    /// agrees with nothing but itself.
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

    /// The part that the frozen scene depends on, everything else at its default: two documents that agree in it share
    /// one frozen scene.
    #[must_use]
    pub fn scene_part(&self) -> Self {
        self.part(Key::is_frozen)
    }

    /// The part that the estimate depends on: two documents that agree in it give the same image after the same number
    /// of samples. Limits, title and display are left out, and other views.
    #[must_use]
    pub fn render_part(&self) -> Self {
        self.part(|key| {
            matches!(key.affects, Affects::Scene | Affects::Estimate) && !key.path.starts_with("compare.")
        })
    }

    /// The part that the *expected* image depends on, everything else at its default: documents that agree in it
    /// converge to the same image under every unbiased estimator.
    #[must_use]
    pub fn target_part(&self) -> Self {
        self.part(|key| key.affects == Affects::Scene && !key.path.starts_with("compare."))
    }
}
