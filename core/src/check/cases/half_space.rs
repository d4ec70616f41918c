//! Reflection of a half-space: multiple scattering and absorption with a known answer.
//!
//! A half-space with isotropic scattering and albedo a is lit by radiance 1 from every direction above it.
//! The radiance reflected along the normal is Chandrasekhar's (*Radiative Transfer*, 1960, §§ 33–38)
//!
//! ```text
//!   R = 1 − √(1 − a) H(1),     1/H(μ) = √(1 − a) + (a/2) ∫₀¹ μ′ H(μ′) / (μ + μ′) dμ′
//! ```
//!
//! which is also the escape probability of a photon that enters along the normal. It does not depend on the
//! extinction, so that components may differ in extinction by any ratio: a hundredfold here. The half-space
//! is a box of at least 20 mean free paths in depth and 60 across. With a ≤ 0.95, radiance decays by at least
//! 0.38 per mean free path, to e^(−15) on the way down and back, so that the truncation is not measurable.

use super::super::truth::{self, Points};
use super::super::{Answer, Case, CheckError, Family, Layout};
use super::{AXIS, BY_HERO, UNIDIRECTIONAL_AND_FULL};
use crate::scene::{Absorption, CoefficientsDoc};
use crate::spectrum::SpectrumDoc;

pub(super) const FAMILY: Family = Family {
    id: "half-space",
    about: "Multiple scattering in a half-space: Chandrasekhar's H function gives the reflected radiance.",
    deep_only: false,
    cases,
};

const NODES: usize = 64;

/// Reflected radiance R for an albedo.
fn escape(albedo: f64) -> f64 {
    // H rises steeply at 0; with μ = s², midpoint nodes in s are dense there.
    let mu: Vec<f64> = (0..NODES).map(|i| ((i as f64 + 0.5) / NODES as f64).powi(2)).collect();
    let weight = |i: usize| 2.0 * mu[i].sqrt() / NODES as f64;
    let root = (1.0 - albedo).sqrt();
    let mut h = vec![1.0f64; NODES];
    let at = |m: f64, h: &[f64]| {
        let integral: f64 = (0..NODES).map(|i| weight(i) * mu[i] * h[i] / (m + mu[i])).sum();
        1.0 / (root + 0.5 * albedo * integral)
    };
    for _ in 0..60 {
        h = mu.iter().map(|m| at(*m, &h)).collect();
    }
    1.0 - root * at(1.0, &h)
}

/// Albedo of an isotropic half-space that reflects the fraction A of diffuse light, by van de Hulst's formula
/// A = (1 − s)(1 − 0.139 s)/(1 + 1.17 s), s = √(1 − albedo), solved by bisection.
fn albedo_of(colour: f64) -> f64 {
    let (mut lo, mut hi) = (0.0f64, 1.0f64);
    for _ in 0..60 {
        let s = 0.5 * (lo + hi);
        if (1.0 - s) * (1.0 - 0.139 * s) / (1.0 + 1.17 * s) > colour { lo = s } else { hi = s }
    }
    1.0 - lo * lo
}

