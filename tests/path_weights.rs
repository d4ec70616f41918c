//! Tests of the path weights.
//!
//! The rescaled form is compared with plain products in double precision and with Miller's pairwise form, and
//! the weights sum to one over all techniques and heroes.

#[path = "path_weights/definition.rs"]
mod definition;

use definition::{Events, events};
use glam::Vec3;
use majorant_core::math::Sampler;
use majorant_core::medium::{Coefficients, MajorantSegment};
use majorant_core::scene::{Absorption, Heuristic, Heuristics};
use majorant_core::spectrum::Sampled;
use majorant_core::transport::DirectionSample;
use majorant_core::transport::{
    CancelToken, Collision, Event, PathWeights, Trace, WalkWeights, Weights, WeightsApart, WeightsPairwise,
};
use proptest::prelude::*;
use proptest::test_runner::{RngSeed, TestCaseError};

const BALANCE: Heuristics = Heuristics { components: Heuristic::Balance, techniques: Heuristic::Balance };

/// f/P, p_uni/P and p_nee/P of a path.
fn numbers<const N: usize>(path: &PathWeights<N>) -> [Sampled<N>; 3] {
    path.weight_record().values.map(|lanes| Sampled(std::array::from_fn(|i| lanes[i])))
}

/// Relative rounding error of a product of thirty factors in single precision.
const ROUNDING: f64 = 1e-4;

fn assert_near(what: &str, value: f32, expected: f64) -> Result<(), TestCaseError> {
    let near = (f64::from(value) - expected).abs() <= ROUNDING * expected.abs();
    prop_assert!(near, "{what}: {value} is not {expected}");
    Ok(())
}

fn mean<const N: usize>(f: impl FnMut(usize) -> f64) -> f64 {
    (0..N).map(f).sum::<f64>() / N as f64
}

/// Checks the value of every technique against its definition and the pairwise form.
fn equals_plain_products<W: Weights<N>, const N: usize>(events: &Events<N>) -> Result<(), TestCaseError> {
    let p = events.plain();
    let (walk, link) = (events.walk::<W>(), events.connection::<W>());
    let can_walk = p.uni[0] > 0.0;
    let can_connect = p.nee[0] > 0.0;
    let mean_uni = mean::<N>(|i| p.uni[i]);
    let mean_nee = mean::<N>(|i| p.nee[i]);
    for j in 0..N {
        let by_uni = mean::<N>(|i| p.uni_over_f[i][j]);
        let by_nee = mean::<N>(|i| p.nee_over_f[i][j]);
        let by_both = mean::<N>(|i| p.uni_over_f[i][j] + p.nee_over_f[i][j]);
        let check = |what, value: Sampled<N>, mean_density, pairwise: f64| {
            assert_near(what, value[j], p.f[j] / mean_density)?;
            // 0/0 has no value: a component with zero contribution is left out of the pairwise form.
            if p.f[j] == 0.0 { Ok(()) } else { assert_near("pairwise", value[j], 1.0 / pairwise) }
        };
        if can_walk {
            check("uni", walk.unidirectional(Sampled::ONE, BALANCE), mean_uni, by_uni)?;
            check(
                "balanced walk",
                walk.combined(Sampled::ONE, events.light, BALANCE),
                mean_uni + mean_nee,
                by_both,
            )?;
        }
        if can_connect {
            check("nee", link.connected_only(Sampled::ONE, BALANCE), mean_nee, by_nee)?;
            check(
                "balanced link",
                link.connected_combined(Sampled::ONE, BALANCE),
                mean_uni + mean_nee,
                by_both,
            )?;
        }
    }
    Ok(())
}

fn hero_only_equals_plain_product<const N: usize>(events: &Events<N>) -> Result<(), TestCaseError> {
    let p = events.plain();
    if p.uni[0] > 0.0 {
        let walk = events.walk::<PathWeights<N>>();
        assert_near("hero", walk.hero_only(Sampled::ONE)[0], p.f[0] / p.uni[0])?;
    }
    Ok(())
}

/// Checks that the weights of a path sum to one over every component as the hero and both techniques. Each
/// weight is its density over the sum of all densities.
fn weights_sum_to_one<const N: usize>(events: &Events<N>) -> Result<(), TestCaseError> {
    let plain = events.plain();
    let (mut weights, mut means) = (0.0, 0.0);
    for hero in 0..N {
        let turned = events.rotated(hero);
        let sum = |values: Sampled<N>| values.0.iter().map(|x| f64::from(*x)).sum::<f64>();
        // Rescaled densities are relative to the density that sampled the path.
        if plain.uni[hero] > 0.0 {
            let walk = turned.walk::<PathWeights<N>>();
            assert_near("p_uni of the hero", numbers(&walk)[1].hero(), 1.0)?;
            weights += 1.0 / sum(numbers(&walk)[1] + numbers(&walk)[2] * turned.light);
            means += 1.0 / sum(numbers(&walk)[1]);
        }
        if plain.nee[hero] > 0.0 {
            let link = turned.connection::<PathWeights<N>>();
            assert_near("p_nee of the hero", numbers(&link)[2].hero(), 1.0)?;
            weights += 1.0 / sum(numbers(&link)[1] + numbers(&link)[2]);
        }
    }
    prop_assert!((weights - 1.0).abs() < ROUNDING, "sum over both techniques: {weights}");
    let could_walk = plain.uni.iter().any(|p| *p > 0.0);
    prop_assert!(!could_walk || (means - 1.0).abs() < ROUNDING, "sum over the walk: {means}");
    Ok(())
}

