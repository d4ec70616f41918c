//! Path weights with a third technique: equiangular connections.
//!
//! Three techniques can make a path … x, y, light from its last but one vertex x on. All three draw the
//! direction from x to y alike. With ∏ over the null collisions between x and y, and between y and the light:
//!
//! ```text
//!   unidirectional   p_uni = ∏ |μn| · scattering density · phase density · ∏ |μn|
//!   next event       p_nee = ∏ |μn| · scattering density · light density · ∏ μ̄
//!   equiangular      p_eq  = ∏  μ̄   · p(t | light)        · light density · ∏ μ̄
//! ```
//!
//! all with the same e^(−∫ μ̄), so that their quotients are maintained as in [`super::PathWeights`]. The
//! weights stored are f, p_uni, p_nee and p_eq over the density P with which the path was made, without the
//! factors that depend on the light at which it ends.
//!
//! `contribution`, `uni` and `nee` are pbrt-v4's `beta`, `r_u` and `r_l`; `eq` is the same quotient for the
//! third technique, which pbrt-v4 does not have.

use super::heuristic::{among_all, among_heroes};
use super::{Collision, DirectionSample, WalkWeights, WeightRecord};
use crate::scene::Heuristics;
use crate::spectrum::{Radiance, Sampled};

/// Contribution and three densities of a path, divided by the density with which the path was made.
#[derive(Clone, Copy, Debug)]
pub struct EquiangularWeights<const N: usize> {
    contribution: Sampled<N>,
    uni: Sampled<N>,
    nee: Sampled<N>,
    /// p_eq of a path whose last vertex was drawn by equiangular sampling; zero after a surface.
    eq: Sampled<N>,
    /// As `uni`, with every collision since the last vertex taken as null: the value of `eq` if equiangular
    /// sampling draws the next vertex.
    ahead: Sampled<N>,
}

/// Factors of the techniques' densities that depend on the light.
#[derive(Clone, Copy, Debug)]
pub struct LightDensities {
    /// Density of the direction to the light at the last vertex, including the choice of the light; per
    /// steradian.
    pub nee: f32,
    /// Density of the same direction without the choice of the light at the last vertex, times the density of
    /// the last vertex along its ray, the share of its medium and the probability of the light for which it
    /// was drawn. Where the path's density P has the latter three factors already
    /// ([`EquiangularWeights::connect_equiangular`]), they are left out.
    pub eq: f32,
}

impl<const N: usize> WalkWeights<N> for EquiangularWeights<N> {
    const CAMERA: Self = Self {
        contribution: Sampled::ONE,
        uni: Sampled::ONE,
        nee: Sampled::ZERO,
        eq: Sampled::ZERO,
        ahead: Sampled::ONE,
    };

    fn pass(&mut self, optical_depth: Sampled<N>) {
        if N > 1 {
            self.scale((Sampled::splat(optical_depth.hero()) - optical_depth).exp());
        }
    }

    fn null(&mut self, c: &Collision<N>) {
        self.pass_null(c, c.null_density.hero());
    }

    fn null_by_ratio(&mut self, c: &Collision<N>) {
        self.pass_null(c, c.coefficients.majorant.hero());
    }

    fn scatter(&mut self, c: &Collision<N>) {
        let scale = 1.0 / c.scattering_density.hero();
        self.contribution *= c.coefficients.scattering * scale;
        self.uni *= c.scattering_density * scale;
        self.eq = self.ahead * scale;
    }

    fn reflect(&mut self, albedo: Sampled<N>) {
        self.contribution *= albedo;
        self.eq = Sampled::ZERO;
    }

    fn choose_direction(&mut self, outgoing: &DirectionSample) {
        let drawn = 1.0 / outgoing.density;
        self.contribution *= outgoing.value * drawn;
        self.nee = self.uni * drawn;
        self.eq *= drawn;
        self.ahead = self.uni;
    }

    fn leave(&mut self, value: Sampled<N>, density: Sampled<N>, connects: bool) {
        let drawn = 1.0 / density.hero();
        self.nee = if connects { self.uni * drawn } else { Sampled::ZERO };
        self.contribution *= value * drawn;
        self.uni *= density * drawn;
        self.eq = Sampled::ZERO;
        self.ahead = self.uni;
    }

