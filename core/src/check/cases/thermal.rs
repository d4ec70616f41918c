//! Thermal emission of an absorbing medium.
//!
//! Kirchhoff's law: absorption σa implies emission σa B(T). A ray through an absorbing slab of constant
//! temperature receives L = B (1 − e^(−τ)), the solution of dL = σ (B − L) ds with L = 0 at the start. In
//! surroundings at the temperature of the medium every ray receives B for any scattering: emission and
//! absorption balance everywhere. Planck's law is evaluated in double precision, B(λ, T) relative to 3000 K
//! at 560 nm; the surroundings use it at points every 2 nm.

use super::super::truth::{self, Points};
use super::super::{Answer, Case, CheckError, Family, Layout};
use super::{ASIDE, AXIS};
use crate::scene::{Absorption, LightDoc, Mode};
use crate::spectrum::{Quantity, Spectrum, SpectrumDoc};

pub(super) const FAMILY: Family = Family {
    id: "thermal",
    about: "An emissive medium: Kirchhoff's law in a slab, and in surroundings at its own temperature.",
    deep_only: false,
    cases,
};

const SIGMA: Points = Points(&[(400.0, 0.3), (500.0, 1.5), (560.0, 0.5), (700.0, 1.0)]);

pub(super) fn planck(lambda_nm: f64, kelvin: f64) -> f64 {
    let occupation = |lambda: f64, t: f64| 1.0 / ((1.438_776_877e7 / (lambda * t)).exp() - 1.0);
    (560.0 / lambda_nm).powi(5) * occupation(lambda_nm, kelvin) / occupation(560.0, 3000.0)
}

fn cases() -> Result<Vec<Case>, CheckError> {
    let slab = |kelvin: f64| {
        let toml = format!(
            "{AXIS}
            [medium]
            albedo = 0.0
            extinction = {}
            emission = {{ kelvin = {kelvin:?}, scale = 2.0 }}",
            SIGMA.toml()
        );
        let colour = truth::film(|l| 2.0 * planck(l, kelvin) * (1.0 - (-SIGMA.at(l)).exp()));
        Case::new(format!("thermal/slab-{kelvin}"), &toml, Answer::uniform(colour, Layout::WHOLE))
    };
    let points: Vec<_> = (0..=235u16)
        .map(|i| 360 + 2 * i)
        .map(|l| format!("{l}:{:.7}", planck(f64::from(l), 3500.0)))
        .collect();
    let balance = format!(
        "{ASIDE}
        [medium]
        albedo = 0.7
        extinction = \"450:2, 550:6\"
        phase = {{ kind = \"henyey-greenstein\", g = 0.4 }}
        emission = {{ kelvin = 3500.0 }}
        [[lights]]
        kind = \"environment\"
        radiance = \"{}\"",
        points.join(", ")
    );
    let colour = truth::film(|l| planck(l, 3500.0));
    let balance = Case::new("thermal/balance", &balance, Answer::Agreement)?.in_blocks(2, 2);
    let layout = balance.layout;
    let surroundings = match balance.doc.lights.first() {
        Some(LightDoc::Environment { radiance, .. }) => Spectrum::new(radiance, Quantity::Radiance),
        _ => Spectrum::constant(0.0),
    };
    let balance = balance.answered(Answer::uniform(colour, layout));
    Ok(vec![
        slab(2500.0)?,
        slab(6000.0)?,
        balance.varied("thermal/balance-analogue", |doc| doc.estimator.absorption = Absorption::Analogue),
        balance.varied("thermal/balance-grey", |doc| {
            doc.medium_mut().extinction = SpectrumDoc::Constant(3.0);
        }),
        // Expected colour of the surroundings in RGB mode; the case checks that the emission of the medium
        // equals it.
        balance
            .varied("thermal/balance-rgb", |doc| doc.estimator.mode = Mode::Rgb)
            .answered(Answer::uniform(surroundings.rgb().as_dvec3().to_array(), layout)),
        balance,
    ])
}
