//! Draine 2003 (“Scattering by interstellar dust grains”, ApJ 598): Henyey–Greenstein times 1 + α cos² θ.
//!
//! ```text
//!   p(cos θ) = p_g(cos θ) (1 + α cos² θ) / (1 + α (1 + 2 g²)/3)
//! ```
//!
//! With α = 0 it is Henyey–Greenstein, with α = 1 Cornette and Shanks, and with α = 1, g = 0 Rayleigh.
//! Sampled by inverting the cumulative distribution, which means solving a quartic (Jendersie and d'Eon 2023,
//! “An Approximate Mie Scattering Function for Fog and Cloud Rendering”).
//!
//! With t² = 1 + g² − 2 g cos θ, from 1 + g (backward) to 1 − g (forward), the quartic is
//! t⁴ − 6 A t² + q t + r = 0, A = 1 + g², where only q depends on the random number, linearly.

use super::Lobe;
use super::henyey_greenstein::HenyeyGreenstein;
use crate::math::PolarAngle;

/// |g| below which the quartic's roots are too close together to be distinguished.
const SMALL_G: f64 = 0.01;
/// Step limit of Newton's method, which takes 3 to 8 steps; bisection alone converges within it.
const MAX_STEPS: usize = 48;
/// α below which the lobe equals Henyey–Greenstein in single precision.
const SMALL_ALPHA: f32 = 1e-7;

#[derive(Clone, Copy, Debug)]
pub(super) struct Draine {
    hg: HenyeyGreenstein,
    alpha: f32,
    /// Normalisation 1/(1 + α (1 + 2 g²)/3).
    scale: f32,
}

impl Draine {
    /// Creates the lobe; |g| < 1 and α ≥ 0.
    pub fn new(g: f32, alpha: f32) -> Self {
        Self { hg: HenyeyGreenstein { g }, alpha, scale: 1.0 / (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0) }
    }

    /// Angle from h = (1 + g − t)/g, which is 0 backward and 2 forward: cos θ = h − 1 + g h (2 − h)/2,
    /// without a division by g. Precise at both ends.
    fn angle(g: f64, h: f64) -> PolarAngle {
        let rest = 2.0 - h;
        PolarAngle {
            one_minus_cos: (rest * (1.0 - 0.5 * g * h)).max(0.0) as f32,
            one_plus_cos: (h * (1.0 + 0.5 * g * rest)).max(0.0) as f32,
        }
    }

    /// h for the random number u, from the quartic's root t = 1 + g − g h.
    fn by_quartic(g: f64, alpha: f64, u: f64) -> f64 {
        let a = 1.0 + g * g;
        let per_alpha = 12.0 * g * g / alpha;
        let r = -(3.0 * a * a + per_alpha);
        let minus_q = |t: f64| t * (t * t - 6.0 * a) + r / t;
        let (back, front) = (minus_q(1.0 + g), minus_q(1.0 - g));
        let q = -(back + (front - back) * u);
        // Ferrari's resolvent, y = z + 4 A, is z³ + e z + b = 0 with e > 0: one real root.
        let e = 4.0 * per_alpha;
        let half_b = 0.5 * (a * (64.0 * a * a + 4.0 * e) - q * q);
        let e3 = e / 3.0;
        let c = (half_b.abs() + (half_b * half_b + e3 * e3 * e3).sqrt()).cbrt();
        let z = (e3 / c - c).copysign(-half_b);
        let y = (z + 4.0 * a).max(0.0);
        let root = y.sqrt();
        let t = 0.5 * ((12.0 * a - y + 2.0 * q / root).max(0.0).sqrt() - root);
        (1.0 + g - t) / g
    }

    /// h for the random number u, by Newton's method from the root at g = 0; for small g.
    fn by_newton(g: f64, alpha: f64, u: f64) -> f64 {
        // cos³ θ + k cos θ = (1 + k)(2 u − 1), k = 3/α.
        let third = 1.0 / alpha;
        let half = (u - 0.5) * (1.0 + 3.0 * third);
        let c = (half.abs() + (half * half + third * third * third).sqrt()).cbrt();
        let mut h = 1.0 + (c - third / c).copysign(half);
        let total = 2.0 * (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0) / (1.0 - g * g);
        // The root stays bracketed: for large α Newton's steps may overshoot where the lobe is narrowest.
        let (mut lo, mut hi) = (0.0, 2.0);
        for _ in 0..MAX_STEPS {
            let t0 = 1.0 + g;
            let t = t0 - g * h;
            let cosine = h - 1.0 + 0.5 * g * h * (2.0 - h);
            let e = 2.0 - h * t0;
            let excess = h / (t * t0) * (1.0 + alpha * (e * e / 4.0 + t * t0 * h * h / 12.0)) - u * total;
            if excess < 0.0 {
                lo = h
            } else {
                hi = h
            }
            let newton = h - excess * (t * t) / (1.0 + alpha * cosine * cosine);
            let next = if newton > lo && newton < hi { newton } else { 0.5 * (lo + hi) };
            let step = (next - h).abs();
            h = next;
            if step < 1e-10 {
                break;
            }
        }
        h
    }
}