    fn adjust(&mut self, value: Sampled<N>, density: Sampled<N>) {
        self.contribution *= value;
        self.uni *= density;
    }

    fn emitted<R: Radiance<N>>(&self, radiance: R, c: &Collision<N>, heuristics: Heuristics) -> R {
        let scale = 1.0 / c.tentative.hero();
        let contribution = self.contribution * c.coefficients.absorption * scale;
        radiance * among_heroes(contribution, self.uni * (c.tentative * scale), 1.0, heuristics.components)
    }

    fn survive(&mut self, q: f32) {
        self.contribution *= 1.0 / q;
    }

    fn throughput(&self) -> f32 {
        self.contribution.abs().max_component() / self.uni.mean()
    }

    fn weight_record(&self) -> WeightRecord {
        WeightRecord {
            names: ["f/P", "p_uni/P", "p_nee/P"],
            values: [self.contribution.lanes(), self.uni.lanes(), self.nee.lanes()],
        }
    }

    fn is_zero(&self) -> bool {
        self.contribution.is_zero()
    }

    fn unidirectional<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R {
        radiance * among_heroes(self.contribution, self.uni, 1.0, heuristics.components)
    }
}

impl<const N: usize> EquiangularWeights<N> {
    fn scale(&mut self, by: Sampled<N>) {
        for weight_record in
            [&mut self.contribution, &mut self.uni, &mut self.nee, &mut self.eq, &mut self.ahead]
        {
            *weight_record *= by;
        }
    }

    fn pass_null(&mut self, c: &Collision<N>, made_with: f32) {
        let scale = 1.0 / made_with;
        self.contribution *= c.coefficients.null * scale;
        self.uni *= c.null_density * scale;
        let by_ratio = c.coefficients.majorant * scale;
        self.nee *= by_ratio;
        self.eq *= by_ratio;
        self.ahead *= by_ratio;
    }

    /// Updates the weights for a vertex drawn by equiangular sampling with this density, at the end of a
    /// stretch whose collisions were taken as null.
    pub fn scatter_equiangular(&mut self, c: &Collision<N>, density: f32) {
        let scale = 1.0 / density;
        self.contribution *= c.coefficients.scattering * scale;
        self.uni *= c.scattering_density * scale;
        self.eq = self.ahead;
    }

    /// Weights of a connection from a vertex of the path; from here on P is p_nee of the hero.
    #[must_use]
    pub fn connect(&self, outgoing: &DirectionSample, light: LightDensities) -> Self {
        let drawn = 1.0 / light.nee;
        Self {
            contribution: self.contribution * (outgoing.value * drawn),
            uni: self.uni * (outgoing.density * drawn),
            nee: self.uni,
            eq: self.eq * (light.eq * drawn),
            ahead: self.ahead,
        }
    }

    /// Weights of a connection from a vertex drawn by equiangular sampling, whose density P already includes;
    /// P is p_eq of the hero.
    #[must_use]
    pub fn connect_equiangular(&self, outgoing: &DirectionSample, light: LightDensities) -> Self {
        let drawn = 1.0 / light.eq;
        Self {
            contribution: self.contribution * (outgoing.value * drawn),
            uni: self.uni * (outgoing.density * drawn),
            nee: self.uni * (light.nee * drawn),
            eq: self.eq,
            ahead: self.ahead,
        }
    }

    /// Value of a walk that has reached a light; with the balance heuristics
    /// f_j / mean (p_uni + p_nee + p_eq).
    #[must_use]
    pub fn combined<R: Radiance<N>>(&self, radiance: R, light: LightDensities, heuristics: Heuristics) -> R {
        let densities = [self.uni, self.nee * light.nee, self.eq * light.eq];
        radiance * among_all(self.contribution, densities, heuristics)
    }

    /// Value of a connection from a vertex of the path.
    #[must_use]
    pub fn connected<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R {
        radiance * among_all(self.contribution, [self.nee, self.uni, self.eq], heuristics)
    }

    /// Value of a connection from a vertex drawn by equiangular sampling.
    #[must_use]
    pub fn connected_equiangular<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R {
        radiance * among_all(self.contribution, [self.eq, self.uni, self.nee], heuristics)
    }
}
