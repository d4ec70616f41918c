//! Keys of objects.

use super::lights::{RADIANCE, RADIANCE_TIP};
use super::{COORDINATE, Default, Key, LENGTH, Range, SHARE, Type};
use Default::{Absent, Is, Required};

pub(super) const KEYS: &[Key] = &[
    Key::new(
        "objects.*.name",
        Type::Text,
        Is("\"\""),
        "Name",
        "Name by which a medium's `within` refers to the object",
    ),
    Key::new(
        "objects.*.kind",
        Type::Choice(&["ground", "box", "sphere", "disk", "rectangle", "mesh"]),
        Required,
        "Kind",
        "Kind of shape",
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
        "Normal of the upper side; a disk emits on it",
    )
    .kinds(&["ground", "disk"]),
    Key::new("objects.*.center", Type::Vector(3, COORDINATE), Required, "Centre", "Position of the centre")
        .kinds(&["box", "sphere", "disk", "rectangle"]),
    Key::new(
        "objects.*.target",
        Type::Vector(3, COORDINATE),
        Required,
        "Target",
        "Point that the emitting side faces",
    )
    .kinds(&["rectangle"]),
    Key::new(
        "objects.*.up",
        Type::Direction,
        Is("[0.0, 1.0, 0.0]"),
        "Up",
        "Direction of the height, projected onto the rectangle",
    )
    .kinds(&["rectangle"]),
    Key::new("objects.*.size", Type::Vector(3, LENGTH), Required, "Size", "Edge lengths").kinds(&["box"]),
    Key::new("objects.*.size", Type::Vector(2, LENGTH), Required, "Size", "Width and height, scene units")
        .kinds(&["rectangle"]),
    Key::new("objects.*.radius", Type::Number(LENGTH), Required, "Radius", "Radius, scene units")
        .kinds(&["sphere", "disk"]),
    Key::new(
        "objects.*.rotate_deg",
        Type::Vector(3, COORDINATE),
        Is("[0.0, 0.0, 0.0]"),
        "Rotation",
        "Rotation about x, then y, then z",
    )
    .unit("°")
    .kinds(&["box"]),
    Key::new(
        "objects.*.file",
        Type::File,
        Required,
        "Mesh",
        "OBJ, PLY (ASCII or binary) or glTF (.gltf, .glb); relative to the scene file",
    )
    .kinds(&["mesh"]),
    Key::new(
        "objects.*.placement.fit",
        Type::Number(LENGTH),
        Absent("as stored in the file"),
        "Fit",
        "Centres the mesh on the origin and scales its longest side to this length",
    ),
    Key::new(
        "objects.*.placement.scale",
        Type::Vector(3, COORDINATE),
        Is("[1.0, 1.0, 1.0]"),
        "Scale",
        "Scale along the axes of the mesh",
    ),
    Key::new(
        "objects.*.placement.rotate_deg",
        Type::Vector(3, COORDINATE),
        Is("[0.0, 0.0, 0.0]"),
        "Rotate",
        "Rotation about x, then y, then z",
    )
    .unit("°"),
    Key::new(
        "objects.*.placement.translate",
        Type::Vector(3, COORDINATE),
        Is("[0.0, 0.0, 0.0]"),
        "Translate",
        "Translation, scene units",
    ),
    Key::new(
        "objects.*.placement.matrix",
        Type::Matrix(COORDINATE),
        Absent("by scale, rotation and translation"),
        "Matrix",
        "Three rows of a world-from-object matrix, in place of scale, rotation and translation",
    ),
    Key::new(
        "objects.*.material.kind",
        Type::Choice(&["diffuse", "mirror", "conductor", "dielectric", "thin-dielectric", "interface"]),
        Is("\"diffuse\""),
        "Material",
        "How the surface scatters light; an interface lets it pass unchanged",
    ),
    Key::new(
        "objects.*.material.albedo",
        Type::Spectrum(SHARE),
        Is("0.5"),
        "Albedo",
        "Fraction of incident light that is reflected, 0 to 1",
    )
    .kinds(&["diffuse"]),
    Key::new(
        "objects.*.material.reflectance",
        Type::Spectrum(SHARE),
        Is("1.0"),
        "Reflectance",
        "Fraction of incident light that is reflected, 0 to 1",
    )
    .kinds(&["mirror"]),
    Key::new(
        "objects.*.material.preset",
        Type::Choice(&["aluminium", "copper", "gold", "silver"]),
        Absent("given by `eta` and `k`"),
        "Metal",
        "Refractive index of a metal, in place of `eta` and `k`",
    )
    .kinds(&["conductor"]),
    Key::new(
        "objects.*.material.eta",
        Type::Spectrum(Range::closed(0.0, 100.0)),
        Absent("given by the preset"),
        "n",
        "Real part of the refractive index n + i k",
    )
    .kinds(&["conductor"]),
    Key::new(
        "objects.*.material.k",
        Type::Spectrum(Range::closed(0.0, 100.0)),
        Absent("given by the preset"),
        "k",
        "Imaginary part of the refractive index n + i k",
    )
    .kinds(&["conductor"]),
    Key::new(
        "objects.*.material.ior",
        Type::Spectrum(Range::closed(1.0, 4.0)),
        Is("1.5"),
        "Index",
        "Refractive index: a number, nm:value points, or { cauchy = [A, B] } for A + B/λ², λ in micrometres",
    )
    .kinds(&["dielectric", "thin-dielectric"]),
    Key::new(
        "objects.*.material.roughness",
        Type::Number(SHARE),
        Is("0.0"),
        "Roughness",
        "Width α of the GGX distribution of microfacets; below 0.001 the surface is smooth",
    )
    .kinds(&["conductor", "dielectric"]),
    Key::new(
        "objects.*.priority",
        Type::Integer(Range::closed(-1000.0, 1000.0)),
        Is("0"),
        "Priority",
        "Rank among dielectrics: where two overlap, only that of higher priority is there",
    ),
    Key::new("objects.*.emission.radiance", RADIANCE, Required, "Radiance", RADIANCE_TIP),
    Key::new(
        "objects.*.emission.scale",
        Type::Number(Range::closed(0.0, 1e9)),
        Is("1.0"),
        "Scale",
        "Multiplies the radiance",
    ),
    Key::new(
        "objects.*.emission.visible",
        Type::Bool,
        Is("true"),
        "Visible",
        "Visible to camera rays; the surface illuminates the scene either way",
    ),
    Key::new(
        "objects.*.enabled",
        Type::Bool,
        Is("true"),
        "Enabled",
        "Whether the surface is part of the scene; media within the object keep their region",
    ),
];