fn cases() -> Result<Vec<Case>, CheckError> {
    let toml = |extinction: &str, albedo: &str, mode: &str| {
        format!(
            "{AXIS}
            [medium]
            extinction = {extinction}
            albedo = {albedo}
            placement = {{ scale = [60.0, 60.0, 20.0], translate = [0.0, 0.0, -10.0] }}
            [[lights]]
            kind = \"environment\"
            [estimator]
            mode = \"{mode}\""
        )
    };
    let albedo = [0.95, 0.3, 0.8];
    let answer = Answer::uniform(albedo.map(escape), Layout::WHOLE);
    let rgb = toml("{ rgb = [1.0, 100.0, 10.0] }", "{ rgb = [0.95, 0.3, 0.8] }", "rgb");
    let rgb = Case::new("half-space/rgb", &rgb, answer)?;
    let grey = rgb.varied("half-space/weighted", |doc| {
        // Without roulette a path ends when it leaves the box, or when its weight underflows.
        doc.medium_mut().extinction = SpectrumDoc::Constant(1.0);
    });
    let points = Points(&[(400.0, 0.3), (700.0, 0.95)]);
    let table: Vec<f64> = (0..=100).map(|i| escape(f64::from(i) / 100.0)).collect();
    let seen = truth::film(|l| {
        let x = points.at(l) * 100.0;
        let i = x as usize;
        table[i] + (table[i + 1] - table[i]) * (x - i as f64)
    });
    let nm = toml("\"430:2, 540:40, 600:1\"", &points.toml(), "spectral");
    let nm = Case::new("half-space/spectral", &nm, Answer::uniform(seen, Layout::WHOLE).within(2e-4))?;
    // The same coefficients in other parametrisations: σa and σs; mean free path and diffuse reflectance.
    let sums = rgb.varied("half-space/absorption-scattering", |doc| {
        doc.medium_mut().coefficients = Some(CoefficientsDoc::AbsorptionScattering {
            absorption: SpectrumDoc::Rgb([0.05, 70.0, 2.0]),
            scattering: SpectrumDoc::Rgb([0.95, 30.0, 8.0]),
        });
    });
    let colour = [0.6, 0.1, 0.3];
    let coloured = rgb
        .varied("half-space/colour", |doc| {
            doc.medium_mut().coefficients = Some(CoefficientsDoc::MeanFreePathColour {
                mean_free_path: SpectrumDoc::Rgb([1.0, 0.01, 0.1]),
                colour: SpectrumDoc::Rgb(colour.map(|c| c as f32)),
            });
        })
        .answered(Answer::uniform(colour.map(|c| escape(albedo_of(c))), Layout::WHOLE));
    Ok(vec![
        sums.among(&UNIDIRECTIONAL_AND_FULL),
        coloured.among(&UNIDIRECTIONAL_AND_FULL),
        rgb.varied("half-space/chromatic-analogue", |doc| doc.estimator.absorption = Absorption::Analogue)
            .among(&UNIDIRECTIONAL_AND_FULL),
        rgb.varied("half-space/chromatic-roulette", |doc| doc.estimator.roulette_depth = Some(1))
            .among(&UNIDIRECTIONAL_AND_FULL),
        nm.varied("half-space/spectral-roulette", |doc| doc.estimator.roulette_depth = Some(2))
            .among(&BY_HERO),
        grey,
    ])
}

#[cfg(test)]
mod tests {
    use super::escape;

    /// H(1) by its integral representation instead of its equation:
    /// ln H(μ) = −(μ/π) ∫₀^∞ ln(1 − a arctan(t)/t) / (1 + μ² t²) dt, here with t = tan θ and μ = 1.
    fn h_at_1(albedo: f64) -> f64 {
        let quarter = std::f64::consts::FRAC_PI_2;
        let integral = quarter
            * crate::check::truth::integrate(20_000, |u| {
                let theta = quarter * u;
                (1.0 - albedo * theta / theta.tan()).ln()
            });
        (-integral / std::f64::consts::PI).exp()
    }

    #[test]
    fn escape_agrees_with_the_integral_representation_of_h() {
        assert!(escape(0.0).abs() < 1e-12);
        // Chandrasekhar's table: H(1) is 2.9078 for albedo 1.
        assert!((h_at_1(1.0 - 1e-9) - 2.9078).abs() < 1e-3);
        for albedo in [0.3f64, 0.5, 0.8, 0.95, 0.99] {
            let h = (1.0 - escape(albedo)) / (1.0 - albedo).sqrt();
            assert!((h / h_at_1(albedo) - 1.0).abs() < 1e-4, "{albedo}: {h} {}", h_at_1(albedo));
        }
    }
}
