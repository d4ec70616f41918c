//! Approximate Mie scattering by water droplets of one diameter in visible light.
//!
//! A fit to Lorenz–Mie theory by a Henyey–Greenstein lobe for diffraction and a Draine lobe for the remainder
//! (Jendersie and d'Eon 2023, “An Approximate Mie Scattering Function for Fog and Cloud Rendering”, equations
//! 4 and 7–22).
//!
//! ```text
//!   p = (1 − w) p_HG(g_HG) + w p_Draine(g_D, α),   all four parameters functions of the diameter
//! ```

use super::Lobe;
use super::draine::Draine;
use super::henyey_greenstein::HenyeyGreenstein;
use crate::math::PolarAngle;

#[derive(Clone, Copy, Debug)]
pub(super) struct Mie {
    diffracted: HenyeyGreenstein,
    refracted: Draine,
    /// Weight w of the second lobe, 0 to 1.
    share: f32,
}

/// Fitted parameters of both lobes.
#[derive(Clone, Copy, Debug)]
struct Fit {
    g_hg: f64,
    g_draine: f64,
    alpha: f64,
    share: f64,
}

impl Fit {
    /// Fit for droplets of a diameter in micrometres, 0 < d ≤ 50. The pieces are only roughly continuous.
    fn of(d: f64) -> Self {
        let l = d.ln();
        if d <= 0.1 {
            Self {
                g_hg: 13.8 * d * d,
                g_draine: 1.1456 * d * (9.29044 * d).sin(),
                alpha: 250.0,
                share: 0.252977 - 312.983 * d.powf(4.3),
            }
        } else if d < 1.5 {
            let inner = (l - 0.238604) * (l + 1.00667) / (0.507522 - 0.15677 * l);
            Self {
                g_hg: 0.862 - 0.143 * l * l,
                g_draine: 0.379685 * (1.19692 * inner.cos() + 1.37932 * l + 0.0625835).cos() + 0.344213,
                alpha: 250.0,
                share: 0.146209 * (3.38707 * l + 2.11193).cos() + 0.316072 + 0.0778917 * l,
            }
        } else if d < 5.0 {
            Self {
                g_hg: 0.0604931 * l.ln() + 0.940256,
                g_draine: 0.500411 - 0.081287 / (l.tan() - 2.0 * l + 1.27551),
                alpha: 7.30354 * l + 6.31675,
                share: 0.026914 * (l - (5.68947 * (l.ln() - 0.0292149)).cos()) + 0.376475,
            }
        } else {
            Self {
                g_hg: (-0.0990567 / (d - 1.67154)).exp(),
                g_draine: (-2.20679 / (d + 3.91029) - 0.428934).exp(),
                alpha: (3.62489 - 8.29288 / (d + 5.52825)).exp(),
                share: (-0.599085 / (d - 0.641583) - 0.665888).exp(),
            }
        }
    }
}

impl Mie {
    /// Creates the phase function of droplets of a diameter in micrometres, 0 < d ≤ 50.
    pub fn new(diameter_um: f32) -> Self {
        let fit = Fit::of(f64::from(diameter_um));
        Self {
            diffracted: HenyeyGreenstein { g: fit.g_hg as f32 },
            refracted: Draine::new(fit.g_draine as f32, fit.alpha as f32),
            share: fit.share as f32,
        }
    }
}

impl Lobe for Mie {
    fn value(&self, theta: PolarAngle) -> f32 {
        self.share * self.refracted.value(theta) + (1.0 - self.share) * self.diffracted.value(theta)
    }

    /// Selects a lobe and reuses the remainder of the random number to sample it.
    fn sample(&self, u: f32) -> PolarAngle {
        if u < self.share {
            self.refracted.sample(u / self.share)
        } else {
            self.diffracted.sample(((u - self.share) / (1.0 - self.share)).min(1.0))
        }
    }

