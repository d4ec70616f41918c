//! Tests that the rows of the table agree with the documents, and the documents with the rows.

use super::{Affects, Default, Key, Range, Type, all, changed, leaves};
use crate::estimator::{self, REGISTRY};
use crate::scene::{
    Bookkeeping, DensityDoc, EmissionDoc, Fault, MediumDoc, SceneDoc, WhenExceeded, validate,
};
use crate::transmittance::TransmittanceKind;
use std::collections::BTreeSet;
use toml::{Table, Value};

/// A table of a scene file that holds keys, with its kind if it has kinds.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    path: &'static str,
    kind: Option<&'static str>,
}

fn parent(path: &str) -> &str {
    path.rsplit_once('.').map_or("", |(parent, _)| parent)
}

fn keys_of(place: &Place) -> impl Iterator<Item = &'static Key> {
    all().iter().filter(|key| parent(key.path) == place.path && key.is_of(place.kind))
}

/// Every table of a scene file, in every kind.
fn tables() -> BTreeSet<Place> {
    let mut tables = BTreeSet::new();
    for key in all() {
        let mut path = parent(key.path);
        loop {
            let kind = all().iter().find(|k| parent(k.path) == path && k.path.ends_with("kind"));
            match kind.map(Key::values) {
                Some(kinds) => tables.extend(kinds.into_iter().map(|kind| Place { path, kind: Some(kind) })),
                None => _ = tables.insert(Place { path, kind: None }),
            }
            if path.is_empty() {
                break;
            }
            path = parent(path).trim_end_matches(".*");
        }
    }
    // Window state is read by the application.
    tables.retain(|place| {
        !["lights", "objects", "compare.views", "compare.views.*.media", "window"].contains(&place.path)
    });
    tables
}

/// Keys that their table requires, although the table itself may be absent.
const OPENS: [&str; 3] =
    ["medium.coefficients.kind", "medium.albedo_grid.file", "medium.emission.temperature.file"];

fn is_needed(key: &Key) -> bool {
    key.default == Default::Required || OPENS.contains(&key.path) || key.path.ends_with(".kind")
}

fn put(table: &mut Table, path: &str, value: Value) {
    super::part::put(table, &path.replace(".*", "[0]"), value);
}

/// Two valid values of a key.
fn samples(key: &Key) -> [Value; 2] {
    let number = |range: Range, share: f64| {
        let (low, high) = (range.min.max(-8.0), range.max.min(8.0));
        Value::Float(f64::from((low + share * (high - low)) as f32))
    };
    let integer = |range: Range, add: i64| Value::Integer((range.min as i64 + add).min(range.max as i64));
    let row =
        |n: usize, range, a: f64| Value::Array((0..n).map(|i| number(range, a + 0.1 * i as f64)).collect());
    match key.value {
        Type::Bool => [false.into(), true.into()],
        Type::Number(range) | Type::Spectrum(range) => [number(range, 0.3), number(range, 0.6)],
        Type::Integer(range) | Type::IntegerOr(range, _) => [integer(range, 0), integer(range, 1)],
        Type::Vector(n, range) => [row(n, range, 0.2), row(n, range, 0.6)],
        Type::Integers(n, range) => {
            [2, 5].map(|first| Value::Array((0..n as i64).map(|i| integer(range, first + i)).collect()))
        }
        Type::Direction => [row(3, Range::closed(-1.0, 1.0), 0.2), row(3, Range::closed(-1.0, 1.0), 0.6)],
        Type::Matrix(range) => {
            [0.1, 0.5].map(|a| Value::Array((0..3).map(|i| row(4, range, a + 0.02 * f64::from(i))).collect()))
        }
        Type::Pairs => [[0.0, 1.0], [0.5, 2.0]].map(|[a, b]| {
            let pair = |x: f64, y: f64| Value::Array(vec![Value::Float(x), Value::Float(y)]);
            Value::Array(vec![pair(-1.0, a + 0.5), pair(1.0, b)])
        }),
        Type::Choice(_) | Type::Id(super::Registry::Transmittance) => {
            let values = key.values();
            [values[0], values[values.len().min(2) - 1]].map(Into::into)
        }
        Type::Id(super::Registry::Estimators) => ["nee".into(), "spectral-mis".into()],
        Type::Id(super::Registry::Measures) | Type::File | Type::Text => ["one".into(), "two".into()],
    }
}

