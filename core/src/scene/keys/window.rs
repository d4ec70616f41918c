//! Keys of the window state, which the application reads.

use super::{Affects, Default, Key, Range, Type};
use Default::Is;

const fn key(path: &'static str, of: Type, default: Default, label: &'static str, tip: &'static str) -> Key {
    Key::new(path, of, default, label, tip).affects(Affects::View)
}

pub(super) const KEYS: &[Key] = &[
    key(
        "window.arrangement",
        Type::Choice(&["grid", "wipe", "flip", "difference"]),
        Is("\"grid\""),
        "Arrangement",
        "Arrangement of the views in the window",
    ),
    key(
        "window.pair",
        Type::Integers(2, Range::closed(0.0, u32::MAX as f64)),
        Is("[0, 1]"),
        "Pair",
        "The two views of a wipe or a difference",
    ),
    key(
        "window.layer",
        Type::Text,
        Is("\"picture\""),
        "Layer",
        "Layer shown for every view: `picture`, or the id of a map",
    ),
    key("window.own_zoom", Type::Bool, Is("false"), "Own zoom", "Separate zoom for every view"),
];
