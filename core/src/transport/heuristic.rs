//! Heuristics of multiple importance sampling, over techniques and over heroes.

use crate::scene::{Heuristic, Heuristics};
use crate::spectrum::Sampled;

/// Relative difference up to which the maximum heuristic treats densities as equal. Rounding must not decide
/// between equal densities, or different heroes would decide differently.
const TIE: f32 = 1e-4;

/// Weight of the strategy whose density is `own` among strategies with densities `all`, itself included. The
/// weights of all strategies sum to one (Veach 1997, equations 9.10–9.13). Densities may share any unit.
///
/// [`Heuristic::HeroOnly`] combines nothing and has no weight: for components it must not be passed here. For
/// techniques it is taken as the balance heuristic.
#[must_use]
#[inline]
pub fn share(heuristic: Heuristic, own: f32, all: impl Iterator<Item = f32> + Clone) -> f32 {
    let largest = all.clone().fold(0.0, f32::max);
    if largest <= 0.0 || own <= 0.0 {
        return 0.0;
    }
    // In units of the largest density nothing overflows.
    let relative = |density: f32| density / largest;
    match heuristic {
        Heuristic::Balance | Heuristic::HeroOnly => relative(own) / all.map(relative).sum::<f32>(),
        Heuristic::Power => relative(own).powi(2) / all.map(|density| relative(density).powi(2)).sum::<f32>(),
        Heuristic::Maximum => {
            let tied = |density: &f32| relative(*density) >= 1.0 - TIE;
            if tied(&own) { 1.0 / all.filter(tied).count() as f32 } else { 0.0 }
        }
    }
}

/// Weights a path of contribution f / P by the heuristic over techniques with densities p / P, the first of
/// which made the path, then over the heroes of that technique. With p_t = mean_i p_t,i and heuristics h the
/// weight is
///
/// ```text
///   w_t,i = h(p_t among techniques) · h(p_t,i among components)
/// ```
///
/// It sums to one over both, and is p_t,i over the sum of all where h is the balance heuristic.
#[must_use]
#[inline]
pub fn among_all<const N: usize, const T: usize>(
    contribution: Sampled<N>,
    densities: [Sampled<N>; T],
    heuristics: Heuristics,
) -> Sampled<N> {
    if heuristics == Heuristics::default() {
        let all = densities.into_iter().fold(Sampled::ZERO, |sum, p| sum + p);
        return contribution * (1.0 / all.mean());
    }
    let density = |p: Sampled<N>| match heuristics.components {
        // With the hero only, each component has techniques of its own.
        Heuristic::HeroOnly => p.hero(),
        _ => p.mean(),
    };
    let made = densities[0];
    let of_technique = share(heuristics.techniques, density(made), densities.into_iter().map(density));
    among_heroes(contribution, made, of_technique, heuristics.components)
}

/// f / P times the weight of the hero among the components that could have been the hero, with densities p /
/// P. `weight` is the weight of the technique. The factor N accounts for one hero in N being chosen per path.
#[must_use]
#[inline]
pub fn among_heroes<const N: usize>(
    contribution: Sampled<N>,
    p: Sampled<N>,
    weight: f32,
    heuristic: Heuristic,
) -> Sampled<N> {
    match heuristic {
        Heuristic::Balance => contribution * (weight / p.mean()),
        Heuristic::HeroOnly => {
            let mut hero = Sampled::ZERO;
            hero.0[0] = contribution.hero() * weight * N as f32;
            hero
        }
        Heuristic::Power | Heuristic::Maximum => {
            contribution * (weight * N as f32 * share(heuristic, p.hero(), p.0.into_iter()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_sum_to_one_and_favour_the_large() {
        for heuristic in [Heuristic::Balance, Heuristic::Power, Heuristic::Maximum] {
            for all in [[1.0f32, 3.0, 0.0], [1e30, 1e-30, 2e30], [2.0, 2.0, 2.0], [0.0, 0.0, 1e-38]] {
                let weights = all.map(|own| share(heuristic, own, all.into_iter()));
                assert!(
                    (weights.iter().sum::<f32>() - 1.0).abs() < 1e-6,
                    "{heuristic:?} {all:?} {weights:?}"
                );
                for (weight, density) in weights.iter().zip(all) {
                    assert!(*weight >= 0.0 && (density > 0.0 || *weight == 0.0));
                }
            }
        }
        let of_three = |heuristic| share(heuristic, 3.0, [1.0, 3.0].into_iter());
        assert_eq!(
            [Heuristic::Balance, Heuristic::Power, Heuristic::Maximum].map(of_three),
            [0.75, 0.9, 1.0]
        );
    }
}
