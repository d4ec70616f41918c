//! Checks of the medium.

use super::Checker;
use crate::medium::MAX_MAJORANT_CELLS;
use crate::phase::{PhaseDoc, check_table};
use crate::scene::{CoefficientsDoc, MEAN_FREE_PATHS, MediumDoc};
use crate::spectrum::{HOTTEST_K, Outside, SpectrumDoc};

pub(super) fn medium(c: &mut Checker, doc: &MediumDoc) {
    c.range("medium.scale", doc.scale, 0.0, 1e6);
    c.spectrum("medium.extinction", &doc.extinction, 1e6);
    c.spectrum("medium.albedo", &doc.albedo, 1.0);
    match &doc.coefficients {
        None => {}
        Some(CoefficientsDoc::AbsorptionScattering { absorption, scattering }) => {
            c.spectrum("medium.coefficients.absorption", absorption, 1e6);
            c.spectrum("medium.coefficients.scattering", scattering, 1e6);
        }
        Some(CoefficientsDoc::MeanFreePathColour { mean_free_path, colour }) => {
            free_path(c, mean_free_path);
            c.spectrum("medium.coefficients.colour", colour, 1.0);
        }
    }
    c.check(
        doc.majorant.factor >= 0.01 && doc.majorant.factor <= 1000.0,
        "medium.majorant.factor",
        format!("is {}; it lies between 0.01 and 1000, 1 is tight", doc.majorant.factor),
    );
    if let Some(cells) = doc.majorant.resolution {
        c.check(
            (1..=MAX_MAJORANT_CELLS).contains(&cells),
            "medium.majorant.resolution",
            format!("is {cells}; there are 1 to {MAX_MAJORANT_CELLS} cells per axis"),
        );
    }
    if let Some(emission) = &doc.emission {
        c.check(
            emission.kelvin > 0.0 && emission.kelvin <= 1e9,
            "medium.emission.kelvin",
            format!("is {}; it must be positive. Bodies above {HOTTEST_K} K shine as that", emission.kelvin),
        );
        c.range("medium.emission.scale", emission.scale, 0.0, 1e9);
    }
    phase(c, &doc.phase);
    let p = &doc.placement;
    c.finite("medium.placement.scale", &p.scale);
    c.finite("medium.placement.rotate_deg", &p.rotate_deg);
    c.finite("medium.placement.translate", &p.translate);
    c.check(p.fit.is_none_or(|fit| fit > 0.0 && fit <= 1e9), "medium.placement.fit", "must be positive");
    if let Some(matrix) = p.matrix {
        c.finite("medium.placement.matrix", &matrix.concat());
    }
}

/// Paths of length 0 would be an extinction without end.
fn free_path(c: &mut Checker, doc: &SpectrumDoc) {
    const PATH: &str = "medium.coefficients.mean_free_path";
    let [least, most] = MEAN_FREE_PATHS;
    c.spectrum(PATH, doc, most);
    for value in doc.values().into_iter().filter(|value| *value < least) {
        c.check(false, PATH, format!("holds {value}; a mean free path of at least {least} makes sense"));
    }
    let vanishes = matches!(doc, SpectrumDoc::Points { outside: Outside::Zero, .. });
    c.check(!vanishes, PATH, "is zero beyond its points: leave `outside` out, which holds the last values");
}

fn phase(c: &mut Checker, doc: &PhaseDoc) {
    for (parameter, value) in doc.parameters() {
        let [lo, hi] = parameter.range;
        c.range(format!("medium.phase.{}", parameter.key), value, lo, hi);
    }
    if let PhaseDoc::Tabulated { angle, points, file } = doc {
        if file.is_empty() {
            let problem = check_table(*angle, points).err();
            let message = problem.map(|e| e.to_string()).unwrap_or_default();
            c.check(problem.is_none(), "medium.phase.points", message);
        } else {
            c.check(
                points.is_empty(),
                "medium.phase.file",
                "is named beside `points`: leave one of the two out",
            );
        }
    }
}