impl Lobe for Draine {
    fn value(&self, theta: PolarAngle) -> f32 {
        let cosine = theta.cos();
        self.hg.value(theta) * (1.0 + self.alpha * cosine * cosine) * self.scale
    }

    /// Samples in double precision, because the quartic's terms cancel by a factor of g³.
    #[inline(never)]
    fn sample(&self, u: f32) -> PolarAngle {
        if self.alpha < SMALL_ALPHA {
            return self.hg.sample(u);
        }
        let g = f64::from(self.hg.g.abs());
        let (alpha, u) = (f64::from(self.alpha), f64::from(u));
        let h = if g < SMALL_G { Self::by_newton(g, alpha, u) } else { Self::by_quartic(g, alpha, u) };
        let theta = Self::angle(g, h.clamp(0.0, 2.0));
        if self.hg.g < 0.0 { theta.mirrored() } else { theta }
    }

    /// Mean cosine g (1 + α (3 + 2 g²)/5) / (1 + α (1 + 2 g²)/3).
    fn mean_cosine(&self) -> f32 {
        let g = self.hg.g;
        g * (1.0 + self.alpha * (3.0 + 2.0 * g * g) / 5.0) * self.scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Integral of the lobe from the backward direction to h, in closed form without a division by g.
    fn below(g: f64, alpha: f64, h: f64) -> f64 {
        let (t0, t) = (1.0 + g, 1.0 + g - g * h);
        let even = 3.0 * (2.0 - h * t0).powi(2) + t * t0 * h * h;
        let total = 2.0 * (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0) / (1.0 - g * g);
        h / (t * t0) * (1.0 + alpha * even / 12.0) / total
    }

    #[test]
    fn the_closed_form_of_the_share_is_the_integral_of_the_value() {
        for (g, alpha) in [(0.0f32, 0.0f32), (0.0, 1.0), (0.3, 5.0), (0.9, 0.5), (0.6, 250.0)] {
            let lobe = Draine::new(g, alpha);
            for end in [0.1, 0.7, 1.0, 1.6, 2.0] {
                let n = 4000;
                let sum: f64 = (0..n)
                    .map(|i| {
                        let at = |h: f64| f64::from(Draine::angle(f64::from(g), h).one_plus_cos);
                        let step = end / f64::from(n);
                        let (a, b) = (at(step * f64::from(i)), at(step * f64::from(i + 1)));
                        let theta = PolarAngle::from_one_plus_cos((0.5 * (a + b)) as f32);
                        std::f64::consts::TAU * f64::from(lobe.value(theta)) * (b - a)
                    })
                    .sum();
                let closed = below(f64::from(g), f64::from(alpha), end);
                assert!((sum - closed).abs() < 2e-5, "g {g}, α {alpha}, {end}: {sum} {closed}");
            }
        }
    }

    #[test]
    fn sampling_inverts_the_share_for_every_parameter() {
        for g in [0.0, 1e-6, 1e-3, 0.009_99, 0.010_01, 0.05, 0.3, 0.7, 0.9, 0.99, 0.999] {
            for alpha in [1e-7, 1e-3, 0.1, 1.0, 20.0, 250.0, 1000.0] {
                for i in 0..=400 {
                    let u = f64::from(i) / 400.0;
                    let h = if g < SMALL_G {
                        Draine::by_newton(g, alpha, u)
                    } else {
                        Draine::by_quartic(g, alpha, u)
                    };
                    assert!(h.is_finite(), "g {g}, α {alpha}, u {u}");
                    let error = (below(g, alpha, h) - u).abs();
                    assert!(error < 1e-9, "g {g}, α {alpha}, u {u}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn without_alpha_it_is_henyey_greenstein_and_without_g_rayleigh() {
        let rayleigh = super::super::rayleigh::Rayleigh;
        for i in 0..=200u16 {
            let u = f32::from(i) / 200.0;
            let theta = PolarAngle::from_one_minus_cos(2.0 * u);
            for g in [-0.999, -0.4, 0.0, 0.7, 0.999] {
                let hg = HenyeyGreenstein { g };
                assert_eq!(Draine::new(g, 0.0).value(theta), hg.value(theta));
                assert_eq!(Draine::new(g, 0.0).sample(u), hg.sample(u));
            }
            let draine = Draine::new(0.0, 1.0);
            assert!((draine.value(theta) / rayleigh.value(theta) - 1.0).abs() < 1e-5);
            assert!((draine.sample(u).cos() - rayleigh.sample(u).cos()).abs() < 2e-6, "{u}");
        }
    }
}
