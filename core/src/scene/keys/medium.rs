//! Keys of the medium, except for its phase function.

use super::biases::{CLAMPED, FACTOR};
use super::{Affects, COORDINATE, Default, Key, LENGTH, Range, SHARE, Type};
use crate::medium::MAX_MAJORANT_CELLS;
use crate::scene::MEAN_FREE_PATHS;
use Default::{Absent, Is, Required};

const COEFFICIENT: Type = Type::Spectrum(Range::closed(0.0, 1e6));
const GRIDS: &[&str] = &["grid", "rgb-grid"];
const FILE_TIP: &str = "OpenVDB, .npy, Mitsuba .vol or .raw; relative to the scene file";
const GRID_TIP: &str = "Name of the grid in the file";
const BY_DEFAULT: Default = Absent("`density`, else the first readable grid");

pub(super) const KEYS: &[Key] = &[
    Key::new(
        "medium.name",
        Type::Text,
        Is("\"medium\""),
        "Name",
        "Name of the medium, unique in the scene; `media.NAME.KEY` addresses a key of it",
    )
    .affects(Affects::View),
    Key::new("medium.enabled", Type::Bool, Is("true"), "Enabled", "Whether the medium is part of the scene"),
    Key::new(
        "medium.within",
        Type::Text,
        Is("\"grid\""),
        "Within",
        "Region that the medium fills: `grid` for the box of its grid (a unit cube for a uniform density), \
         `everywhere`, or the name of a closed object",
    ),
    Key::new(
        "medium.extent",
        Type::Number(LENGTH),
        Absent("to infinity"),
        "Extent",
        "Radius about the origin to which a medium within `everywhere` reaches, scene units",
    ),
    Key::new(
        "medium.scale",
        Type::Number(Range::closed(0.0, 1e6)),
        Is("1.0"),
        "Scale",
        "Multiplies the density: σt(x, λ) = scale · density(x) · extinction(λ), per scene unit",
    ),
    Key::new(
        "medium.extinction",
        COEFFICIENT,
        Is("4.0"),
        "Extinction",
        "σt(x, λ) = scale · density(x) · extinction(λ), per scene unit",
    ),
    Key::new(
        "medium.albedo",
        Type::Spectrum(SHARE),
        Is("0.9"),
        "Albedo",
        "Single-scattering albedo α(λ) = σs / σt, 0 to 1",
    ),
    Key::new(
        "medium.coefficients.kind",
        Type::Choice(&["absorption-scattering", "mean-free-path-colour"]),
        Absent("by `extinction` and `albedo`"),
        "Coefficients",
        "Parametrisation of the coefficients, in place of extinction and albedo",
    ),
    Key::new(
        "medium.coefficients.absorption",
        COEFFICIENT,
        Required,
        "Absorption",
        "Absorption coefficient σa(λ) at density 1, per scene unit",
    )
    .kinds(&["absorption-scattering"]),
    Key::new(
        "medium.coefficients.scattering",
        COEFFICIENT,
        Required,
        "Scattering",
        "Scattering coefficient σs(λ) at density 1, per scene unit",
    )
    .kinds(&["absorption-scattering"]),
    Key::new(
        "medium.coefficients.mean_free_path",
        Type::Spectrum(Range::closed(MEAN_FREE_PATHS[0] as f64, MEAN_FREE_PATHS[1] as f64)),
        Required,
        "Mean free path",
        "Mean free path 1 / σt(λ) at density 1, scene units",
    )
    .kinds(&["mean-free-path-colour"]),
    Key::new(
        "medium.coefficients.colour",
        Type::Spectrum(SHARE),
        Required,
        "Colour of the medium",
        "Diffuse reflectance of a half-space of the medium",
    )
    .kinds(&["mean-free-path-colour"]),
    Key::new(
        "medium.albedo_grid.file",
        Type::File,
        Absent("no albedo grid"),
        "Albedo file",
        "RGB grid of the albedo over the same box; replaces `albedo`",
    ),
    Key::new("medium.albedo_grid.grid", Type::Text, BY_DEFAULT, "Albedo grid", GRID_TIP),
    Key::new(
        "medium.density.kind",
        Type::Choice(&["uniform", "grid", "rgb-grid"]),
        Is("\"uniform\""),
        "Source",
        "Source of the density",
    ),
    Key::new("medium.density.file", Type::File, Required, "File", FILE_TIP).kinds(GRIDS),
    Key::new("medium.density.grid", Type::Text, BY_DEFAULT, "Grid", GRID_TIP).kinds(GRIDS),
    Key::new(
        "medium.precision",
        Type::Choice(&["f32", "f16", "u8"]),
        Is("\"f32\""),
        "Precision",
        "Storage format of grid values in memory",
    ),
    Key::new(
        "medium.interpolation",
        Type::Choice(&["trilinear", "stochastic"]),
        Is("\"trilinear\""),
        "Interpolation",
        "Interpolation between grid samples",
    )
    .affects(Affects::Estimate),
    Key::new(
        "medium.placement.fit",
        Type::Number(LENGTH),
        Absent("as stored in the file"),
        "Fit",
        "Centres the box on the origin and scales its longest side to this length",
    ),
    Key::new(
        "medium.placement.scale",
        Type::Vector(3, COORDINATE),
        Is("[1.0, 1.0, 1.0]"),
        "Scale",
        "Scale along the axes of the box",
    ),
    Key::new(
        "medium.placement.rotate_deg",
        Type::Vector(3, COORDINATE),
        Is("[0.0, 0.0, 0.0]"),
        "Rotate",
        "Rotation about x, then y, then z",
    )
    .unit("°"),
    Key::new(
        "medium.placement.translate",
        Type::Vector(3, COORDINATE),
        Is("[0.0, 0.0, 0.0]"),
        "Translate",
        "Translation, scene units",
    ),
    Key::new(
        "medium.placement.matrix",
        Type::Matrix(COORDINATE),
        Absent("by scale, rotation and translation"),
        "Matrix",
        "Three rows of a world-from-object matrix, in place of scale, rotation and translation",
    ),
    Key::new(
        "medium.majorant.factor",
        Type::Number(Range::closed(0.01, 1000.0)),
        Is("1.0"),
        "Factor",
        "Majorant μ(x, λ) = factor · max σt(λ) in the cell around x. 1 is tight; larger values add null collisions",
    )
    .affects(Affects::Estimate)
    .biases(&FACTOR)
    .cure("1 is tight"),
    Key::new(
        "medium.majorant.shared",
        Type::Bool,
        Is("false"),
        "Shared",
        "All wavelengths share the largest majorant",
    )
    .affects(Affects::Estimate),
    Key::new(
        "medium.majorant.when_exceeded",
        Type::Choice(&["weighted", "clamp", "progressive"]),
        Is("\"weighted\""),
        "Where exceeded",
        "Treatment of points where σt exceeds the majorant μ",
    )
    .affects(Affects::Estimate)
    .biases(&CLAMPED),
    Key::new(
        "medium.majorant.resolution",
        Type::Integer(Range::closed(1.0, MAX_MAJORANT_CELLS as f64)),
        Absent("the cheapest resolution for free flights"),
        "Resolution",
        "Cells per axis of the grid of local majorants, 1 to 128. 1 is a global majorant; finer grids are tighter \
         and cost more steps. Automatic: the cheapest resolution for free flights",
    )
    .affects(Affects::Estimate),
    Key::new(
        "medium.emission.temperature.file",
        Type::File,
        Absent("constant temperature"),
        "Temperature file",
        FILE_TIP,
    ),
    Key::new("medium.emission.temperature.grid", Type::Text, BY_DEFAULT, "Temperature grid", GRID_TIP),
    Key::new(
        "medium.emission.kelvin",
        Type::Number(Range::above(0.0, 1e9)),
        Is("3000.0"),
        "Kelvin",
        "Temperature, or kelvins per unit of the temperature grid",
    )
    .unit("K"),
    Key::new(
        "medium.emission.scale",
        Type::Number(Range::closed(0.0, 1e9)),
        Is("1.0"),
        "Scale",
        "Multiplies the emitted radiance, which is 1 for 3000 K at 560 nm",
    ),
];
