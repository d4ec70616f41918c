//! Parametrisations of a medium's coefficients, and conversions between them.
//!
//! All are given for density 1; the medium's scale and density multiply the extinction.

use super::MediumDoc;
use crate::medium::{diffuse_albedo, single_scattering_albedo};
use crate::spectrum::{
    ControlPoint, LAMBDA_MAX_NM, LAMBDA_MIN_NM, Outside, Quantity, Rule, Spectrum, SpectrumDoc,
};
use serde::{Deserialize, Serialize};

/// Coefficients given otherwise than by extinction and albedo.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum CoefficientsDoc {
    /// Absorption σa and scattering σs: the extinction is σa + σs, the albedo σs / (σa + σs).
    AbsorptionScattering {
        /// Absorption of density 1, per scene unit.
        absorption: SpectrumDoc,
        /// Scattering of density 1, per scene unit.
        scattering: SpectrumDoc,
    },
    /// Mean free path and diffuse reflectance of a thick medium. The extinction is the inverse of the mean
    /// free path. The albedo is that of a half-space with this diffuse reflectance (see
    /// [`single_scattering_albedo`]), for the mean cosine of the phase function.
    MeanFreePathColour {
        /// Mean free path in density 1, scene units.
        mean_free_path: SpectrumDoc,
        /// Diffuse reflectance of a half-space, 0 to 1.
        colour: SpectrumDoc,
    },
}

/// Parametrisations of the coefficients.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoefficientsKind {
    /// By `extinction` and `albedo`.
    ExtinctionAlbedo,
    /// By [`CoefficientsDoc::AbsorptionScattering`].
    AbsorptionScattering,
    /// By [`CoefficientsDoc::MeanFreePathColour`].
    MeanFreePathColour,
}

/// Range of valid mean free paths, scene units.
pub const MEAN_FREE_PATHS: [f32; 2] = [1e-6, 1e6];

const SUM: Rule = |absorption, scattering| absorption + scattering;
const PRODUCT: Rule = |extinction, albedo| extinction * albedo;
const REST: Rule = |extinction, albedo| extinction * (1.0 - albedo);
const INVERSE: Rule = |value, _| 1.0 / value.clamp(MEAN_FREE_PATHS[0], MEAN_FREE_PATHS[1]);
const SHARE: Rule = |absorption, scattering| {
    let sum = absorption + scattering;
    if sum > 0.0 { scattering / sum } else { 0.0 }
};

impl MediumDoc {
    /// Parametrisation of the coefficients.
    #[must_use]
    pub fn coefficients_kind(&self) -> CoefficientsKind {
        match self.coefficients {
            None => CoefficientsKind::ExtinctionAlbedo,
            Some(CoefficientsDoc::AbsorptionScattering { .. }) => CoefficientsKind::AbsorptionScattering,
            Some(CoefficientsDoc::MeanFreePathColour { .. }) => CoefficientsKind::MeanFreePathColour,
        }
    }

    /// Spectra of the extinction at density 1 and of the albedo, for a phase function with this mean cosine.
    #[must_use]
    pub fn extinction_and_albedo(&self, mean_cosine: f32) -> (Spectrum, Spectrum) {
        let frozen = |doc: &SpectrumDoc| Spectrum::new(doc, Quantity::Coefficient);
        match &self.coefficients {
            None => (frozen(&self.extinction), frozen(&self.albedo)),
            Some(CoefficientsDoc::AbsorptionScattering { absorption, scattering }) => {
                let (a, s) = (frozen(absorption), frozen(scattering));
                (Spectrum::combined(a.clone(), s.clone(), SUM), Spectrum::combined(a, s, SHARE))
            }
            Some(CoefficientsDoc::MeanFreePathColour { mean_free_path, colour }) => (
                Spectrum::combined(frozen(mean_free_path), Spectrum::constant(0.0), INVERSE),
                Spectrum::combined(frozen(colour), Spectrum::constant(mean_cosine), single_scattering_albedo),
            ),
        }
    }

