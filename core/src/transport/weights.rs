//! Path weights in rescaled form.
//!
//! At every component i a path has a contribution f_i, the density p_uni,i with which unidirectional
//! sampling would have made it had i been the hero, and the corresponding density p_nee,i of next-event
//! estimation. As products of hundreds of coefficients they overflow; their quotients by the density P with
//! which the path *was* made do not. P is the hero's density for the technique that made the path. The
//! weights stored are
//!
//! ```text
//!   contribution_i = f_i / P      uni_i = p_uni,i / P      nee_i = p_nee,i / P
//! ```
//!
//! so that an event costs O(N), and any heuristic can be formed at the end (Miller et al. 2019 eq. 26–30).
//!
//! pbrt-v4 rescales in the same way. Its names, also common in the literature, correspond to these fields:
//!
//! | pbrt-v4 | here | |
//! | --- | --- | --- |
//! | `beta` | `contribution` | f / P |
//! | `r_u` | `uni` | p_uni / P; its mean over the components is the denominator over all heroes |
//! | `r_l` | `nee` | p_nee / P; on a walk without the light's density, which `combined` multiplies in |
//!
//! The balance heuristic treats the heroes as a one-sample family and the techniques as a two-sample
//! family. The value that a finished path adds to the estimate is then
//!
//! ```text
//!   Le_j · f_j / mean_i (p_uni,i + p_nee,i)
//! ```
//!
//! Decisions that do not depend on the components, such as Russian roulette, scale the contribution
//! alone: weights that leave them out of *every* technique still sum to one.

use super::heuristic::{among_all, among_heroes};
use super::{Collision, DirectionSample, WalkWeights, WeightRecord, Weights};
use crate::scene::Heuristics;
use crate::spectrum::{Radiance, Sampled};

/// Contribution and densities of a path, divided by the density with which the path was made.
#[derive(Clone, Copy, Debug)]
pub struct PathWeights<const N: usize> {
    pub(super) contribution: Sampled<N>,
    uni: Sampled<N>,
    pub(super) nee: Sampled<N>,
    /// Majorant optical depth beyond the hero's, by which all three weights still have to be attenuated.
    pending: Sampled<N>,
}

/// Largest pending optical depth: e^(±16) times the factor of one event stays within the range of f32.
const MOST_PENDING: f32 = 16.0;

impl<const N: usize> WalkWeights<N> for PathWeights<N> {
    const CAMERA: Self =
        Self { contribution: Sampled::ONE, uni: Sampled::ONE, nee: Sampled::ONE, pending: Sampled::ZERO };

    #[inline]
    fn pass(&mut self, optical_depth: Sampled<N>) {
        if N == 1 {
            return;
        }
        self.pending += optical_depth - Sampled::splat(optical_depth.hero());
        if self.pending.abs().max_component() > MOST_PENDING {
            *self = self.settled();
        }
    }

    #[inline]
    fn null(&mut self, c: &Collision<N>) {
        self.pass_null(c, c.null_density.hero());
    }

    #[inline]
    fn null_by_ratio(&mut self, c: &Collision<N>) {
        self.pass_null(c, c.coefficients.majorant.hero());
    }

    #[inline]
    fn scatter(&mut self, c: &Collision<N>) {
        let scale = 1.0 / c.scattering_density.hero();
        self.contribution *= c.coefficients.scattering * scale;
        self.uni *= c.scattering_density * scale;
    }

    #[inline]
    fn reflect(&mut self, albedo: Sampled<N>) {
        self.contribution *= albedo;
    }

    #[inline]
    fn choose_direction(&mut self, outgoing: &DirectionSample) {
        let drawn = 1.0 / outgoing.density;
        if outgoing.value != outgoing.density {
            self.contribution *= outgoing.value * drawn;
        }
        self.nee = self.uni * drawn;
    }

    fn leave(&mut self, value: Sampled<N>, density: Sampled<N>, connects: bool) {
        let drawn = 1.0 / density.hero();
        self.nee = if connects { self.uni * drawn } else { Sampled::ZERO };
        self.contribution *= value * drawn;
        self.uni *= density * drawn;
    }

    fn adjust(&mut self, value: Sampled<N>, density: Sampled<N>) {
        self.contribution *= value;
        self.uni *= density;
    }

    fn emitted<R: Radiance<N>>(&self, radiance: R, c: &Collision<N>, heuristics: Heuristics) -> R {
        let scale = 1.0 / c.tentative.hero();
        let mut now = self.settled();
        now.contribution *= c.coefficients.absorption * scale;
        radiance * among_heroes(now.contribution, now.uni * (c.tentative * scale), 1.0, heuristics.components)
    }

    #[inline]
    fn survive(&mut self, q: f32) {
        self.contribution *= 1.0 / q;
    }