/// A document with a table that holds only its required keys.
fn minimal(place: &Place) -> Table {
    let mut table = Table::new();
    table.insert("majorant".into(), 1.into());
    let mut inside = Table::new();
    for key in keys_of(place).filter(|key| is_needed(key) && !place.path.is_empty()) {
        let name = key.path.rsplit('.').next().unwrap().to_owned();
        let value = if name == "kind" {
            place.kind.unwrap().into()
        } else {
            // The position of a light must differ from its target.
            samples(key)[usize::from(name == "target")].clone()
        };
        inside.insert(name, value);
    }
    // Tables of an object need the object.
    if place.path.starts_with("objects.*.") {
        put(&mut table, "objects.*.kind", "mesh".into());
        put(&mut table, "objects.*.file", "one".into());
    }
    if !place.path.is_empty() {
        let path = place.path.replace(".*", "[0]");
        // The table has to exist even if it is empty.
        super::part::put(&mut table, &format!("{path}.x"), 0.into());
        let text = toml::to_string(&table).unwrap();
        table = toml::from_str(&text.replace("x = 0\n", "")).unwrap();
        for (name, value) in inside {
            super::part::put(&mut table, &format!("{path}.{name}"), value);
        }
    }
    table
}

fn read(table: &Table) -> Result<SceneDoc, String> {
    let doc = toml::from_str::<SceneDoc>(&toml::to_string(table).unwrap());
    doc.map(SceneDoc::upgraded).map_err(|e| e.message().to_owned())
}