    /// Converts the coefficients to another parametrisation, to six digits. The conversion is exact for
    /// constants and, in RGB mode, for colours. Control points are exact at the points and within a few
    /// percent between them.
    #[must_use]
    pub fn given_by(&self, kind: CoefficientsKind, mean_cosine: f32) -> Self {
        if kind == self.coefficients_kind() {
            return self.clone();
        }
        let g = SpectrumDoc::Constant(mean_cosine);
        let nothing = SpectrumDoc::Constant(0.0);
        let (extinction, albedo) = match &self.coefficients {
            None => (self.extinction.clone(), self.albedo.clone()),
            Some(CoefficientsDoc::AbsorptionScattering { absorption, scattering }) => {
                (combined(absorption, scattering, SUM), combined(absorption, scattering, SHARE))
            }
            Some(CoefficientsDoc::MeanFreePathColour { mean_free_path, colour }) => {
                (combined(mean_free_path, &nothing, INVERSE), combined(colour, &g, single_scattering_albedo))
            }
        };
        let coefficients = match kind {
            CoefficientsKind::ExtinctionAlbedo => None,
            CoefficientsKind::AbsorptionScattering => Some(CoefficientsDoc::AbsorptionScattering {
                absorption: combined(&extinction, &albedo, REST),
                scattering: combined(&extinction, &albedo, PRODUCT),
            }),
            CoefficientsKind::MeanFreePathColour => Some(CoefficientsDoc::MeanFreePathColour {
                mean_free_path: combined(&extinction, &nothing, INVERSE),
                colour: combined(&albedo, &g, diffuse_albedo),
            }),
        };
        Self { extinction, albedo, coefficients, ..self.clone() }
    }
}

/// Rounds to six digits, so that a value converted there and back reads the same.
fn short(value: f32) -> f32 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// Combines two spectra by a rule into an editable spectrum.
fn combined(a: &SpectrumDoc, b: &SpectrumDoc, rule: Rule) -> SpectrumDoc {
    let colour = |doc: &SpectrumDoc| match doc {
        SpectrumDoc::Constant(value) => Some([*value; 3]),
        SpectrumDoc::Rgb(rgb) => Some(*rgb),
        SpectrumDoc::Points { .. } | SpectrumDoc::Preset(_) => None,
    };
    if let (SpectrumDoc::Constant(a), SpectrumDoc::Constant(b)) = (a, b) {
        return SpectrumDoc::Constant(short(rule(*a, *b)));
    }
    if let (Some(a), Some(b)) = (colour(a), colour(b)) {
        return SpectrumDoc::Rgb(std::array::from_fn(|c| short(rule(a[c], b[c]))));
    }
    let [at, bt] = [a, b].map(|doc| Spectrum::new(doc, Quantity::Coefficient));
    let mut knots: Vec<f32> = [a, b].into_iter().flat_map(knots).collect();
    knots.sort_by(f32::total_cmp);
    knots.dedup();
    let value = |lambda_nm: f32| rule(at.at(lambda_nm), bt.at(lambda_nm));
    let mut fine: Vec<f32> = knots.first().copied().into_iter().collect();
    for pair in knots.windows(2) {
        refine(&value, [pair[0], pair[1]], HALVINGS, &mut fine);
    }
    let points = fine.into_iter().map(|lambda_nm| ControlPoint { lambda_nm, value: short(value(lambda_nm)) });
    SpectrumDoc::Points { points: points.collect(), outside: Outside::Hold }
}

/// Maximum number of times that an interval between two points is halved.
const HALVINGS: u32 = 3;

/// Appends wavelengths in (a, b] until linear interpolation between neighbours is accurate to one percent.
fn refine(value: &impl Fn(f32) -> f32, [a, b]: [f32; 2], halvings: u32, to: &mut Vec<f32>) {
    let middle = 0.5 * (a + b);
    let (line, curve) = (0.5 * (value(a) + value(b)), value(middle));
    if halvings > 0 && b - a > 2.0 && (line - curve).abs() > 0.01 * curve.abs() + 1e-4 {
        refine(value, [a, middle], halvings - 1, to);
        refine(value, [middle, b], halvings - 1, to);
    } else {
        to.push(b);
    }
}