/// Checks the same as [`weights_sum_to_one`] for the contributions of the estimators, for every pair of
/// heuristics.
fn shares_sum_to_one<const N: usize>(events: &Events<N>) -> Result<(), TestCaseError> {
    use Heuristic::{Balance, HeroOnly, Maximum, Power};
    let plain = events.plain();
    if plain.f.contains(&0.0) {
        return Ok(());
    }
    for (components, techniques) in [Balance, Power, Maximum, HeroOnly]
        .into_iter()
        .flat_map(|components| [Balance, Power, Maximum].map(|techniques| (components, techniques)))
    {
        let heuristics = Heuristics { components, techniques };
        let (mut by_hero, mut alone) = ([0.0f64; N], 0.0f64);
        let mut possible = [false; N];
        for hero in 0..N {
            let turned = events.rotated(hero);
            // MIS-weighted contribution of the path, whose hero has probability 1/N, over f/P.
            let share = |value: Sampled<N>, path: &PathWeights<N>| {
                f64::from(value.hero()) / (f64::from(path.contribution().hero()) * N as f64)
            };
            if plain.uni[hero] > 0.0 {
                let walk = turned.walk::<PathWeights<N>>();
                by_hero[hero] += share(walk.combined(Sampled::ONE, turned.light, heuristics), &walk);
                alone += share(walk.unidirectional(Sampled::ONE, heuristics), &walk);
                possible[hero] = true;
            }
            if plain.nee[hero] > 0.0 {
                let link = turned.connection::<PathWeights<N>>();
                by_hero[hero] += share(link.connected_combined(Sampled::ONE, heuristics), &link);
                possible[hero] = true;
            }
        }
        let near_one = |sum: f64| (sum - 1.0).abs() < 2.0 * ROUNDING;
        if components == HeroOnly {
            // Each component gets contributions only from paths with itself as the hero.
            for (sum, possible) in by_hero.iter().zip(possible) {
                prop_assert!(!possible || near_one(*sum), "{heuristics:?}: {by_hero:?}");
            }
        } else {
            let sum: f64 = by_hero.iter().sum();
            prop_assert!(near_one(sum), "{heuristics:?}: {sum}");
            let could_walk = plain.uni.iter().any(|p| *p > 0.0);
            prop_assert!(!could_walk || near_one(alone), "{heuristics:?}, sum over the walk: {alone}");
        }
    }
    Ok(())
}

/// Checks that roulette scales the contribution and leaves p_uni and p_nee unchanged bit for bit.
fn roulette_leaves_densities_unchanged<const N: usize>(events: &Events<N>) -> Result<(), TestCaseError> {
    let plain = events.plain();
    let without = events.without_roulette();
    let gain = plain.f[0] / without.plain().f[0];
    for (hero, a, b) in [
        (plain.uni[0], events.walk::<PathWeights<N>>(), without.walk::<PathWeights<N>>()),
        (plain.nee[0], events.connection::<PathWeights<N>>(), without.connection::<PathWeights<N>>()),
    ] {
        if hero > 0.0 {
            prop_assert_eq!((numbers(&a)[1], numbers(&a)[2]), (numbers(&b)[1], numbers(&b)[2]));
            if plain.f[0] != 0.0 {
                assert_near("gain", numbers(&a)[0].hero() / numbers(&b)[0].hero(), gain)?;
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 512,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(5),
        ..ProptestConfig::default()
    })]

    #[test]
    fn rescaled_weights_equal_plain_products(
        one in events::<1>(), three in events::<3>(), four in events::<4>(),
    ) {
        equals_plain_products::<PathWeights<1>, 1>(&one)?;
        equals_plain_products::<PathWeights<3>, 3>(&three)?;
        equals_plain_products::<PathWeights<4>, 4>(&four)?;
        hero_only_equals_plain_product(&four)?;
    }

    #[test]
    fn other_weight_forms_agree(three in events::<3>(), four in events::<4>()) {
        equals_plain_products::<WeightsApart<f64, 3>, 3>(&three)?;
        equals_plain_products::<WeightsApart<f64, 4>, 4>(&four)?;
        equals_plain_products::<WeightsPairwise<3>, 3>(&three)?;
        equals_plain_products::<WeightsPairwise<4>, 4>(&four)?;
    }

    #[test]
    fn balance_weights_sum_to_one_over_heroes_and_techniques(
        one in events::<1>(), three in events::<3>(), four in events::<4>(),
    ) {
        weights_sum_to_one(&one)?;
        weights_sum_to_one(&three)?;
        weights_sum_to_one(&four)?;
    }

    #[test]
    fn weights_of_every_heuristic_sum_to_one(
        one in events::<1>(), three in events::<3>(), four in events::<4>(),
    ) {
        shares_sum_to_one(&one)?;
        shares_sum_to_one(&three)?;
        shares_sum_to_one(&four)?;
    }

    #[test]
    fn roulette_is_left_out_of_every_weight(one in events::<1>(), four in events::<4>()) {
        roulette_leaves_densities_unchanged(&one)?;
        roulette_leaves_densities_unchanged(&four)?;
    }
}