/// Words in backticks after "expected".
fn expected(message: &str) -> BTreeSet<String> {
    let list = message.split_once("expected").map_or("", |(_, list)| list);
    list.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

/// Keys under `window` that were formerly under `compare`.
const EARLIER: [&str; 4] = ["arrangement", "pair", "layer", "own_zoom"];

/// Keys that objects of all kinds have, and which messages about the keys of a kind do not list.
const OF_ALL_OBJECTS: [&str; 5] = ["name", "enabled", "material", "emission", "priority"];

#[test]
fn every_key_has_one_row_and_every_row_a_key() {
    let tables = tables();
    assert!(tables.len() > 30, "{tables:?}");
    for place in &tables {
        let mut table = minimal(place);
        assert!(read(&table).is_ok(), "{place:?}: {:?}", read(&table));
        put(&mut table, format!("{}.bogus", place.path).trim_start_matches('.'), 1.into());
        let message = read(&table).unwrap_err();
        assert!(message.contains("`bogus`"), "{place:?}: {message}");
        let start = if place.path.is_empty() { String::new() } else { format!("{}.", place.path) };
        let mut rows = BTreeSet::new();
        for key in all().iter().filter(|key| key.path.starts_with(&start)) {
            let rest = &key.path[start.len()..];
            let name = rest.split('.').next().unwrap();
            // The kind is read before the other keys.
            if rest != name || key.is_of(place.kind) && !(name == "kind" && place.kind.is_some()) {
                rows.insert(name.to_owned());
            }
            if rest == name {
                let alike = keys_of(place).filter(|k| k.path == key.path).count();
                assert!(alike <= 1, "{} has {alike} rows", key.path);
            }
        }
        let mut known = expected(&message);
        known.retain(|name| place.path != "compare" || !EARLIER.contains(&name.as_str()));
        match place.path {
            // Both names of the list of media are read; keys have the first.
            "" => known.retain(|name| name != "media"),
            "objects.*" => {
                known.extend(OF_ALL_OBJECTS.map(str::to_owned));
                rows.retain(|name| name != "placement" || place.kind == Some("mesh"));
            }
            _ => {}
        }
        assert_eq!(known, rows, "{place:?}: {message}");
    }
}

#[test]
fn defaults_are_what_an_absent_key_means() {
    for place in tables() {
        let table = minimal(&place);
        let plain = read(&table).unwrap();
        for key in keys_of(&place).filter(|key| !key.path.ends_with("kind") && !OPENS.contains(&key.path)) {
            let found = leaves(&plain).unwrap().into_iter().find(|leaf| leaf.key().path == key.path);
            match key.default {
                Default::Is(_) => {
                    let mut explicit = table.clone();
                    put(&mut explicit, key.path, key.default_value().unwrap());
                    assert_eq!(read(&explicit).unwrap(), plain, "{}", key.path);
                    assert!(found.is_none_or(|leaf| leaf.is_default()), "{}", key.path);
                }
                Default::Absent(_) => assert_eq!(found, None, "{}", key.path),
                Default::Required => {
                    let name = key.path.rsplit('.').next().unwrap();
                    let text = toml::to_string(&table).unwrap();
                    let without = text.lines().filter(|line| !line.starts_with(&format!("{name} =")));
                    let without = without.collect::<Vec<_>>().join("\n");
                    assert!(toml::from_str::<SceneDoc>(&without).is_err(), "{}: {without}", key.path);
                }
            }
        }
    }
}

/// A document in which a key has this value, and all other values are valid with it.
fn with(place: &Place, key: &Key, value: Value) -> Result<SceneDoc, String> {
    let mut table = minimal(place);
    put(&mut table, "film.width", 1.into());
    put(&mut table, "film.height", 1.into());
    put(&mut table, key.path, value);
    if key.path == "medium.extent" {
        put(&mut table, "medium.within", "everywhere".into());
    }
    // A conductor is given by its name, or by n and k.
    if place.kind == Some("conductor") {
        match key.path.rsplit('.').next() {
            Some("eta") => put(&mut table, "objects.*.material.k", Value::Float(1.0)),
            Some("k") => put(&mut table, "objects.*.material.eta", Value::Float(1.0)),
            _ => put(&mut table, "objects.*.material.preset", "gold".into()),
        }
    }
    let mut doc = read(&table)?;
    // A view names media of a scene with several.
    if place.path.contains(".media") {
        doc.media.push(MediumDoc { name: "one".into(), ..MediumDoc::default() });
        for medium in &mut doc.compare.views[0].media {
            medium.name = "one".into();
        }
    }
    // Views that are referred to by index have to exist.
    while doc.compare.views.len() < 7 && key.path.starts_with("compare.") {
        doc.compare.views.push(doc.view_overrides(0).unwrap());
    }
    match validate(&doc).into_iter().find(|problem| problem.path != "medium.phase.points") {
        None => Ok(doc),
        Some(problem) => Err(problem.to_string()),
    }
}

/// Numbers just inside and just outside a range.
fn probes(range: Range) -> ([Option<f32>; 2], [f32; 2]) {
    let [low, high] = [range.min as f32, range.max as f32];
    let inside = [
        if range.open[0] { Some(low.next_up().max(f32::MIN_POSITIVE)) } else { Some(low) },
        if range.open[1] { Some(high.next_down()) } else { Some(high) },
    ];
    let outside = [
        if range.open[0] { low } else { low.next_down() },
        if range.open[1] { high } else { high.next_up() },
    ];
    (inside, outside)
}

#[test]
fn ranges_are_what_validation_enforces() {
    let mut checked = 0;
    for place in tables() {
        for key in keys_of(&place) {
            let name = key.path;
            let fill: fn(f64, usize) -> Value =
                |x, n| if n == 0 { Value::Float(x) } else { Value::Array(vec![Value::Float(x); n]) };
            match key.value {
                Type::Number(range)
                | Type::Spectrum(range)
                | Type::Vector(_, range)
                | Type::Matrix(range) => {
                    let make = |x: f32| match key.value {
                        Type::Vector(n, _) => fill(x.into(), n),
                        Type::Matrix(_) => Value::Array(vec![fill(x.into(), 4); 3]),
                        _ => fill(x.into(), 0),
                    };
                    let (inside, outside) = probes(range);
                    for x in inside.into_iter().flatten() {
                        assert_eq!(with(&place, key, make(x)).err(), None, "{name} = {x}");
                    }
                    for x in outside.into_iter().chain([f32::NAN, f32::INFINITY]) {
                        let refused = with(&place, key, make(x));
                        let own = name.rsplit('.').next().unwrap();
                        assert!(
                            refused.as_ref().is_err_and(|e| e.contains(own)),
                            "{name} = {x}: {refused:?}"
                        );
                        checked += 1;
                    }
                }
                Type::Integer(range) | Type::IntegerOr(range, _) => {
                    for x in [range.min as i64, range.max as i64] {
                        assert_eq!(with(&place, key, x.into()).err(), None, "{name} = {x}");
                    }
                    for x in [range.min as i64 - 1, (range.max as i64).saturating_add(1)] {
                        // The largest seed is the largest number of the format.
                        let there_is_none = x == range.max as i64;
                        assert!(there_is_none || with(&place, key, x.into()).is_err(), "{name} = {x}");
                        checked += 1;
                    }
                }
                Type::Direction => {
                    for x in [0.0f32, f32::NAN, 1.1e18] {
                        assert!(with(&place, key, fill(x.into(), 3)).is_err(), "{name} = {x}");
                    }
                }
                _ => {}
            }
        }
    }
    assert!(checked > 200, "{checked}");
}

#[test]
fn every_choice_parses_and_there_are_no_others() {
    for place in tables() {
        for key in keys_of(&place) {
            // Keys by kind are checked in `every_key_has_one_row…`.
            let kinds = key.path.ends_with("kind");
            let values = key.values();
            for value in values.iter().filter(|_| !kinds) {
                let mut table = minimal(&place);
                put(&mut table, key.path, (*value).into());
                assert!(read(&table).is_ok(), "{} = {value}: {:?}", key.path, read(&table));
            }
            if let (Type::Choice(_), false) = (key.value, place.path.is_empty()) {
                let mut table = minimal(&place);
                put(&mut table, key.path, "bogus".into());
                let message = read(&table).unwrap_err();
                let values: BTreeSet<String> = values.into_iter().map(str::to_owned).collect();
                assert_eq!(expected(&message), values, "{}: {message}", key.path);
            }
        }
    }
}

#[test]
fn what_a_key_affects_is_where_it_shows() {
    for place in tables().into_iter().filter(|place| !place.path.starts_with("compare.views")) {
        for key in keys_of(&place).filter(|key| !key.path.ends_with("kind") && key.path != "majorant") {
            let [a, b] = samples(key).map(|value| {
                let mut table = minimal(&place);
                put(&mut table, key.path, value);
                read(&table).unwrap()
            });
            let name = key.path;
            assert_ne!(a, b, "{name}");
            let found = changed(&a, &b).unwrap();
            assert!(found.len() == 1 && found[0].path == name, "{name}: {found:?}");
            // Fields that determine samples, one by one.
            let media = |doc: &SceneDoc| {
                let mut media = doc.media.clone();
                media.iter_mut().for_each(|medium| medium.name.clear());
                media
            };
            let samples = (&a.camera, &a.film, media(&a), &a.lights, &a.objects, &a.estimator, a.render.seed)
                != (&b.camera, &b.film, media(&b), &b.lights, &b.objects, &b.estimator, b.render.seed);
            assert_eq!(samples, matches!(key.affects, Affects::Scene | Affects::Estimate), "{name}");
            assert_eq!(a.render_part() != b.render_part(), samples, "{name}");
            let frozen = (&a.camera, &a.film, &a.media, &a.lights, &a.objects)
                != (&b.camera, &b.film, &b.media, &b.lights, &b.objects);
            assert_eq!(a.scene_part() != b.scene_part(), frozen, "{name}");
            assert_eq!(a.target_part() != b.target_part(), key.affects == Affects::Scene, "{name}");
            assert_eq!(
                a.render.limits() != b.render.limits(),
                key.affects == Affects::Limits && !["render.threads", "compare.fairness"].contains(&name),
                "{name}"
            );
        }
    }
}

/// Every combination of settings that can bias, under every estimator: each bias that a registry entry
/// declares is covered by the rule of a key, and none is declared for an unbiased document.
#[test]
fn no_combination_of_settings_biases_a_reference() {
    let mut biased = 0;
    for entry in REGISTRY {
        for fault in [Fault::None].into_iter().chain(Fault::ALL) {
            for bookkeeping in [Bookkeeping::Rescaled, Bookkeeping::ApartF32] {
                for transmittance in TransmittanceKind::all() {
                    for when_exceeded in
                        [WhenExceeded::Weighted, WhenExceeded::Clamp, WhenExceeded::Progressive]
                    {
                        for (factor, grid) in [(0.5, true), (0.5, false), (1.0, true)] {
                            let mut doc = SceneDoc::default();
                            if grid {
                                doc.medium_mut().density = DensityDoc::Grid(std::default::Default::default());
                            }
                            doc.estimator.id = entry.id.into();
                            doc.estimator.fault = fault;
                            doc.estimator.bookkeeping = bookkeeping;
                            transmittance.entry().id.clone_into(&mut doc.estimator.transmittance);
                            doc.medium_mut().majorant.when_exceeded = when_exceeded;
                            doc.medium_mut().majorant.factor = factor;
                            let ruled = |doc: &SceneDoc| {
                                all().iter().any(|key| key.biases.is_some_and(|bias| (bias.holds)(doc)))
                            };
                            if entry.bias(&doc).is_some() {
                                biased += 1;
                                assert!(ruled(&doc), "{:?}: {doc:?}", entry.bias(&doc));
                            }
                            let unbiased = doc.unbiased();
                            assert_eq!((entry.bias(&unbiased), ruled(&unbiased)), (None, false), "{doc:?}");
                            assert_eq!(unbiased.target_part(), doc.target_part());
                        }
                    }
                }
            }
        }
    }
    assert!(biased > 500, "{biased}");
    let mut glowing = SceneDoc::default();
    glowing.medium_mut().emission = Some(EmissionDoc::default());
    glowing.estimator.id = "mitsuba2-volpath".into();
    let entry = estimator::find("mitsuba2-volpath").unwrap();
    assert!(entry.bias(&glowing).is_some() && (super::biases::ESTIMATOR.holds)(&glowing));
}

#[test]
fn what_cannot_bias_stays() {
    let mut doc = SceneDoc::default();
    doc.estimator.bookkeeping = Bookkeeping::Pairwise;
    doc.estimator.transmittance = "power-series".into();
    doc.medium_mut().majorant.factor = 2.5;
    assert_eq!(doc.unbiased(), doc);
}

#[test]
fn parts_and_changes_are_of_the_keys_that_differ() {
    let text = crate::io::embedded::find("first-light").unwrap().toml;
    let doc = crate::io::scene_file::parse(text, "first-light").unwrap();
    let part = doc.render_part();
    assert_eq!(
        (&part.camera, &part.film, part.medium(), &part.lights, &part.objects, &part.estimator),
        (&doc.camera, &doc.film, doc.medium(), &doc.lights, &doc.objects, &doc.estimator)
    );
    let paths = |edit: fn(&mut SceneDoc)| {
        let mut edited = doc.clone();
        edit(&mut edited);
        changed(&doc, &edited).unwrap().into_iter().map(|key| key.path).collect::<Vec<_>>()
    };
    assert!(paths(|_| ()).is_empty());
    assert_eq!(paths(|d| d.medium_mut().scale += 1.0), ["medium.scale"]);
    assert!(paths(|d| drop(d.lights.pop())).contains(&"lights.*.kind"));
    assert_eq!(paths(|d| d.render.threads = Some(3)), ["render.threads"]);
}

/// The README contains the current table.
#[test]
fn the_readme_has_every_key() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme = std::fs::read_to_string(folder.join("../README.md")).unwrap();
    let table = super::markdown(all());
    if !readme.contains(table.trim_end()) {
        let beside = std::env::temp_dir().join("majorant-keys.md");
        std::fs::write(&beside, &table).unwrap();
        panic!("the table of keys in README.md is not that of {}", beside.display());
    }
}

#[test]
fn rows_are_written_as_json() {
    let ids = |registry| if registry == super::Registry::Estimators { vec!["nee"] } else { vec!["relmse"] };
    for key in all() {
        let object = super::json(key, &ids);
        for field in ["path", "type", "range", "unit", "default", "label", "tip", "affects", "biases"] {
            assert!(object.get(field).is_some(), "{}: {field}", key.path);
        }
        assert!(!key.label.is_empty() && !key.tip.is_empty(), "{}", key.path);
        assert_eq!(object.get("values").is_some(), matches!(key.value, Type::Choice(_) | Type::Id(_)));
        assert_eq!(object.get("kind").is_some(), !key.kinds.is_empty());
    }
}
