//! Keys of lights.

use super::{COORDINATE, Default, Key, LENGTH, Range, Type};
use Default::{Is, Required};

pub(super) const RADIANCE: Type = Type::Spectrum(Range::closed(0.0, 1e9));
pub(super) const RADIANCE_TIP: &str = "Le(λ) = scale · radiance(λ), per scene unit², steradian and nm";

pub(super) const KEYS: &[Key] = &[
    Key::new(
        "lights.*.kind",
        Type::Choice(&["rectangle", "sphere", "sun", "environment", "environment-map"]),
        Required,
        "Kind",
        "Kind of light",
    ),
    Key::new("lights.*.center", Type::Vector(3, COORDINATE), Required, "Centre", "Position of the centre")
        .kinds(&["rectangle", "sphere"]),
    Key::new(
        "lights.*.target",
        Type::Vector(3, COORDINATE),
        Required,
        "Target",
        "Point that the emitting side faces",
    )
    .kinds(&["rectangle"]),
    Key::new(
        "lights.*.up",
        Type::Direction,
        Is("[0.0, 1.0, 0.0]"),
        "Up",
        "Direction of the height, projected onto the rectangle",
    )
    .kinds(&["rectangle"]),
    Key::new("lights.*.size", Type::Vector(2, LENGTH), Required, "Size", "Width and height, scene units")
        .kinds(&["rectangle"]),
    Key::new("lights.*.radius", Type::Number(LENGTH), Required, "Radius", "Radius, scene units")
        .kinds(&["sphere"]),
    Key::new(
        "lights.*.toward",
        Type::Direction,
        Required,
        "Direction",
        "Direction from the scene to the sun",
    )
    .kinds(&["sun"]),
    Key::new(
        "lights.*.angular_diameter_deg",
        Type::Number(Range::closed(0.05, 170.0)),
        Is("0.53"),
        "Diameter",
        "Angular diameter: 0.53° as seen from the earth",
    )
    .unit("°")
    .cure("below 0.05 degrees scattered paths would not hit it")
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
        "An equirectangular EXR or HDR image, linear sRGB; its top row is +y",
    )
    .kinds(&["environment-map"]),
    Key::new(
        "lights.*.rotate_deg",
        Type::Number(COORDINATE),
        Is("0.0"),
        "Rotation",
        "Rotation of the image about the y axis",
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
        "Visible to camera rays; the light illuminates the scene either way",
    ),
    Key::new("lights.*.enabled", Type::Bool, Is("true"), "Enabled", "Whether the light is part of the scene"),
];