/// Follows a hundred thousand events with albedo 1 and majorants that differ by up to a factor of a hundred,
/// sampled as by a walk: no value overflows, and the values of the components sum to their number.
#[test]
fn a_hundred_thousand_events_stay_finite() {
    const EXTINCTION: [f32; 4] = [0.5, 50.0, 3.0, 0.6];
    for (hero, factor) in (0..4).flat_map(|hero| [1.0, 1.7].map(|factor| (hero, factor))) {
        let extinction = Sampled::<4>(std::array::from_fn(|i| EXTINCTION[(hero + i) % 4]));
        let majorant = extinction * factor;
        let segment = MajorantSegment { t0: 0.0, t1: 1.0, majorant, clamp_null: false, watched: false };
        let coefficients = Coefficients::new(extinction, Sampled::ONE, &segment);
        let collision = Collision::new(Vec3::ZERO, coefficients, Absorption::Weighted.into());
        let mut trace = Trace::new(Sampler::new(1, hero as u64, 0), CancelToken::NEVER);
        let outgoing = DirectionSample { direction: Vec3::Z, value: 0.08, density: 0.08 };
        let mut path = PathWeights::CAMERA;
        for _ in 0..100_000 {
            path.pass(majorant * (trace.sampler.next_optical_depth() / majorant.hero()));
            let link = if collision.draw_event(&mut trace) == Event::Scattering {
                path.scatter(&collision);
                let link = path.connect(&outgoing, 40.0);
                path.choose_direction(&outgoing);
                link
            } else {
                path.null(&collision);
                path
            };
            let values = [
                path.unidirectional(Sampled::ONE, BALANCE),
                path.combined(Sampled::ONE, 40.0, BALANCE),
                link.connected_only(Sampled::ONE, BALANCE),
                link.connected_combined(Sampled::ONE, BALANCE),
                path.hero_only(Sampled::ONE),
            ];
            assert!(values.iter().flat_map(|v| v.0).all(f32::is_finite), "hero {hero}: {values:?}");
            let sum: f32 = values[0].0.iter().sum();
            assert!((sum - 4.0).abs() < 0.01, "hero {hero}: the components sum to {sum}");
        }
    }
}

/// Forty collisions in a dense medium leave the range of single precision, but not of double precision
/// (section 5 of the report).
#[test]
fn separate_products_overflow_where_quotients_do_not() {
    let extinction = Sampled([400.0f32, 300.0, 200.0, 100.0]);
    let segment =
        MajorantSegment { t0: 0.0, t1: 1.0, majorant: extinction * 1.2, clamp_null: false, watched: false };
    let coefficients = Coefficients::new(extinction, Sampled::splat(0.99), &segment);
    let collision = Collision::new(Vec3::ZERO, coefficients, Absorption::Weighted.into());
    let outgoing = DirectionSample { direction: Vec3::Z, value: 0.08, density: 0.08 };
    fn fly<W: Weights<4>>(collision: &Collision<4>, outgoing: &DirectionSample) -> Sampled<4> {
        let mut path = W::CAMERA;
        for _ in 0..40 {
            path.pass(collision.coefficients.majorant * (0.2 / 480.0));
            path.scatter(collision);
            path.choose_direction(outgoing);
        }
        path.combined(Sampled::ONE, 1.0, BALANCE)
    }
    let single = fly::<WeightsApart<f32, 4>>(&collision, &outgoing);
    assert!(single.0.iter().any(|value| !value.is_finite()), "{single:?}");
    let expected = fly::<WeightsApart<f64, 4>>(&collision, &outgoing);
    for value in
        [fly::<PathWeights<4>>(&collision, &outgoing), fly::<WeightsPairwise<4>>(&collision, &outgoing)]
    {
        let near = value.zip(expected, |a, b| (a / b - 1.0).abs()).max_component();
        assert!(near < 1e-4, "{value:?} {expected:?}");
    }
}
