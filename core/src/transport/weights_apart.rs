//! Path weights by their definition: f, p_uni and p_nee, each as a separate product.
//!
//! This is the form of the report's algorithm 4, with the limitation stated in its section 5: in single
//! precision some forty collisions in a dense medium leave the range of the numbers. The value of the path is
//! then 0/0 or ∞/∞; the film counts such samples, locates them and leaves them out, which biases the
//! remaining estimate. Double precision lasts some eight times as long.
//!
//! Nothing is divided by the density P of the technique that made the path. In terms of pbrt-v4's
//! `beta`, `r_u` and `r_l`, the fields are `f` = `beta` P, `uni` = `r_u` P and `nee` = `r_l` P.

use super::heuristic::share;
use super::{Collision, DirectionSample, WalkWeights, WeightRecord, Weights};
use crate::scene::{Heuristic, Heuristics};
use crate::spectrum::{Radiance, Sampled};
use std::ops::{AddAssign, Div, Mul, MulAssign};

/// Floating-point type of the products.
pub trait Number:
    Copy + From<f32> + Mul<Output = Self> + MulAssign + AddAssign + Div<Output = Self> + PartialOrd
{
    /// One.
    const ONE: Self;
    /// Rounds to single precision.
    fn single(self) -> f32;
}

impl Number for f32 {
    const ONE: Self = 1.0;
    fn single(self) -> f32 {
        self
    }
}

impl Number for f64 {
    const ONE: Self = 1.0;
    fn single(self) -> f32 {
        self as f32
    }
}

/// f, p_uni and p_nee of a path.
#[derive(Clone, Copy, Debug)]
pub struct WeightsApart<T, const N: usize> {
    f: [T; N],
    uni: [T; N],
    nee: [T; N],
    /// Whether a coefficient was zero at every component; a product that underflows does not count as zero.
    dark: bool,
}

fn multiply<T: Number, const N: usize>(products: &mut [T; N], factors: Sampled<N>) {
    for (product, factor) in products.iter_mut().zip(factors.0) {
        *product *= T::from(factor);
    }
}

fn mean<T: Number, const N: usize>(values: [T; N]) -> T {
    let mut sum = T::from(0.0);
    for value in values {
        sum += value;
    }
    sum / T::from(N as f32)
}

impl<T: Number, const N: usize> WeightsApart<T, N> {
    /// f_j divided by a density, times a weight.
    fn over(&self, density: T, weight: f32) -> Sampled<N> {
        Sampled(self.f.map(|f| (f / density).single() * weight))
    }

    fn contributes(&mut self, factors: Sampled<N>) {
        multiply(&mut self.f, factors);
        self.dark |= factors.is_zero();
    }

    /// Weights the path by the heuristic over the heroes that could have made it, with densities `p`.
    fn among_heroes(&self, p: [T; N], weight: f32, heuristic: Heuristic) -> Sampled<N> {
        match heuristic {
            Heuristic::Balance => self.over(mean(p), weight),
            Heuristic::HeroOnly => {
                let mut hero = Sampled::ZERO;
                hero.0[0] = (self.f[0] / p[0]).single() * weight * N as f32;
                hero
            }
            Heuristic::Power | Heuristic::Maximum => {
                let relative = p.map(|density| (density / p[0]).single());
                self.over(p[0], weight * N as f32 * share(heuristic, relative[0], relative.into_iter()))
            }
        }
    }

    fn among_all(&self, [made, other]: [[T; N]; 2], heuristics: Heuristics) -> Sampled<N> {
        if heuristics == Heuristics::default() {
            let mut both = mean(made);
            both += mean(other);
            return self.over(both, 1.0);
        }
        let density = |p: [T; N]| if heuristics.components == Heuristic::HeroOnly { p[0] } else { mean(p) };
        let relative = [1.0, (density(other) / density(made)).single()];
        let of_technique = share(heuristics.techniques, relative[0], relative.into_iter());
        self.among_heroes(made, of_technique, heuristics.components)
    }
}