    fn throughput(&self) -> f32 {
        let now = self.settled();
        now.contribution.abs().max_component() / now.uni.mean()
    }

    fn weight_record(&self) -> WeightRecord {
        let now = self.settled();
        WeightRecord {
            names: ["f/P", "p_uni/P", "p_nee/P"],
            values: [now.contribution.lanes(), now.uni.lanes(), now.nee.lanes()],
        }
    }

    #[inline]
    fn is_zero(&self) -> bool {
        self.contribution.is_zero()
    }

    #[inline]
    fn unidirectional<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R {
        let now = self.settled();
        radiance * among_heroes(now.contribution, now.uni, 1.0, heuristics.components)
    }
}

impl<const N: usize> Weights<N> for PathWeights<N> {
    #[inline]
    fn connect(&self, outgoing: &DirectionSample, light_density: f32) -> Self {
        let drawn = 1.0 / light_density;
        Self {
            contribution: self.contribution * (outgoing.value * drawn),
            uni: self.uni * (outgoing.density * drawn),
            nee: self.uni,
            pending: self.pending,
        }
    }

    #[inline]
    fn attenuate(&mut self, transmittance: Sampled<N>) {
        *self = self.settled();
        self.contribution *= transmittance;
    }

    #[inline]
    fn connected_only<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R {
        let now = self.settled();
        radiance * among_heroes(now.contribution, now.nee, 1.0, heuristics.components)
    }

    #[inline]
    fn combined<R: Radiance<N>>(&self, radiance: R, light_density: f32, heuristics: Heuristics) -> R {
        let now = self.settled();
        radiance * among_all(now.contribution, [now.uni, now.nee * light_density], heuristics)
    }

    #[inline]
    fn connected_combined<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R {
        let now = self.settled();
        radiance * among_all(now.contribution, [now.nee, now.uni], heuristics)
    }
}

impl<const N: usize> PathWeights<N> {
    /// Returns the same weights with the pending attenuation applied.
    #[inline]
    fn settled(&self) -> Self {
        if N == 1 {
            return *self;
        }
        let ratio = (-self.pending).exp();
        Self {
            contribution: self.contribution * ratio,
            uni: self.uni * ratio,
            nee: self.nee * ratio,
            pending: Sampled::ZERO,
        }
    }

    /// Updates the contribution for a collision drawn as null with this density; `uni` and `nee` stay as they
    /// are.
    #[inline]
    pub fn null_drawn(&mut self, c: &Collision<N>, density: f32) {
        self.contribution *= c.coefficients.null * (1.0 / density);
    }

    /// Updates the contribution for a collision drawn as scattering with this density; `uni` and `nee` stay
    /// as they are.
    #[inline]
    pub fn scatter_drawn(&mut self, c: &Collision<N>, density: f32) {
        self.contribution *= c.coefficients.scattering * (1.0 / density);
    }

    /// f_i / P: contribution at each component over the density with which the path was made.
    #[must_use]
    #[inline]
    pub fn contribution(&self) -> Sampled<N> {
        self.settled().contribution
    }

    #[inline]
    fn pass_null(&mut self, c: &Collision<N>, made_with: f32) {
        let scale = 1.0 / made_with;
        self.contribution *= c.coefficients.null * scale;
        self.uni *= c.null_density * scale;
        self.nee *= c.coefficients.majorant * scale;
    }

    /// Value of the path if only the hero is carried: f₁ / p₁, and zero at the other components.
    #[must_use]
    pub fn hero_only<R: Radiance<N>>(&self, radiance: R) -> R {
        radiance * self.hero(1.0)
    }

    /// [`Self::hero_only`] of a path that ends at a collision where the medium emits.
    #[must_use]
    pub fn hero_emitted<R: Radiance<N>>(&self, radiance: R, c: &Collision<N>) -> R {
        radiance * self.hero(c.coefficients.absorption.hero() / c.tentative.hero())
    }

    /// [`Self::as_drawn`] of a path that ends at a collision where the medium emits.
    #[must_use]
    pub fn emitted_as_drawn<R: Radiance<N>>(&self, radiance: R, c: &Collision<N>) -> R {
        let drawn = c.coefficients.absorption * (1.0 / c.tentative.hero());
        radiance * (self.settled().contribution * drawn)
    }

    /// Value of the path without multiple importance sampling: f_j / P.
    #[must_use]
    pub fn as_drawn<R: Radiance<N>>(&self, radiance: R) -> R {
        radiance * self.settled().contribution
    }

    fn hero(&self, weight: f32) -> Sampled<N> {
        let mut hero = Sampled::ZERO;
        hero.0[0] = self.contribution.hero() * weight;
        hero
    }
}