    fn mean_cosine(&self) -> f32 {
        self.share * self.refracted.mean_cosine() + (1.0 - self.share) * self.diffracted.mean_cosine()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[derive(Clone, Copy)]
    struct Complex(f64, f64);

    impl Complex {
        fn over(self, b: Self) -> Self {
            let n = b.0 * b.0 + b.1 * b.1;
            Self((self.0 * b.0 + self.1 * b.1) / n, (self.1 * b.0 - self.0 * b.1) / n)
        }
        /// Re(a b*).
        fn dot(self, b: Self) -> f64 {
            self.0 * b.0 + self.1 * b.1
        }
    }

    /// Coefficients a_n and b_n of a sphere of real index `m` and size parameter x: Lorenz–Mie theory as in
    /// Bohren and Huffman 1983, chapter 4, with D_n by downward recurrence.
    fn series(m: f64, x: f64) -> Vec<(Complex, Complex)> {
        let terms = (x + 4.05 * x.cbrt() + 2.0) as usize;
        let start = terms.max((m * x) as usize) + 16;
        let mut d = vec![0.0; start + 1];
        for n in (1..=start).rev() {
            let r = n as f64 / (m * x);
            d[n - 1] = r - 1.0 / (d[n] + r);
        }
        // Riccati–Bessel functions ψ and χ.
        let (mut psi, mut psi_before) = (x.sin(), x.cos());
        let (mut chi, mut chi_before) = (x.cos(), -x.sin());
        (1..=terms)
            .map(|n| {
                let k = n as f64;
                (psi_before, psi) = (psi, (2.0 * k - 1.0) / x * psi - psi_before);
                (chi_before, chi) = (chi, (2.0 * k - 1.0) / x * chi - chi_before);
                let coefficient = |f: f64| {
                    let top = f * psi - psi_before;
                    Complex(top, 0.0).over(Complex(top, -(f * chi - chi_before)))
                };
                (coefficient(d[n] / m + k / x), coefficient(d[n] * m + k / x))
            })
            .collect()
    }

    /// Scattering efficiency, and its product with the mean cosine.
    fn moments(x: f64, series: &[(Complex, Complex)]) -> (f64, f64) {
        let (mut scattered, mut forward) = (0.0, 0.0);
        let mut last: Option<(Complex, Complex)> = None;
        for (n, (a, b)) in (1..).zip(series.iter().copied()) {
            let k = f64::from(n);
            scattered += (2.0 * k + 1.0) * (a.dot(a) + b.dot(b));
            forward += (2.0 * k + 1.0) / (k * (k + 1.0)) * a.dot(b);
            if let Some((a1, b1)) = last {
                let j = k - 1.0;
                forward += j * (j + 2.0) / (j + 1.0) * (a1.dot(a) + b1.dot(b));
            }
            last = Some((a, b));
        }
        (2.0 / (x * x) * scattered, 4.0 / (x * x) * forward)
    }

    /// Intensity |S₁|² + |S₂|² of unpolarised light at a cosine.
    fn intensity(series: &[(Complex, Complex)], cosine: f64) -> f64 {
        let (mut pi, mut pi_before) = (1.0, 0.0);
        let (mut s1, mut s2) = ([0.0; 2], [0.0; 2]);
        for (n, (a, b)) in (1..).zip(series.iter().copied()) {
            let k = f64::from(n);
            let tau = k * cosine * pi - (k + 1.0) * pi_before;
            let w = (2.0 * k + 1.0) / (k * (k + 1.0));
            for (part, (a, b)) in [(a.0, b.0), (a.1, b.1)].into_iter().enumerate() {
                s1[part] += w * (a * pi + b * tau);
                s2[part] += w * (a * tau + b * pi);
            }
            (pi_before, pi) = (pi, ((2.0 * k + 1.0) * cosine * pi - (k + 1.0) * pi_before) / k);
        }
        s1.into_iter().chain(s2).map(|s| s * s).sum()
    }

    /// Mean cosine, and the phase function at some cosines, of droplets in visible light, averaged over 400
    /// to 700 nm and over diameters within a tenth, which smooths out resonances.
    fn theory(diameter_um: f64, cosines: &[f64]) -> (f64, Vec<f64>) {
        let (mut all, mut forward) = (0.0, 0.0);
        let mut at = vec![0.0; cosines.len()];
        for i in 0..15 {
            for j in 0..11 {
                let lambda_um = 0.41 + 0.02 * f64::from(i);
                let x = PI * diameter_um * (0.9 + 0.02 * f64::from(j)) / lambda_um;
                let lambda2 = lambda_um * lambda_um;
                let series = series(1.334, x);
                // Cross sections: Q x² λ²/(4 π); dC/dω = λ²/(8 π²) (|S₁|² + |S₂|²).
                let (scattered, part) = moments(x, &series);
                all += scattered * x * x * lambda2 / (4.0 * PI);
                forward += part * x * x * lambda2 / (4.0 * PI);
                for (value, cosine) in at.iter_mut().zip(cosines) {
                    *value += lambda2 / (8.0 * PI * PI) * intensity(&series, *cosine);
                }
            }
        }
        (forward / all, at.into_iter().map(|value| value / all).collect())
    }

    #[test]
    fn the_series_has_its_published_values() {
        // Small spheres are in the Rayleigh regime: Q = 8/3 x⁴ ((m² − 1)/(m² + 2))².
        let (q, forward) = moments(0.01, &series(1.33, 0.01));
        let expected = 8.0 / 3.0 * 1e-8 * ((1.33f64.powi(2) - 1.0) / (1.33f64.powi(2) + 2.0)).powi(2);
        assert!((q / expected - 1.0).abs() < 1e-3 && forward / q < 1e-3);
        // Wiscombe 1979, Mie Scattering Calculations: m = 1.5, x = 10: Q = 2.881999, g = 0.742913.
        let (q, forward) = moments(10.0, &series(1.5, 10.0));
        assert!((q - 2.881999).abs() < 1e-5 && (forward / q - 0.742913).abs() < 1e-5, "{q} {}", forward / q);
        // The intensity integrates to the cross section.
        let n = 4000;
        let cosines: Vec<f64> = (0..n).map(|i| 2.0 * (f64::from(i) + 0.5) / f64::from(n) - 1.0).collect();
        let (_, values) = theory(3.0, &cosines);
        let integral = 2.0 * PI * values.iter().sum::<f64>() * 2.0 / f64::from(n);
        assert!((integral - 1.0).abs() < 1e-3, "{integral}");
    }

    /// The lobe's shape is fitted, not its mean cosine, which is up to 0.02 too large for fog and clouds, and
    /// off by up to 0.16 where the diameter is near half a wavelength.
    #[test]
    fn the_mean_cosine_is_near_that_of_lorenz_and_mie() {
        for (diameters, tolerance) in [
            (&[5.0, 5.5, 8.0, 10.0, 20.0, 30.0, 50.0][..], 0.02),
            (&[1.0, 1.4, 1.6, 2.0, 3.0, 4.5][..], 0.06),
            (&[0.01, 0.02, 0.05, 0.1, 0.2, 0.5][..], 0.16),
        ] {
            for d in diameters {
                let (fit, (theory, _)) = (f64::from(Mie::new(*d as f32).mean_cosine()), theory(*d, &[]));
                assert!((fit - theory).abs() < tolerance, "{d} µm: {fit} {theory}");
            }
        }
    }

    /// Error in decades, over angles from 5° to 130°; beyond are rainbow and glory, which two lobes cannot
    /// represent.
    #[test]
    fn the_lobe_has_the_shape_of_lorenz_and_mie() {
        let cosines: Vec<f64> = (1..=26).map(|i| (5.0 * f64::from(i)).to_radians().cos()).collect();
        for d in [0.01, 0.5, 1.0, 3.0, 5.0, 8.0, 10.0, 20.0, 50.0] {
            let lobe = Mie::new(d as f32);
            let (_, values) = theory(d, &cosines);
            let squares = cosines.iter().zip(&values).map(|(c, value)| {
                let theta = PolarAngle { one_minus_cos: (1.0 - c) as f32, one_plus_cos: (1.0 + c) as f32 };
                (f64::from(lobe.value(theta)) / value).log10().powi(2)
            });
            let rms = (squares.sum::<f64>() / cosines.len() as f64).sqrt();
            assert!(rms < 0.2, "{d} µm: {rms} decades");
        }
    }

    #[test]
    fn tiny_droplets_scatter_as_molecules_do() {
        let (lobe, rayleigh) = (Mie::new(0.001), super::super::rayleigh::Rayleigh);
        for i in 0..=20u8 {
            let theta = PolarAngle::from_one_minus_cos(f32::from(i) / 10.0);
            assert!((lobe.value(theta) / rayleigh.value(theta) - 1.0).abs() < 0.02, "{theta:?}");
        }
    }

    #[test]
    fn every_diameter_gives_two_lobes() {
        for i in 1..=50_000u32 {
            let d = i as f32 * 1e-3;
            let Mie { diffracted, refracted, share } = Mie::new(d);
            assert!((0.0..=1.0).contains(&share), "{d}: {share}");
            assert!(diffracted.g.abs() < 1.0 && refracted.mean_cosine().abs() < 1.0, "{d}");
        }
    }
}
