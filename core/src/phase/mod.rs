//! Phase functions: which way light scatters.
//!
//! **Direction convention, for the whole program:** both directions are directions of *propagation*,
//! `omega_in` before and `omega_out` after the event, so that `cos θ = omega_in · omega_out` and
//! g > 0 scatters forward. Values are per steradian and integrate to 1 over the sphere; every phase
//! function here is sampled exactly, so that its value is also its density.

mod doc;
mod henyey_greenstein;
mod isotropic;
mod rayleigh;
mod two_lobe;

use crate::math::{Frame, PolarAngle};
pub use doc::PhaseDoc;

use glam::{Vec2, Vec3};
use henyey_greenstein::HenyeyGreenstein;
use isotropic::Isotropic;
use rayleigh::Rayleigh;
use std::f32::consts::TAU;
use two_lobe::TwoLobe;

/// The contract of one phase function.
trait Lobe {
    /// Value and density, per steradian.
    fn value(&self, theta: PolarAngle) -> f32;
    /// Draws the scattering angle from a number uniform in [0, 1).
    fn sample(&self, u: f32) -> PolarAngle;
}

/// A phase function, ready to be evaluated and sampled.
#[derive(Clone, Copy, Debug)]
pub struct Phase(Kind);

#[derive(Clone, Copy, Debug)]
enum Kind {
    Isotropic(Isotropic),
    HenyeyGreenstein(HenyeyGreenstein),
    TwoLobe(TwoLobe),
    Rayleigh(Rayleigh),
}

macro_rules! each {
    ($self:ident, $lobe:ident => $body:expr) => {
        match &$self.0 {
            Kind::Isotropic($lobe) => $body,
            Kind::HenyeyGreenstein($lobe) => $body,
            Kind::TwoLobe($lobe) => $body,
            Kind::Rayleigh($lobe) => $body,
        }
    };
}

impl Phase {
    /// Freezes an edited phase function, whose parameters validation has checked.
    #[must_use]
    pub fn new(doc: &PhaseDoc) -> Self {
        Self(match *doc {
            PhaseDoc::Isotropic {} => Kind::Isotropic(Isotropic),
            PhaseDoc::HenyeyGreenstein { g } => Kind::HenyeyGreenstein(HenyeyGreenstein { g }),
            PhaseDoc::TwoLobe { g_forward, g_backward, forward } => Kind::TwoLobe(TwoLobe {
                first: HenyeyGreenstein { g: g_forward },
                second: HenyeyGreenstein { g: g_backward },
                share: forward,
            }),
            PhaseDoc::Rayleigh {} => Kind::Rayleigh(Rayleigh),
        })
    }

    /// Value by the cosine of the scattering angle, per steradian: to draw the lobe with.
    #[must_use]
    pub fn value(&self, cosine: f32) -> f32 {
        let theta = PolarAngle { one_minus_cos: 1.0 - cosine, one_plus_cos: 1.0 + cosine };
        self.at(theta)
    }

    fn at(&self, theta: PolarAngle) -> f32 {
        each!(self, lobe => lobe.value(theta))
    }

    /// Value and density of scattering from `omega_in` to `omega_out`, per steradian.
    #[must_use]
    pub fn density(&self, omega_in: Vec3, omega_out: Vec3) -> f32 {
        self.at(PolarAngle::between(omega_in, omega_out))
    }

