//! Keys of lights and objects.

use super::{COORDINATE, Default, Key, LENGTH, Range, SHARE, Type};
use Default::{Is, Required};

const RADIANCE: Type = Type::Spectrum(Range::closed(0.0, 1e9));
const RADIANCE_TIP: &str = "Le(λ) = scale · radiance(λ), per scene unit², steradian and nm";

pub(super) const KEYS: &[Key] = &[
    Key::new(
        "lights.*.kind",
        Type::Choice(&["rectangle", "sphere", "sun", "environment", "environment-map"]),
        Required,
        "Kind",
        "What kind of light it is",
    ),
    Key::new("lights.*.center", Type::Vector(3, COORDINATE), Required, "Centre", "Where it is")
        .kinds(&["rectangle", "sphere"]),
    Key::new(
        "lights.*.target",
        Type::Vector(3, COORDINATE),
        Required,
        "Target",
        "The point that its lit side faces",
    )
    .kinds(&["rectangle"]),
    Key::new(
        "lights.*.up",
        Type::Direction,
        Is("[0.0, 1.0, 0.0]"),
        "Up",
        "Direction that its height leans to",
    )
    .kinds(&["rectangle"]),
    Key::new("lights.*.size", Type::Vector(2, LENGTH), Required, "Size", "Width and height, scene units")
        .kinds(&["rectangle"]),
    Key::new("lights.*.radius", Type::Number(LENGTH), Required, "Radius", "In scene units")
        .kinds(&["sphere"]),
    Key::new("lights.*.toward", Type::Direction, Required, "Direction", "From the scene to the sun")
        .kinds(&["sun"]),
    Key::new(
        "lights.*.angular_diameter_deg",
        Type::Number(Range::closed(0.05, 170.0)),
        Is("0.53"),
        "Diameter",
        "Apparent diameter: 0.53° from the earth",
    )
    .unit("°")
    .cure("from 0.05 degrees on a scattered path can meet it")
    .kinds(&["sun"]),
    Key::new("lights.*.radiance", RADIANCE, Is("1.0"), "Radiance", RADIANCE_TIP).kinds(&[
        "rectangle",
        "sphere",
        "environment",
    ]),
    Key::new(
        "lights.*.irradiance",
        RADIANCE,
        Is("1.0"),
        "Irradiance",
        "E(λ) = scale · irradiance(λ) on a surface that faces the sun",
    )
    .kinds(&["sun"]),
    Key::new(
        "lights.*.file",
        Type::File,
        Required,
        "Picture",
        "An equirectangular EXR or HDR picture, linear sRGB; its top row is +y",
    )
    .kinds(&["environment-map"]),
    Key::new(
        "lights.*.rotate_deg",
        Type::Number(COORDINATE),
        Is("0.0"),
        "Rotation",
        "Turns the picture about the y axis",
    )
    .unit("°")
    .kinds(&["environment-map"]),
    Key::new(
        "lights.*.scale",
        Type::Number(Range::closed(0.0, 1e9)),
        Is("1.0"),
        "Scale",
        "Multiplies the radiance or irradiance",
    ),
    Key::new(
        "lights.*.visible",
        Type::Bool,
        Is("true"),
        "Visible",
        "Whether the camera sees it directly; it lights the medium either way",
    ),
    Key::new(
        "objects.*.kind",
        Type::Choice(&["ground", "box"]),
        Required,
        "Kind",
        "What kind of surface it is",
    ),
    Key::new(
        "objects.*.point",
        Type::Vector(3, COORDINATE),
        Is("[0.0, 0.0, 0.0]"),
        "Point",
        "A point on the plane",
    )
    .kinds(&["ground"]),
    Key::new(
        "objects.*.normal",
        Type::Direction,
        Is("[0.0, 1.0, 0.0]"),
        "Normal",
        "The direction that its top faces",
    )
    .kinds(&["ground"]),
    Key::new("objects.*.center", Type::Vector(3, COORDINATE), Required, "Centre", "Where it is")
        .kinds(&["box"]),
    Key::new("objects.*.size", Type::Vector(3, LENGTH), Required, "Size", "Edge lengths").kinds(&["box"]),
    Key::new(
        "objects.*.rotate_deg",
        Type::Vector(3, COORDINATE),
        Is("[0.0, 0.0, 0.0]"),
        "Rotation",
        "Turns about x, then y, then z",
    )
    .unit("°")
    .kinds(&["box"]),
    Key::new(
        "objects.*.albedo",
        Type::Spectrum(SHARE),
        Is("0.5"),
        "Albedo",
        "Reflected share of the light that arrives, 0 to 1",
    ),
];
