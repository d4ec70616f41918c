//! Keys of the estimator.

use super::biases::{ESTIMATOR, FAULT, MARCHED, OVERFLOW};
use super::{Affects, Default, Key, Range, Registry, Type};
use Default::{Absent, Is};

const COUNT: Range = Range::closed(0.0, u32::MAX as f64);

/// Key that affects how the image is estimated.
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
        "Estimator of light transport: an id listed by `majorant estimators`",
    )
    .biases(&ESTIMATOR),
    axis(
        "estimator.mode",
        Type::Choice(&["spectral", "rgb"]),
        "\"spectral\"",
        "Components",
        "Components of a path: sampled wavelengths or RGB channels",
    )
    .affects(Affects::Scene),
    axis(
        "estimator.sampler",
        Type::Choice(&["independent", "lattice", "sobol"]),
        "\"independent\"",
        "Samples",
        "Sampler: independent random numbers or a low-discrepancy sequence per pixel",
    ),
    axis(
        "estimator.wavelengths",
        Type::Choice(&["sensor", "uniform"]),
        "\"sensor\"",
        "Wavelengths",
        "Distribution of the hero wavelength; the others are rotations of it",
    ),
    axis(
        "estimator.distances",
        Type::Choice(&["delta", "weighted-delta", "decomposition"]),
        "\"delta\"",
        "Distances",
        "Sampling of the distance to the next event",
    ),
    axis(
        "estimator.directions",
        Type::Choice(&["phase", "towards-lights", "product"]),
        "\"phase\"",
        "Directions",
        "Distribution of directions sampled in the medium",
    ),
    axis(
        "estimator.absorption",
        Type::Choice(&["analogue", "weighted", "roulette"]),
        "\"weighted\"",
        "Absorption",
        "Treatment of absorption at a collision",
    ),
    axis(
        "estimator.heuristics.components",
        Type::Choice(&["balance", "power", "maximum", "hero-only"]),
        "\"balance\"",
        "Heroes",
        "MIS heuristic among the components that could have been the hero",
    ),
    axis(
        "estimator.heuristics.techniques",
        Type::Choice(&["balance", "power", "maximum", "hero-only"]),
        "\"balance\"",
        "Techniques",
        "MIS heuristic between unidirectional sampling and next-event estimation; `hero-only` is not allowed here",
    ),
    axis(
        "estimator.bookkeeping",
        Type::Choice(&["rescaled", "apart-f32", "apart-f64", "pairwise"]),
        "\"rescaled\"",
        "Weights",
        "Representation of a path's contribution f and densities p",
    )
    .biases(&OVERFLOW),
    axis(
        "estimator.tracking",
        Type::Choice(&["maximum", "average", "history"]),
        "\"history\"",
        "Tracking",
        "Statistic of the coefficients that sets the event probabilities of spectral tracking",
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
        "Known bug of another renderer, injected into Uni+NEE MIS to demonstrate its effect",
    )
    .biases(&FAULT),
    axis(
        "estimator.light_walk",
        Type::Choice(&["fused", "separate"]),
        "\"fused\"",
        "Light walk",
        "Walk that samples the unidirectional contribution",
    ),
    axis(
        "estimator.lights",
        Type::Choice(&["uniform", "power", "contribution"]),
        "\"uniform\"",
        "Lights",
        "Selection of the light for next-event estimation",
    ),
    axis(
        "estimator.light_sampling",
        Type::Choice(&["emitter", "product"]),
        "\"emitter\"",
        "Aim",
        "Sampling of the direction towards the selected light",
    ),
    axis(
        "estimator.transmittance",
        Type::Id(Registry::Transmittance),
        "\"ratio-hero\"",
        "Transmittance",
        "Transmittance estimator of connections to a light",
    )
    .biases(&MARCHED),
    Key::new(
        "estimator.max_depth",
        Type::Integer(Range::closed(1.0, u32::MAX as f64)),
        Absent("unlimited"),
        "Max depth",
        "Maximum number of path segments: 1 is emission only, 2 is single scattering",
    )
    .cure("leave it out for no limit"),
    axis(
        "estimator.roulette_depth",
        Type::IntegerOr(COUNT, "never"),
        "16",
        "Roulette from",
        "Russian roulette, by throughput, after this many scattering events; unbiased",
    ),
];
