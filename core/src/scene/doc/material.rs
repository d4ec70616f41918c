//! Editable materials.

use crate::material::Metal;
use crate::spectrum::{ControlPoint, Outside, SpectrumDoc};
use serde::{Deserialize, Serialize};

fn grey() -> SpectrumDoc {
    SpectrumDoc::Constant(0.5)
}
fn one() -> SpectrumDoc {
    SpectrumDoc::Constant(1.0)
}

/// Material of an object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum MaterialDoc {
    /// Lambertian reflection on both sides.
    Diffuse {
        /// Reflected fraction, 0 to 1.
        #[serde(default = "grey")]
        albedo: SpectrumDoc,
    },
    /// An ideal mirror.
    Mirror {
        /// Reflected fraction, 0 to 1.
        #[serde(default = "one")]
        reflectance: SpectrumDoc,
    },
    /// A metal, given by its name or by its refractive index n + i k.
    Conductor {
        /// Name of a metal, in place of `eta` and `k`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        preset: Option<Metal>,
        /// Real part of the refractive index.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        eta: Option<SpectrumDoc>,
        /// Imaginary part of the refractive index.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        k: Option<SpectrumDoc>,
        /// Width α of the GGX distribution; 0 is smooth.
        #[serde(default)]
        roughness: f32,
    },
    /// The boundary of a transparent body.
    Dielectric {
        /// Refractive index.
        #[serde(default)]
        ior: IorDoc,
        /// Width α of the GGX distribution; 0 is smooth.
        #[serde(default)]
        roughness: f32,
    },
    /// A thin pane, which light passes in a straight line.
    ThinDielectric {
        /// Refractive index.
        #[serde(default)]
        ior: IorDoc,
    },
    /// An index-matched boundary: light passes unchanged.
    Interface {},
}

/// Refractive index by wavelength.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum IorDoc {
    /// Cauchy's equation n(λ) = A + B/λ², λ in micrometres.
    Cauchy {
        /// A, and B in square micrometres.
        cauchy: [f32; 2],
    },
    /// A number or a spectrum.
    Spectrum(SpectrumDoc),
}

impl Default for IorDoc {
    fn default() -> Self {
        Self::Spectrum(SpectrumDoc::Constant(1.5))
    }
}

impl IorDoc {
    /// The index as a spectrum: Cauchy's equation by points 10 nm apart.
    #[must_use]
    pub fn spectrum(&self) -> SpectrumDoc {
        match self {
            Self::Spectrum(spectrum) => spectrum.clone(),
            Self::Cauchy { cauchy: [a, b] } => {
                let point = |lambda_nm: u16| {
                    let lambda_nm = f32::from(lambda_nm);
                    ControlPoint { lambda_nm, value: a + b * 1e6 / (lambda_nm * lambda_nm) }
                };
                let points = (360..=830).step_by(10).map(point).collect();
                SpectrumDoc::Points { points, outside: Outside::Hold }
            }
        }
    }
}

impl Default for MaterialDoc {
    fn default() -> Self {
        Self::Diffuse { albedo: grey() }
    }
}

impl MaterialDoc {
    /// Display name of the kind.
    #[must_use]
    pub fn kind_name(&self) -> &'static str {
        match self {
            Self::Diffuse { .. } => "Diffuse",
            Self::Mirror { .. } => "Mirror",
            Self::Conductor { .. } => "Conductor",
            Self::Dielectric { .. } => "Dielectric",
            Self::ThinDielectric { .. } => "Thin dielectric",
            Self::Interface {} => "Interface",
        }
    }

    /// One material of each kind with its display name.
    #[must_use]
    pub fn templates() -> Vec<(&'static str, Self)> {
        let metal = Some(Metal::Gold);
        let ior = IorDoc::default;
        vec![
            ("Diffuse", Self::default()),
            ("Mirror", Self::Mirror { reflectance: one() }),
            ("Conductor", Self::Conductor { preset: metal, eta: None, k: None, roughness: 0.1 }),
            ("Dielectric", Self::Dielectric { ior: ior(), roughness: 0.0 }),
            ("Thin dielectric", Self::ThinDielectric { ior: ior() }),
            ("Interface", Self::Interface {}),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::ObjectDoc;

    /// The index is a number, points or Cauchy's equation.
    #[test]
    fn refractive_indices_are_read_in_three_forms() {
        let ior = |text: &str| {
            let text = format!("kind = \"ground\"\nmaterial = {{ kind = \"dielectric\", ior = {text} }}");
            match toml::from_str::<ObjectDoc>(&text).unwrap().material {
                MaterialDoc::Dielectric { ior, .. } => ior.spectrum(),
                other => panic!("{other:?}"),
            }
        };
        assert_eq!(ior("1.33"), SpectrumDoc::Constant(1.33));
        assert!(matches!(ior("\"400:1.53, 700:1.51\""), SpectrumDoc::Points { .. }));
        let SpectrumDoc::Points { points, .. } = ior("{ cauchy = [1.5, 0.004] }") else { panic!() };
        let at_500 = points.iter().find(|p| p.lambda_nm == 500.0).unwrap();
        assert!((at_500.value - 1.516).abs() < 1e-6);
    }
}
