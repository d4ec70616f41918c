//! White furnace test: albedo 1 and radiance 1 from all directions.
//!
//! Radiance 1 in every direction solves the equation of transfer: the radiance scattered out of a ray, σt ·
//! 1, equals the radiance scattered into it, σs ∫ p · 1 dω = σt. Every ray therefore receives 1 for any
//! density, phase function and majorant, for surfaces of albedo 1, and for a camera inside or outside the
//! medium. In spectral mode, 1 at every wavelength is the colour of illuminant E.

use super::super::{Answer, Case, CheckError, Family, truth};
use super::ASIDE;
use crate::io::Library;
use crate::scene::{Absorption, Angle, Mode, PhaseDoc};

pub(super) const FAMILY: Family = Family {
    id: "furnace",
    about: "Albedo 1 and radiance 1 from all directions: every ray receives radiance 1.",
    deep_only: false,
    cases,
};

fn cases() -> Result<Vec<Case>, CheckError> {
    let white = truth::white();
    let in_mode = |case: Case, mode: Mode| {
        let colour = if mode == Mode::Rgb { [1.0; 3] } else { white };
        let answer = Answer::uniform(colour, case.layout);
        case.varied(case.name.clone(), |doc| doc.estimator.mode = mode).answered(answer)
    };
    let cube = |extinction: &str| {
        format!(
            "{ASIDE}
            [medium]
            extinction = {extinction}
            albedo = 1.0
            [[lights]]
            kind = \"environment\""
        )
    };
    let made = |name: &str, toml: &str| {
        Case::new(format!("furnace/{name}"), toml, Answer::Agreement).map(|c| c.in_blocks(2, 2))
    };
    let homogeneous = made("thin", &cube("0.5"))?;
    let dense = made("dense", &cube("24.0"))?;
    let chromatic = made("chromatic", &cube("{ rgb = [0.2, 20.0, 0.0] }"))?;
    let chromatic_nm = made("chromatic-nm", &cube("\"420:0.2, 540:20, 620:0\""))?;
    let rough = truth::Lattice3::npy(&super::super::fixture::rough_lattice([6, 5, 4], 4));
    let grid = made(
        "grid",
        &format!(
            "{ASIDE}
            [medium]
            extinction = {{ rgb = [3.0, 9.0, 5.0] }}
            albedo = 1.0
            density = {{ kind = \"grid\", file = \"rough.npy\" }}
            placement = {{ fit = 1.2 }}
            [[lights]]
            kind = \"environment\""
        ),
    )?
    .with_files(Library::default().with_volume("rough.npy", rough));
    let surfaces = made(
        "surfaces",
        &format!(
            "{ASIDE}
            [medium]
            extinction = 4.0
            albedo = 1.0
            [[lights]]
            kind = \"environment\"
            [[objects]]
            kind = \"ground\"
            point = [0.0, -0.6, 0.0]
            albedo = 1.0
            [[objects]]
            kind = \"box\"
            center = [0.2, 0.0, 0.1]
            size = [0.4, 0.3, 0.3]
            rotate_deg = [0.0, 30.0, 0.0]
            albedo = 1.0"
        ),
    )?;

    let mut cases = vec![
        in_mode(homogeneous.clone(), Mode::Spectral),
        in_mode(dense, Mode::Rgb),
        in_mode(chromatic, Mode::Rgb),
        in_mode(chromatic_nm, Mode::Spectral),
        in_mode(surfaces, Mode::Rgb),
        in_mode(
            homogeneous.varied("furnace/inside", |doc| {
                doc.camera.origin = [0.1, -0.2, 0.15];
                doc.camera.fov_deg = 80.0;
                doc.medium_mut().scale = 8.0;
            }),
            Mode::Rgb,
        ),
    ];
    // A bright ring with a dark gap around it.
    let corona = vec![[0.0, 20.0], [10.0, 0.0], [15.0, 0.0], [25.0, 4.0], [40.0, 0.2], [180.0, 0.1]];
    for (name, phase) in [
        ("hg-forward", PhaseDoc::HenyeyGreenstein { g: 0.9 }),
        ("hg-backward", PhaseDoc::HenyeyGreenstein { g: -0.5 }),
        ("two-lobe", PhaseDoc::TwoLobe { g_forward: 0.8, g_backward: -0.3, forward: 0.6 }),
        ("rayleigh", PhaseDoc::Rayleigh {}),
        ("draine", PhaseDoc::Draine { g: -0.4, alpha: 30.0 }),
        ("mie", PhaseDoc::Mie { diameter_um: 0.8 }),
        ("table", PhaseDoc::Tabulated { angle: Angle::Degrees, points: corona, file: String::new() }),
    ] {
        let phased = grid.varied(format!("furnace/{name}"), |doc| {
            doc.medium_mut().phase = phase;
            doc.medium_mut().scale = 0.5;
        });
        cases.push(in_mode(phased, if name == "two-lobe" { Mode::Spectral } else { Mode::Rgb }));
    }
    for factor in [0.5f32, 1.0, 1.7, 10.0] {
        let loose = grid.varied(format!("furnace/majorant-{factor}"), |doc| {
            doc.medium_mut().majorant.factor = factor;
            // Below 1 the variance grows exponentially with the excess: the optical depth stays below one
            // mean free path.
            doc.medium_mut().scale = if factor < 1.0 { 0.25 } else { 1.0 };
        });
        cases.push(in_mode(loose, Mode::Rgb));
    }
    cases.push(in_mode(
        grid.varied("furnace/shared-majorant-analogue", |doc| {
            doc.medium_mut().majorant.shared = true;
            doc.estimator.absorption = Absorption::Analogue;
        }),
        Mode::Spectral,
    ));
    Ok(cases)
}
