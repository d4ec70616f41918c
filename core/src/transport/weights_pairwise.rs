//! Path weights in Miller's pairwise form: quotients p_i / f_j of every density by every contribution.
//!
//! ```text
//!   1 / L_j  =  mean_i ( p_uni,i / f_j + p_nee,i / f_j ) / Le_j
//! ```
//!
//! The quotients stay within range, as numerator and denominator are products of like factors. The cost is N²
//! numbers per technique and event, and only the balance heuristic can be formed from them (Miller et al.
//! 2019, equations 26–30). Where f_j is zero the quotients are infinite, and remain infinite.
//!
//! In terms of pbrt-v4's `beta`, `r_u` and `r_l`, `uni[i][j]` is `r_u[i] / beta[j]` and `nee[i][j]` is
//! `r_l[i] / beta[j]`; the density P of the technique that made the path cancels.

use super::{Collision, DirectionSample, WalkWeights, WeightRecord, Weights};
use crate::scene::Heuristics;
use crate::spectrum::{Radiance, Sampled};

/// Quotients p_uni,i / f_j and p_nee,i / f_j; rows are indexed by i.
#[derive(Clone, Copy, Debug)]
pub struct WeightsPairwise<const N: usize> {
    uni: [Sampled<N>; N],
    nee: [Sampled<N>; N],
}

/// Multiplies quotients by the factor p_i / f_j of one event.
fn multiply<const N: usize>(quotients: &mut [Sampled<N>; N], p: Sampled<N>, f: Sampled<N>) {
    for (row, p) in quotients.iter_mut().zip(p.0) {
        *row =
            row.zip(
                f,
                |quotient, f| {
                    if f == 0.0 || quotient.is_infinite() { f32::INFINITY } else { quotient * (p / f) }
                },
            );
    }
}

/// Reciprocal of the mean over i.
fn inverse_mean<const N: usize>(quotients: [Sampled<N>; N]) -> Sampled<N> {
    let sum = quotients.into_iter().fold(Sampled::ZERO, |sum, row| sum + row);
    sum.map(|sum| N as f32 / sum)
}

impl<const N: usize> WalkWeights<N> for WeightsPairwise<N> {
    const CAMERA: Self = Self { uni: [Sampled::ONE; N], nee: [Sampled::ONE; N] };

    fn pass(&mut self, optical_depth: Sampled<N>) {
        // e^(−τ_i) / e^(−τ_j), evaluated as one exponential of the difference.
        for (i, (uni, nee)) in self.uni.iter_mut().zip(&mut self.nee).enumerate() {
            let ratio = (optical_depth - Sampled::splat(optical_depth[i])).exp();
            *uni *= ratio;
            *nee *= ratio;
        }
    }

    fn null(&mut self, c: &Collision<N>) {
        multiply(&mut self.uni, c.null_density, c.coefficients.null);
        multiply(&mut self.nee, c.coefficients.majorant, c.coefficients.null);
    }

    fn null_by_ratio(&mut self, c: &Collision<N>) {
        self.null(c);
    }

    fn scatter(&mut self, c: &Collision<N>) {
        multiply(&mut self.uni, c.scattering_density, c.coefficients.scattering);
    }

    fn reflect(&mut self, albedo: Sampled<N>) {
        multiply(&mut self.uni, Sampled::ONE, albedo);
    }

    fn choose_direction(&mut self, outgoing: &DirectionSample) {
        self.nee = self.uni;
        multiply(&mut self.nee, Sampled::ONE, Sampled::splat(outgoing.value));
        multiply(&mut self.uni, Sampled::splat(outgoing.density), Sampled::splat(outgoing.value));
    }

    fn leave(&mut self, value: Sampled<N>, density: Sampled<N>, connects: bool) {
        if connects {
            self.nee = self.uni;
            multiply(&mut self.nee, Sampled::ONE, value);
        } else {
            self.nee = [Sampled::ZERO; N];
        }
        multiply(&mut self.uni, density, value);
    }

    fn adjust(&mut self, value: Sampled<N>, density: Sampled<N>) {
        multiply(&mut self.uni, density, value);
        multiply(&mut self.nee, Sampled::ONE, value);
    }

    fn emitted<R: Radiance<N>>(&self, radiance: R, c: &Collision<N>, _: Heuristics) -> R {
        let mut end = self.uni;
        multiply(&mut end, c.tentative, c.coefficients.absorption);
        radiance * inverse_mean(end)
    }

    fn survive(&mut self, q: f32) {
        multiply(&mut self.uni, Sampled::splat(q), Sampled::ONE);
        multiply(&mut self.nee, Sampled::splat(q), Sampled::ONE);
    }

    fn throughput(&self) -> f32 {
        inverse_mean(self.uni).abs().max_component()
    }

    /// The quotients with the hero as i or as j; the other pairs are left out.
    fn weight_record(&self) -> WeightRecord {
        let of_hero = |quotients: [Sampled<N>; N]| Sampled(quotients.map(|row| row.hero())).lanes();
        let (uni, nee) = (of_hero(self.uni), of_hero(self.nee));
        WeightRecord { names: ["p_uni/f1", "p_nee/f1", "p_uni1/f"], values: [uni, nee, self.uni[0].lanes()] }
    }

    fn is_zero(&self) -> bool {
        self.uni[0].0.iter().all(|quotient| quotient.is_infinite())
    }

    fn unidirectional<R: Radiance<N>>(&self, radiance: R, _: Heuristics) -> R {
        radiance * inverse_mean(self.uni)
    }
}

impl<const N: usize> Weights<N> for WeightsPairwise<N> {
    fn connect(&self, outgoing: &DirectionSample, light_density: f32) -> Self {
        let mut link = *self;
        link.nee = self.uni;
        multiply(&mut link.nee, Sampled::splat(light_density), Sampled::splat(outgoing.value));
        multiply(&mut link.uni, Sampled::splat(outgoing.density), Sampled::splat(outgoing.value));
        link
    }

    fn attenuate(&mut self, transmittance: Sampled<N>) {
        multiply(&mut self.uni, Sampled::ONE, transmittance);
        multiply(&mut self.nee, Sampled::ONE, transmittance);
    }

    fn connected_only<R: Radiance<N>>(&self, radiance: R, _: Heuristics) -> R {
        radiance * inverse_mean(self.nee)
    }

    fn combined<R: Radiance<N>>(&self, radiance: R, light_density: f32, _: Heuristics) -> R {
        let both = std::array::from_fn(|i| self.uni[i] + self.nee[i] * light_density);
        radiance * inverse_mean(both)
    }

    fn connected_combined<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R {
        self.combined(radiance, 1.0, heuristics)
    }
}