impl<T: Number, const N: usize> WalkWeights<N> for WeightsApart<T, N> {
    const CAMERA: Self = Self { f: [T::ONE; N], uni: [T::ONE; N], nee: [T::ONE; N], dark: false };

    fn pass(&mut self, optical_depth: Sampled<N>) {
        let transmittance = (-optical_depth).exp();
        for products in [&mut self.f, &mut self.uni, &mut self.nee] {
            multiply(products, transmittance);
        }
    }

    fn null(&mut self, c: &Collision<N>) {
        self.contributes(c.coefficients.null);
        multiply(&mut self.uni, c.null_density);
        multiply(&mut self.nee, c.coefficients.majorant);
    }

    fn null_by_ratio(&mut self, c: &Collision<N>) {
        self.null(c);
    }

    fn scatter(&mut self, c: &Collision<N>) {
        self.contributes(c.coefficients.scattering);
        multiply(&mut self.uni, c.scattering_density);
    }

    fn reflect(&mut self, albedo: Sampled<N>) {
        self.contributes(albedo);
    }

    fn choose_direction(&mut self, outgoing: &DirectionSample) {
        self.nee = self.uni;
        multiply(&mut self.f, Sampled::splat(outgoing.value));
        multiply(&mut self.uni, Sampled::splat(outgoing.density));
    }

    fn leave(&mut self, value: Sampled<N>, density: Sampled<N>, connects: bool) {
        self.nee = self.uni;
        if !connects {
            multiply(&mut self.nee, Sampled::ZERO);
        }
        self.adjust(value, density);
    }

    fn adjust(&mut self, value: Sampled<N>, density: Sampled<N>) {
        self.contributes(value);
        multiply(&mut self.uni, density);
    }

    fn emitted<R: Radiance<N>>(&self, radiance: R, c: &Collision<N>, heuristics: Heuristics) -> R {
        let mut end = *self;
        end.contributes(c.coefficients.absorption);
        multiply(&mut end.uni, c.tentative);
        radiance * end.among_heroes(end.uni, 1.0, heuristics.components)
    }

    fn survive(&mut self, q: f32) {
        multiply(&mut self.f, Sampled::splat(1.0 / q));
    }

    fn throughput(&self) -> f32 {
        self.over(mean(self.uni), 1.0).abs().max_component()
    }

    fn weight_record(&self) -> WeightRecord {
        let [f, uni, nee] = [self.f, self.uni, self.nee].map(|of| Sampled(of.map(T::single)).lanes());
        WeightRecord { names: ["f", "p_uni", "p_nee"], values: [f, uni, nee] }
    }

    fn is_zero(&self) -> bool {
        self.dark
    }

    fn unidirectional<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R {
        radiance * self.among_heroes(self.uni, 1.0, heuristics.components)
    }
}

impl<T: Number, const N: usize> Weights<N> for WeightsApart<T, N> {
    fn connect(&self, outgoing: &DirectionSample, light_density: f32) -> Self {
        let mut link = *self;
        link.nee = self.uni;
        multiply(&mut link.f, Sampled::splat(outgoing.value));
        multiply(&mut link.uni, Sampled::splat(outgoing.density));
        multiply(&mut link.nee, Sampled::splat(light_density));
        link
    }

    fn attenuate(&mut self, transmittance: Sampled<N>) {
        self.contributes(transmittance);
    }

    fn connected_only<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R {
        radiance * self.among_heroes(self.nee, 1.0, heuristics.components)
    }

    fn combined<R: Radiance<N>>(&self, radiance: R, light_density: f32, heuristics: Heuristics) -> R {
        let mut nee = self.nee;
        multiply(&mut nee, Sampled::splat(light_density));
        radiance * self.among_all([self.uni, nee], heuristics)
    }

    fn connected_combined<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R {
        radiance * self.among_all([self.nee, self.uni], heuristics)
    }
}
