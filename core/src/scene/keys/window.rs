//! Keys of the window's state, which the application reads.

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
        "How the views share the window",
    ),
    key(
        "window.pair",
        Type::Integers(2, Range::closed(0.0, u32::MAX as f64)),
        Is("[0, 1]"),
        "Pair",
        "The two views of a wipe or difference",
    ),
    key(
        "window.layer",
        Type::Text,
        Is("\"picture\""),
        "Layer",
        "What is shown of every view: `picture`, or a map",
    ),
    key("window.own_zoom", Type::Bool, Is("false"), "Own zoom", "Whether every view has a zoom of its own"),
];
