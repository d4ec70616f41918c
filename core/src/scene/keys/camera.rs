//! Keys of the file, the camera and the film.

use super::{Affects, COORDINATE, Default, Key, Range, Type};
use crate::scene::validate::MAX_PIXELS;
use Default::{Is, Required};

const SIDE: Type = Type::Integer(Range::closed(1.0, MAX_PIXELS as f64));

pub(super) const KEYS: &[Key] = &[
    Key::new(
        "majorant",
        Type::Integer(Range::closed(1.0, 2.0)),
        Required,
        "Format",
        "Version of the file format",
    )
    .affects(Affects::View),
    Key::new("title", Type::Text, Is("\"\""), "Title", "A short name").affects(Affects::View),
    Key::new(
        "note",
        Type::Text,
        Is("\"\""),
        "Note",
        "Description of the scene: what to look for in the image",
    )
    .affects(Affects::View),
    Key::new(
        "camera.origin",
        Type::Vector(3, COORDINATE),
        Is("[0.0, 0.0, 3.0]"),
        "Camera position",
        "Position of the camera",
    ),
    Key::new(
        "camera.target",
        Type::Vector(3, COORDINATE),
        Is("[0.0, 0.0, 0.0]"),
        "Camera target",
        "Point that the camera faces, and the centre of orbiting",
    ),
    Key::new("camera.up", Type::Direction, Is("[0.0, 1.0, 0.0]"), "Up", "Up direction of the camera"),
    Key::new(
        "camera.fov_deg",
        Type::Number(Range::between(0.0, 179.0)),
        Is("35.0"),
        "Field of view",
        "Horizontal field of view",
    )
    .unit("°"),
    Key::new(
        "camera.mirror",
        Type::Bool,
        Is("false"),
        "Mirror",
        "Exchanges left and right, for scenes of renderers with a camera of other handedness",
    ),
    Key::new("film.width", SIDE, Is("960"), "Image width", "Columns of the image")
        .unit("px")
        .cure("an image needs at least one pixel"),
    Key::new("film.height", SIDE, Is("540"), "Image height", "Rows of the image")
        .unit("px")
        .cure("an image needs at least one pixel"),
];
