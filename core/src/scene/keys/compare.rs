//! Keys of the comparison. The settings of further views repeat the rows of the scene's keys.

use super::{Affects, Default, Key, POSITIVE, Range, Registry, SAMPLES, Type, named};
use crate::scene::MAX_VIEWS;
use Default::{Absent, Is, Required};

const VIEW: Type = Type::Integer(Range::closed(0.0, (MAX_VIEWS - 1) as f64));
const RENDERED: &[&str] = &["render"];

const fn key(
    path: &'static str,
    value: Type,
    default: Default,
    label: &'static str,
    tip: &'static str,
) -> Key {
    Key::new(path, value, default, label, tip).affects(Affects::View)
}

pub(super) const KEYS: &[Key] = &[
    key(
        "compare.fairness",
        Type::Choice(&["time", "samples", "lookups"]),
        Is("\"time\""),
        "Fairness",
        "Quantity of which every view gets the same amount",
    )
    .affects(Affects::Limits),
    key(
        "compare.reference.kind",
        Type::Choice(&["none", "pooled", "view", "render", "file"]),
        Is("\"none\""),
        "Reference",
        "Reference that errors are measured against",
    ),
    key("compare.reference.view", VIEW, Required, "View", "View whose image is the reference, from 0")
        .kinds(&["view"]),
    key(
        "compare.reference.estimator",
        Type::Id(Registry::Estimators),
        Required,
        "Estimator",
        "Estimator that renders the reference",
    )
    .kinds(RENDERED),
    key(
        "compare.reference.spp",
        Type::Integer(SAMPLES),
        Absent("no limit"),
        "Stop at",
        "Samples per pixel of a rendered reference",
    )
    .unit("spp")
    .cure("leave it out for no limit")
    .kinds(RENDERED),
    key(
        "compare.reference.relative_error",
        Type::Number(POSITIVE),
        Absent("no limit"),
        "Error",
        "A rendered reference stops when its standard error is this fraction of the mean",
    )
    .cure("0.01 is one percent of the mean")
    .kinds(RENDERED),
    key("compare.reference.file", Type::File, Required, "File", "An EXR image, relative to the scene file")
        .kinds(&["file"]),
    key("compare.baseline", VIEW, Is("0"), "Baseline", "View that speed-ups are relative to, from 0"),
    key(
        "compare.measure",
        Type::Id(Registry::Measures),
        Is("\"relmse\""),
        "Measure",
        "Error measure of curves and tables",
    ),
    key(
        "compare.region",
        Type::Integers(4, Range::closed(0.0, u32::MAX as f64)),
        Absent("the whole image"),
        "Region",
        "Pixels that statistics are computed over: x0, y0, x1, y1, half open",
    )
    .unit("px"),
];

/// Sections of a view, with the corresponding sections of the scene.
const OWN: [(&str, &str); 7] = [
    ("estimator", "estimator"),
    ("majorant", "medium.majorant"),
    ("media.*.name", "medium.name"),
    ("media.*.majorant", "medium.majorant"),
    ("seed", "render.seed"),
    ("camera", "camera"),
    ("view", "view"),
];

/// Keys of views, derived from the scene's keys.
pub(super) fn of_views(scene: &[Key]) -> Vec<Key> {
    let mut keys = Vec::new();
    for (own, theirs) in OWN {
        for key in scene {
            let Some(rest) =
                key.path.strip_prefix(theirs).filter(|rest| rest.is_empty() || rest.starts_with('.'))
            else {
                continue;
            };
            keys.push(Key { path: named(format!("compare.views.*.{own}{rest}")), ..*key });
        }
    }
    keys
}
