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

use crate::math::Frame;
pub use doc::PhaseDoc;

use glam::{Vec2, Vec3};
use henyey_greenstein::HenyeyGreenstein;
use isotropic::Isotropic;
use rayleigh::Rayleigh;
use std::f32::consts::TAU;
use two_lobe::TwoLobe;

/// The contract of one phase function. Angles come as 1 − cos θ, which keeps its digits near 0.
trait Lobe {
    /// Value and density, per steradian.
    fn value(&self, one_minus_cos: f32) -> f32;
    /// Draws 1 − cos θ from a number uniform in [0, 1).
    fn sample(&self, u: f32) -> f32;
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
            PhaseDoc::Isotropic => Kind::Isotropic(Isotropic),
            PhaseDoc::HenyeyGreenstein { g } => Kind::HenyeyGreenstein(HenyeyGreenstein { g }),
            PhaseDoc::TwoLobe { g_forward, g_backward, forward } => Kind::TwoLobe(TwoLobe {
                first: HenyeyGreenstein { g: g_forward },
                second: HenyeyGreenstein { g: g_backward },
                share: forward,
            }),
            PhaseDoc::Rayleigh => Kind::Rayleigh(Rayleigh),
        })
    }

    /// Value by the cosine of the scattering angle, per steradian: to draw the lobe with.
    #[must_use]
    pub fn value(&self, cosine: f32) -> f32 {
        each!(self, lobe => lobe.value(1.0 - cosine))
    }

    /// Value and density of scattering from `omega_in` to `omega_out`, per steradian.
    #[must_use]
    pub fn density(&self, omega_in: Vec3, omega_out: Vec3) -> f32 {
        // |a − b|²/2 = 1 − a·b for unit vectors, without the cancellation.
        let one_minus_cos = 0.5 * (omega_out - omega_in).length_squared();
        each!(self, lobe => lobe.value(one_minus_cos))
    }

    /// Draws the direction after scattering; its density is [`Self::density`].
    #[must_use]
    pub fn sample(&self, omega_in: Vec3, u: Vec2) -> (Vec3, f32) {
        let one_minus_cos = each!(self, lobe => lobe.sample(u.x));
        let direction = Frame::about(omega_in).polar(one_minus_cos, TAU * u.y);
        (direction, each!(self, lobe => lobe.value(one_minus_cos)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Sampler;

    fn all() -> Vec<(&'static str, Phase, f32)> {
        let hg = |g| Phase::new(&PhaseDoc::HenyeyGreenstein { g });
        vec![
            ("isotropic", Phase::new(&PhaseDoc::Isotropic), 0.0),
            ("hg .0", hg(0.0), 0.0),
            ("hg .7", hg(0.7), 0.7),
            ("hg -.6", hg(-0.6), -0.6),
            ("hg .9", hg(0.9), 0.9),
            (
                "two lobes",
                Phase::new(&PhaseDoc::TwoLobe { g_forward: 0.8, g_backward: -0.4, forward: 0.7 }),
                0.7 * 0.8 - 0.3 * 0.4,
            ),
            ("rayleigh", Phase::new(&PhaseDoc::Rayleigh), 0.0),
        ]
    }

    /// ∫ f over the sphere, by the substitution that crowds nodes where a forward lobe is sharp.
    fn integrate(f: impl Fn(f32) -> f64) -> f64 {
        let n = 200_000;
        let h = 1.0 / f64::from(n);
        (0..n)
            .map(|i| {
                let s = (f64::from(i) + 0.5) * h;
                let one_minus_cos = 2.0 * s * s * s;
                f((1.0 - one_minus_cos) as f32) * 6.0 * s * s * h
            })
            .sum::<f64>()
            * std::f64::consts::TAU
    }

    #[test]
    fn every_phase_function_integrates_to_one_with_its_mean_cosine() {
        for (name, phase, g) in all() {
            let total = integrate(|c| f64::from(phase.value(c)));
            let cosine = integrate(|c| f64::from(phase.value(c)) * f64::from(c));
            assert!((total - 1.0).abs() < 2e-3, "{name}: ∫ = {total}");
            assert!((cosine - f64::from(g)).abs() < 2e-3, "{name}: mean cosine {cosine}");
        }
    }

    #[test]
    fn samples_follow_the_density() {
        let omega_in = Vec3::new(0.36, -0.48, 0.8);
        for (name, phase, _) in all() {
            // Bins of equal probability by numerical inversion of the cumulative distribution.
            let bins = 20usize;
            let steps = 400_000;
            let mut edges = Vec::new();
            let mut cumulative = 0.0;
            for i in 0..steps {
                let m = 2.0 * (f64::from(i) + 0.5) / f64::from(steps);
                cumulative +=
                    f64::from(phase.value((1.0 - m) as f32)) * std::f64::consts::TAU * 2.0 / f64::from(steps);
                if cumulative >= (edges.len() + 1) as f64 / bins as f64 && edges.len() + 1 < bins {
                    edges.push(m);
                }
            }
            let mut counts = vec![0u32; bins];
            let n = 40_000u32;
            let mut sampler = Sampler::new(11, 0, 0);
            for _ in 0..n {
                let (omega_out, pdf) = phase.sample(omega_in, sampler.next_2d());
                let density = phase.density(omega_in, omega_out);
                assert!((pdf / density - 1.0).abs() < 0.02, "{name}: {pdf} is not {density}");
                let m = f64::from(0.5 * (omega_out - omega_in).length_squared());
                counts[edges.partition_point(|e| *e < m)] += 1;
            }
            let expected = f64::from(n) / bins as f64;
            let chi2: f64 = counts.iter().map(|c| (f64::from(*c) - expected).powi(2) / expected).sum();
            // 19 degrees of freedom, seven phase functions, fixed seed: the 0.99999 quantile is 59.
            assert!(chi2 < 59.0, "{name}: χ² = {chi2}");
        }
    }
}
