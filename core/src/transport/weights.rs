//! Path weights in rescaled form.
//!
//! A path has at every component i a contribution f_i, a density p_uni,i with which unidirectional
//! sampling would have made it had i been the hero, and the same p_nee,i for next-event estimation.
//! As products of hundreds of coefficients they overflow; their quotients by the density P with which
//! the path *was* made do not (P is the hero's, of the technique that samples). Kept are
//!
//! ```text
//!   contribution_i = f_i / P      uni_i = p_uni,i / P      nee_i = p_nee,i / P
//! ```
//!
//! so that an event costs O(N), and any heuristic can be formed at the end (Miller et al. 2019 eq. 26–30;
//! the rescaling is that of pbrt-v4's `beta, r_u, r_l`). The value that a finished path adds with the
//! balance heuristic is, over heroes as a one-sample family and techniques as a two-sample family,
//!
//! ```text
//!   Le_j · f_j / mean_i (p_uni,i + p_nee,i)
//! ```
//!
//! Decisions that do not depend on the components, such as Russian roulette, scale the contribution
//! alone: weights that leave them out of *every* technique still sum to one.

use super::Collision;
use crate::spectrum::Sampled;

/// Contribution and densities of a path, divided by the density with which it was made.
#[derive(Clone, Copy, Debug)]
pub struct PathWeights<const N: usize> {
    contribution: Sampled<N>,
    uni: Sampled<N>,
    nee: Sampled<N>,
}

impl<const N: usize> PathWeights<N> {
    /// A path that has just left the camera.
    pub const CAMERA: Self = Self { contribution: Sampled::ONE, uni: Sampled::ONE, nee: Sampled::ONE };

    /// A stretch of `distance` without collision under a majorant μ̄: e^(−μ̄ᵢ t) for all.
    #[inline]
    pub fn pass(&mut self, majorant: Sampled<N>, distance: f32) {
        if majorant == Sampled::splat(majorant.hero()) {
            return;
        }
        let ratio = majorant.map(|m| (-(m - majorant.hero()) * distance).exp());
        self.contribution *= ratio;
        self.uni *= ratio;
        self.nee *= ratio;
    }

    /// A collision that the walk has drawn as null. Next-event estimation takes every collision of a
    /// connection as null, hence its μ̄.
    #[inline]
    pub fn null(&mut self, c: &Collision<N>) {
        self.pass_null(c, c.null_density.hero());
    }

    /// A collision on a connection, which takes all as null (ratio tracking).
    #[inline]
    pub fn null_by_ratio(&mut self, c: &Collision<N>) {
        self.pass_null(c, c.coefficients.majorant.hero());
    }

    #[inline]
    fn pass_null(&mut self, c: &Collision<N>, made_with: f32) {
        let scale = 1.0 / made_with;
        self.contribution *= c.coefficients.null * scale;
        self.uni *= c.null_density * scale;
        self.nee *= c.coefficients.majorant * scale;
    }

    /// A collision that the walk has drawn as scattering: μs, without the phase function.
    #[inline]
    pub fn scatter(&mut self, c: &Collision<N>) {
        let scale = 1.0 / c.scattering_density.hero();
        self.contribution *= c.coefficients.scattering * scale;
        self.uni *= c.scattering_density * scale;
    }

    /// A diffuse reflection: its albedo, without the cosine lobe.
    #[inline]
    pub fn reflect(&mut self, albedo: Sampled<N>) {
        self.contribution *= albedo;
    }

    /// Leaves a vertex in a direction that was drawn with `density`, proportional to the phase
    /// function or cosine lobe: f and p_uni gain it, p_nee does not, as a light would have been
    /// sampled here instead. The light's own density joins p_nee in [`Self::balanced`].
    #[inline]
    pub fn leave(&mut self, density: f32) {
        self.nee = self.uni * (1.0 / density);
    }

    /// A connection from a vertex in a direction that was drawn with `light_density`, where the phase
    /// function or cosine lobe has `density`. From here on P is p_nee of the hero.
    #[must_use]
    #[inline]
    pub fn connect(&self, density: f32, light_density: f32) -> Self {
        let ratio = density / light_density;
        Self { contribution: self.contribution * ratio, uni: self.uni * ratio, nee: self.uni }
    }

    /// Continues with probability `q`.
    #[inline]
    pub fn survive(&mut self, q: f32) {
        self.contribution *= 1.0 / q;
    }

    /// How bright the path is at its brightest component relative to how likely it is for any hero;
    /// the same whichever component is the hero.
    #[must_use]
    pub fn throughput(&self) -> f32 {
        self.contribution.abs().max_component() / self.uni.mean()
    }

    /// Whether nothing can come of the path any more.
    #[must_use]
    #[inline]
    pub fn is_dark(&self) -> bool {
        self.contribution.is_zero()
    }

    /// The path's value if only the hero is ever used: f₁ / p₁, and zero elsewhere.
    #[must_use]
    pub fn hero_only(&self, radiance: Sampled<N>) -> Sampled<N> {
        let mut value = Sampled::ZERO;
        value.0[0] = radiance.hero() * self.contribution.hero();
        value
    }

    /// The path's value if only unidirectional sampling makes it: f_j / mean p_uni.
    #[must_use]
    pub fn unidirectional(&self, radiance: Sampled<N>) -> Sampled<N> {
        radiance * self.contribution * (1.0 / self.uni.mean())
    }

    /// A connection's value if only connections make such paths: f_j / mean p_nee.
    #[must_use]
    pub fn connected_only(&self, radiance: Sampled<N>) -> Sampled<N> {
        radiance * self.contribution * (1.0 / self.nee.mean())
    }

    /// The value of a walk that has met a light which light sampling would have drawn with
    /// `light_density`: f_j / mean (p_uni + p_nee).
    #[must_use]
    pub fn balanced(&self, radiance: Sampled<N>, light_density: f32) -> Sampled<N> {
        radiance * self.contribution * (1.0 / (self.uni + self.nee * light_density).mean())
    }

    /// The value of a connection: f_j / mean (p_uni + p_nee). Its light density is in P already.
    #[must_use]
    pub fn connected_balanced(&self, radiance: Sampled<N>) -> Sampled<N> {
        self.balanced(radiance, 1.0)
    }
}

#[cfg(test)]
#[path = "weights_tests.rs"]
mod tests;
