//! Keys of the estimator.

use super::biases::{ESTIMATOR, FAULT, MARCHED, OVERFLOW};
use super::{Affects, Default, Key, Range, Registry, Type};
use Default::{Absent, Is};

const COUNT: Range = Range::closed(0.0, u32::MAX as f64);

/// A key that affects how the image is estimated.
const fn axis(
    path: &'static str,
    value: Type,
    default: &'static str,
    label: &'static str,
    tip: &'static str,
) -> Key {
    Key::new(path, value, Is(default), label, tip).affects(Affects::Estimate)
}

pub(super) const KEYS: &[Key] = &[
    axis(
        "estimator.id",
        Type::Id(Registry::Estimators),
        "\"uni-nee-mis\"",
        "Estimator",
        "How light transport is estimated: an id that `majorant estimators` lists",
    )
    .biases(&ESTIMATOR),
    axis(
        "estimator.mode",
        Type::Choice(&["spectral", "rgb"]),
        "\"spectral\"",
        "Components",
        "What a path carries",
    )
    .affects(Affects::Scene),
    axis(
        "estimator.sampler",
        Type::Choice(&["independent", "lattice", "sobol"]),
        "\"independent\"",
        "Samples",
        "How the samples of a pixel relate to each other",
    ),
    axis(
        "estimator.wavelengths",
        Type::Choice(&["sensor", "uniform"]),
        "\"sensor\"",
        "Wavelengths",
        "How the hero's wavelength is drawn; the others are rotations of it",
    ),
    axis(
        "estimator.distances",
        Type::Choice(&["delta", "weighted-delta", "decomposition"]),
        "\"delta\"",
        "Distances",
        "How the distance to the next event is drawn",
    ),
    axis(
        "estimator.directions",
        Type::Choice(&["phase", "towards-lights", "product"]),
        "\"phase\"",
        "Directions",
        "What directions in the medium are drawn from",
    ),
    axis(
        "estimator.absorption",
        Type::Choice(&["analogue", "weighted", "roulette"]),
        "\"weighted\"",
        "Absorption",
        "What happens at a collision that may absorb",
    ),
    axis(
        "estimator.heuristics.components",
        Type::Choice(&["balance", "power", "maximum", "hero-only"]),
        "\"balance\"",
        "Heroes",
        "How the components that could have been the hero share a path",
    ),
    axis(
        "estimator.heuristics.techniques",
        Type::Choice(&["balance", "power", "maximum", "hero-only"]),
        "\"balance\"",
        "Techniques",
        "How unidirectional sampling and next-event estimation share a path; `hero-only` is refused here",
    ),
    axis(
        "estimator.bookkeeping",
        Type::Choice(&["rescaled", "apart-f32", "apart-f64", "pairwise"]),
        "\"rescaled\"",
        "Weights",
        "How a path's contribution f and densities p are kept",
    )
    .biases(&OVERFLOW),
    axis(
        "estimator.tracking",
        Type::Choice(&["maximum", "average", "history"]),
        "\"history\"",
        "Tracking",
        "What spectral tracking draws events by",
    ),
    axis(
        "estimator.fault",
        Type::Choice(&[
            "none",
            "hero-probability",
            "roulette-on-one-technique",
            "null-by-rounding",
            "phase-in-both",
            "null-cap",
        ]),
        "\"none\"",
        "Fault",
        "A mistake of another renderer, planted in Uni+NEE MIS to be found",
    )
    .biases(&FAULT),
    axis(
        "estimator.light_walk",
        Type::Choice(&["fused", "separate"]),
        "\"fused\"",
        "Light walk",
        "Which walk meets the light that unidirectional sampling adds",
    ),
    axis(
        "estimator.lights",
        Type::Choice(&["uniform", "power", "contribution"]),
        "\"uniform\"",
        "Lights",
        "Which light a connection goes to",
    ),
    axis(
        "estimator.light_sampling",
        Type::Choice(&["emitter", "product"]),
        "\"emitter\"",
        "Aim",
        "Where on a light a connection goes",
    ),
    axis(
        "estimator.transmittance",
        Type::Id(Registry::Transmittance),
        "\"ratio-hero\"",
        "Transmittance",
        "How connections estimate transmittance on their way to a light",
    )
    .biases(&MARCHED),
    Key::new(
        "estimator.max_depth",
        Type::Integer(Range::closed(1.0, u32::MAX as f64)),
        Absent("unlimited"),
        "Max depth",
        "Most segments of a path: 1 is emission only, 2 is single scattering",
    )
    .cure("leave it out for no limit"),
    axis(
        "estimator.roulette_depth",
        Type::IntegerOr(COUNT, "never"),
        "16",
        "Roulette from",
        "Ends faint paths at random after this many scatterings; unbiased",
    ),
];