    /// Draws the direction after scattering; its density is [`Self::density`].
    #[must_use]
    pub fn sample(&self, omega_in: Vec3, u: Vec2) -> (Vec3, f32) {
        let theta = each!(self, lobe => lobe.sample(u.x));
        let direction = Frame::about(omega_in).polar(theta, TAU * u.y);
        (direction, self.at(theta))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Sampler;

    fn all() -> Vec<(&'static str, Phase, f32)> {
        let hg = |g| Phase::new(&PhaseDoc::HenyeyGreenstein { g });
        vec![
            ("isotropic", Phase::new(&PhaseDoc::Isotropic {}), 0.0),
            ("hg .0", hg(0.0), 0.0),
            ("hg .7", hg(0.7), 0.7),
            ("hg -.6", hg(-0.6), -0.6),
            ("hg .9", hg(0.9), 0.9),
            ("hg .999", hg(0.999), 0.999),
            ("hg -.999", hg(-0.999), -0.999),
            (
                "two lobes",
                Phase::new(&PhaseDoc::TwoLobe { g_forward: 0.8, g_backward: -0.4, forward: 0.7 }),
                0.7 * 0.8 - 0.3 * 0.4,
            ),
            ("rayleigh", Phase::new(&PhaseDoc::Rayleigh {}), 0.0),
        ]
    }

    /// ∫ f(θ) over the sphere, by a substitution that crowds nodes at both poles, where lobes are sharp.
    fn integrate(f: impl Fn(PolarAngle) -> f64) -> f64 {
        let n = 200_000;
        let h = 1.0 / f64::from(n);
        let mut sum = 0.0;
        for i in 0..n {
            let s = (f64::from(i) + 0.5) * h;
            // 1 ∓ cos θ = s³ over half a sphere each.
            let theta = PolarAngle::from_one_minus_cos((s * s * s) as f32);
            sum += (f(theta) + f(theta.mirrored())) * 3.0 * s * s * h;
        }
        sum * std::f64::consts::TAU
    }

    #[test]
    fn every_phase_function_integrates_to_one_with_its_mean_cosine() {
        for (name, phase, g) in all() {
            let total = integrate(|t| f64::from(phase.at(t)));
            let cosine = integrate(|t| f64::from(phase.at(t)) * f64::from(t.cos()));
            assert!((total - 1.0).abs() < 2e-3, "{name}: ∫ = {total}");
            assert!((cosine - f64::from(g)).abs() < 2e-3, "{name}: mean cosine {cosine}");
        }
    }

    #[test]
    fn samples_follow_the_density() {
        let omega_in = Vec3::new(0.36, -0.48, 0.8);
        for (name, phase, _) in all() {
            // Bins of equal probability, by inverting the cumulative distribution numerically. Nodes in
            // cos θ crowd at both poles.
            let bins = 20usize;
            let steps = 400_000;
            let node = |s: f64| if s < 0.5 { 8.0 * s * s * s } else { 2.0 - 8.0 * (1.0 - s).powi(3) };
            let mut edges = Vec::new();
            let mut cumulative = 0.0;
            for i in 0..steps {
                let (a, b) = (f64::from(i) / f64::from(steps), f64::from(i + 1) / f64::from(steps));
                let m = node(0.5 * (a + b));
                let theta = match m < 1.0 {
                    true => PolarAngle::from_one_minus_cos(m as f32),
                    false => PolarAngle::from_one_plus_cos((8.0 * (1.0 - 0.5 * (a + b)).powi(3)) as f32),
                };
                cumulative += f64::from(phase.at(theta)) * std::f64::consts::TAU * (node(b) - node(a));
                if cumulative >= (edges.len() + 1) as f64 / bins as f64 && edges.len() + 1 < bins {
                    edges.push(theta);
                }
            }
            let mut counts = vec![0u32; bins];
            let n = 40_000u32;
            let mut sampler = Sampler::new(11, 0, 0);
            for _ in 0..n {
                let (omega_out, pdf) = phase.sample(omega_in, sampler.next_2d());
                let density = phase.density(omega_in, omega_out);
                // Rounding of the directions themselves shows in the sharpest lobes.
                assert!((pdf / density - 1.0).abs() < 0.05, "{name}: {pdf} is not {density}");
                let theta = PolarAngle::between(omega_in, omega_out);
                let below = |e: &PolarAngle| match e.one_minus_cos < 1.0 {
                    true => e.one_minus_cos < theta.one_minus_cos,
                    false => e.one_plus_cos > theta.one_plus_cos,
                };
                counts[edges.partition_point(below)] += 1;
            }
            let expected = f64::from(n) / bins as f64;
            let chi2: f64 = counts.iter().map(|c| (f64::from(*c) - expected).powi(2) / expected).sum();
            // 19 degrees of freedom, nine phase functions, fixed seed: the 0.99999 quantile is 59.
            assert!(chi2 < 59.0, "{name}: χ² = {chi2}");
        }
    }
}