/// Wavelengths at which a spectrum is evaluated to convert it to control points.
fn knots(doc: &SpectrumDoc) -> Vec<f32> {
    match (doc, doc.control_points()) {
        (_, Some((points, outside))) => {
            let mut knots: Vec<f32> = points.iter().map(|p| p.lambda_nm).collect();
            if let (Outside::Zero, Some(first), Some(last)) = (outside, points.first(), points.last()) {
                // A step becomes a slope 0.01 nm wide, narrow enough to be negligible.
                knots.extend([first.lambda_nm - 0.01, last.lambda_nm + 0.01]);
            }
            knots
        }
        // A colour has a smooth spectrum: one point every 20 nm.
        (SpectrumDoc::Rgb(_), None) => {
            (0..=23u8).map(|i| LAMBDA_MIN_NM + 20.0 * f32::from(i)).chain([LAMBDA_MAX_NM]).collect()
        }
        (_, None) => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(text: &str, outside: Outside) -> SpectrumDoc {
        SpectrumDoc::Points { points: SpectrumDoc::parse_points(text).unwrap(), outside }
    }

    fn media() -> Vec<(MediumDoc, &'static [f32])> {
        let medium = |extinction, albedo| MediumDoc { extinction, albedo, ..MediumDoc::default() };
        let constant = SpectrumDoc::Constant;
        vec![
            (medium(constant(4.0), constant(0.9)), &[360.0, 550.0, 830.0]),
            (medium(SpectrumDoc::Rgb([8.0, 6.0, 4.0]), SpectrumDoc::Rgb([0.99, 0.5, 0.0])), &[]),
            (medium(SpectrumDoc::Rgb([8.0, 6.0, 4.0]), constant(0.7)), &[]),
            (
                medium(
                    points("430:8, 540:40, 572:8", Outside::Hold),
                    points("400:0.3, 700:0.95", Outside::Hold),
                ),
                &[360.0, 400.0, 700.0, 830.0],
            ),
            (
                medium(
                    points("430:8, 540:40, 572:8", Outside::Hold),
                    points("430:0.1, 540:0.9, 572:1", Outside::Hold),
                ),
                &[360.0, 430.0, 540.0, 572.0, 700.0],
            ),
            (
                medium(
                    points("450:5, 500:9, 600:2", Outside::Zero),
                    points("430:0.2, 500:0.9, 600:0.5", Outside::Hold),
                ),
                &[400.0, 500.0, 600.0, 640.0],
            ),
        ]
    }

    #[test]
    fn converting_keeps_extinction_and_albedo() {
        use CoefficientsKind::{AbsorptionScattering, ExtinctionAlbedo, MeanFreePathColour};
        for (medium, lambdas) in media() {
            for g in [0.0, 0.85] {
                for first in [AbsorptionScattering, MeanFreePathColour] {
                    for second in [ExtinctionAlbedo, AbsorptionScattering, MeanFreePathColour] {
                        let there = medium.given_by(first, g);
                        assert_eq!(there.coefficients_kind(), first);
                        let back = there.given_by(second, g);
                        assert_eq!(back.coefficients_kind(), second);
                        let (t0, a0) = medium.extinction_and_albedo(g);
                        for other in [there, back] {
                            let (t, a) = other.extinction_and_albedo(g);
                            let mut seen: Vec<[f32; 4]> =
                                lambdas.iter().map(|l| [t0.at(*l), t.at(*l), a0.at(*l), a.at(*l)]).collect();
                            if lambdas.is_empty() {
                                seen.extend(
                                    (0..3).map(|c| [t0.rgb()[c], t.rgb()[c], a0.rgb()[c], a.rgb()[c]]),
                                );
                            }
                            for [t0, t, a0, a] in seen {
                                assert!((t - t0).abs() <= 2e-5 * t0 + 2e-6, "{other:?}: {t} {t0}");
                                // Where the extinction is zero, the albedo is undefined.
                                assert!(t0 == 0.0 || (a - a0).abs() < 2e-4, "{other:?}: {a} {a0}");
                            }
                            let between = (360..=830u16).map(f32::from).filter(|_| !lambdas.is_empty());
                            for lambda in between {
                                let [t0, t, a0, a] = [&t0, &t, &a0, &a].map(|s| s.at(lambda));
                                assert!((t - t0).abs() <= 0.05 * t0 + 0.02, "{lambda}, {other:?}: {t} {t0}");
                                assert!(t0 == 0.0 || (a - a0).abs() < 0.03, "{lambda}, {other:?}: {a} {a0}");
                            }
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn plain_numbers_read_back_as_they_were() {
        let (medium, _) = media().remove(0);
        let there = medium.given_by(CoefficientsKind::AbsorptionScattering, 0.0);
        let expected = CoefficientsDoc::AbsorptionScattering {
            absorption: SpectrumDoc::Constant(0.4),
            scattering: SpectrumDoc::Constant(3.6),
        };
        assert_eq!(there.coefficients, Some(expected));
        assert_eq!(there.given_by(CoefficientsKind::ExtinctionAlbedo, 0.0), medium);
    }

    #[test]
    fn absorption_and_scattering_are_exact_between_points_too() {
        let (absorption, scattering) =
            (points("400:1, 500:4", Outside::Hold), points("420:9, 610:0.5", Outside::Zero));
        let [a, s] = [&absorption, &scattering].map(|d| Spectrum::new(d, Quantity::Coefficient));
        let coefficients = Some(CoefficientsDoc::AbsorptionScattering { absorption, scattering });
        let (t, albedo) = MediumDoc { coefficients, ..MediumDoc::default() }.extinction_and_albedo(0.0);
        for i in 0..470u16 {
            let lambda = 360.3 + f32::from(i);
            assert_eq!(t.at(lambda), a.at(lambda) + s.at(lambda));
            assert!((t.at(lambda) * albedo.at(lambda) - s.at(lambda)).abs() < 1e-5);
        }
    }
}
