//! Keys of the medium, but for its phase function.

use super::biases::{CLAMPED, FACTOR};
use super::{Affects, COORDINATE, Default, Key, LENGTH, Range, SHARE, Type};
use crate::medium::MAX_MAJORANT_CELLS;
use crate::scene::MEAN_FREE_PATHS;
use Default::{Absent, Is, Required};

const COEFFICIENT: Type = Type::Spectrum(Range::closed(0.0, 1e6));
const GRIDS: &[&str] = &["grid", "rgb-grid"];
const FILE_TIP: &str = "OpenVDB, .npy, Mitsuba .vol or .raw; relative to the scene file";
const GRID_TIP: &str = "Which of the file's grids is used";
const BY_DEFAULT: Default = Absent("`density`, else the first that is readable");

pub(super) const KEYS: &[Key] = &[
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
        "α(λ) = σs / σt: the share of extinguished light that is scattered, not absorbed",
    ),
    Key::new(
        "medium.coefficients.kind",
        Type::Choice(&["absorption-scattering", "mean-free-path-colour"]),
        Absent("by `extinction` and `albedo`"),
        "Coefficients",
        "How the coefficients are given, in place of extinction and albedo",
    ),
    Key::new(
        "medium.coefficients.absorption",
        COEFFICIENT,
        Required,
        "Absorption",
        "Absorption coefficient of density 1, per scene unit",
    )
    .kinds(&["absorption-scattering"]),
    Key::new(
        "medium.coefficients.scattering",
        COEFFICIENT,
        Required,
        "Scattering",
        "Scattering coefficient of density 1, per scene unit",
    )
    .kinds(&["absorption-scattering"]),
    Key::new(
        "medium.coefficients.mean_free_path",
        Type::Spectrum(Range::closed(MEAN_FREE_PATHS[0] as f64, MEAN_FREE_PATHS[1] as f64)),
        Required,
        "Mean free path",
        "Mean distance between collisions in density 1, scene units",
    )
    .kinds(&["mean-free-path-colour"]),
    Key::new(
        "medium.coefficients.colour",
        Type::Spectrum(SHARE),
        Required,
        "Colour of the medium",
        "Share of diffuse light that a half-space of the medium reflects",
    )
    .kinds(&["mean-free-path-colour"]),
    Key::new(
        "medium.albedo_grid.file",
        Type::File,
        Absent("no grid of albedo"),
        "Albedo file",
        "An RGB grid over the same box that replaces the albedo",
    ),
    Key::new("medium.albedo_grid.grid", Type::Text, BY_DEFAULT, "Albedo grid", GRID_TIP),
    Key::new(
        "medium.density.kind",
        Type::Choice(&["uniform", "grid", "rgb-grid"]),
        Is("\"uniform\""),
        "Source",
        "Where the density comes from",
    ),
    Key::new("medium.density.file", Type::File, Required, "File", FILE_TIP).kinds(GRIDS),
    Key::new("medium.density.grid", Type::Text, BY_DEFAULT, "Grid", GRID_TIP).kinds(GRIDS),
    Key::new(
        "medium.precision",
        Type::Choice(&["f32", "f16", "u8"]),
        Is("\"f32\""),
        "Precision",
        "Bits of a value in memory",
    ),
    Key::new(
        "medium.interpolation",
        Type::Choice(&["trilinear", "stochastic"]),
        Is("\"trilinear\""),
        "Between",
        "How a value between samples is looked up",
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
        "Stretches the box along its axes",
    ),
    Key::new(
        "medium.placement.rotate_deg",
        Type::Vector(3, COORDINATE),
        Is("[0.0, 0.0, 0.0]"),
        "Rotate",
        "Turns about x, then y, then z",
    )
    .unit("°"),
    Key::new(
        "medium.placement.translate",
        Type::Vector(3, COORDINATE),
        Is("[0.0, 0.0, 0.0]"),
        "Translate",
        "Moves the box, scene units",
    ),
    Key::new(
        "medium.placement.matrix",
        Type::Matrix(COORDINATE),
        Absent("by scale, rotation and translation"),
        "Matrix",
        "Three rows of a world-from-object matrix, instead of scale, rotation and translation",
    ),
    Key::new(
        "medium.majorant.factor",
        Type::Number(Range::closed(0.01, 1000.0)),
        Is("1.0"),
        "Factor",
        "μ(x, λ) = factor · the largest σt(λ) in the cell around x. 1 is tight; above it null collisions are added",
    )
    .affects(Affects::Estimate)
    .biases(&FACTOR)
    .cure("1 is tight"),
    Key::new(
        "medium.majorant.shared",
        Type::Bool,
        Is("false"),
        "Shared",
        "Every wavelength gets the largest one's majorant",
    )
    .affects(Affects::Estimate),
    Key::new(
        "medium.majorant.when_exceeded",
        Type::Choice(&["weighted", "clamp", "progressive"]),
        Is("\"weighted\""),
        "Where exceeded",
        "What happens where σt is larger than μ",
    )
    .affects(Affects::Estimate)
    .biases(&CLAMPED),
    Key::new(
        "medium.majorant.resolution",
        Type::Integer(Range::closed(1.0, MAX_MAJORANT_CELLS as f64)),
        Absent("the cheapest to fly through"),
        "Resolution",
        "Cells per axis of the grid of local majorants, 1 to 128. 1 is one majorant for the whole box; finer ones are \
         tighter and cost more steps. Automatic: the cheapest to fly through",
    )
    .affects(Affects::Estimate),
    Key::new(
        "medium.emission.temperature.file",
        Type::File,
        Absent("the same everywhere"),
        "Temperature file",
        FILE_TIP,
    ),
    Key::new("medium.emission.temperature.grid", Type::Text, BY_DEFAULT, "Temperature grid", GRID_TIP),
    Key::new(
        "medium.emission.kelvin",
        Type::Number(Range::above(0.0, 1e9)),
        Is("3000.0"),
        "Kelvin",
        "How hot it is, or the kelvins of a temperature of 1 in the grid",
    )
    .unit("K"),
    Key::new(
        "medium.emission.scale",
        Type::Number(Range::closed(0.0, 1e9)),
        Is("1.0"),
        "Scale",
        "Multiplies the radiance, which is 1 for 3000 K at 560 nm",
    ),
];
