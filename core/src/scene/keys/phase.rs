//! Keys of the phase function; the numbers of each kind are those of [`PhaseDoc::parameters`].

use super::{Default, Key, Range, Type, named};
use crate::phase::{Parameter, PhaseDoc};
use Default::{Is, Required};

const KINDS: &[&str] =
    &["isotropic", "henyey-greenstein", "two-lobe", "rayleigh", "draine", "mie", "tabulated"];
const TABULATED: &[&str] = &["tabulated"];

const OTHERS: [Key; 3] = [
    Key::new(
        "medium.phase.angle",
        Type::Choice(&["cosine", "degrees"]),
        Is("\"cosine\""),
        "Angle",
        "Quantity in the first column of the points: cosine or angle",
    )
    .kinds(TABULATED),
    Key::new(
        "medium.phase.points",
        Type::Pairs,
        Is("[]"),
        "Points",
        "Pairs of angle and value, in increasing order of angle",
    )
    .kinds(TABULATED),
    Key::new(
        "medium.phase.file",
        Type::File,
        Is("\"\""),
        "File",
        "Text file of the points, relative to the scene file; replaces `points`",
    )
    .kinds(TABULATED),
];

/// Returns the key of a phase-function parameter.
#[must_use]
pub fn key_of(phase: &PhaseDoc, parameter: &Parameter) -> Option<&'static Key> {
    let place = PhaseDoc::templates().iter().position(|template| template.kind() == phase.kind())?;
    super::find(&format!("medium.phase.{}", parameter.key), Some(KINDS.get(place)?))
}

pub(super) fn keys() -> Vec<Key> {
    let kind = Key::new(
        "medium.phase.kind",
        Type::Choice(KINDS),
        Is("\"isotropic\""),
        "Phase function",
        "Angular distribution of scattered light",
    );
    let mut keys = vec![kind];
    for (template, kind) in PhaseDoc::templates().iter().zip(KINDS.chunks(1)) {
        keys.extend(template.parameters().into_iter().map(|(parameter, _)| {
            let path = named(format!("medium.phase.{}", parameter.key));
            let [low, high] = parameter.range.map(f64::from);
            let value = Type::Number(Range::closed(low, high));
            Key::new(path, value, Required, parameter.label, parameter.about).kinds(kind).unit(parameter.unit)
        }));
    }
    keys.extend(OTHERS);
    keys
}
