//! Validation of combinations of values in the medium.

use super::Checker;
use crate::phase::{PhaseDoc, check_table};
use crate::scene::{CoefficientsDoc, MediumDoc};
use crate::spectrum::{Outside, SpectrumDoc};

pub(super) fn medium(c: &mut Checker, doc: &MediumDoc) {
    if let Some(CoefficientsDoc::MeanFreePathColour { mean_free_path, .. }) = &doc.coefficients {
        // A mean free path of zero would be an infinite extinction.
        let vanishes = matches!(mean_free_path, SpectrumDoc::Points { outside: Outside::Zero, .. });
        c.check(
            !vanishes,
            "medium.coefficients.mean_free_path",
            "is zero beyond its points: leave `outside` out, which holds the last values",
        );
    }
    if let PhaseDoc::Tabulated { angle, points, file } = &doc.phase {
        if file.is_empty() {
            let problem = check_table(*angle, points).err();
            let message = problem.map(|e| e.to_string()).unwrap_or_default();
            c.check(problem.is_none(), "medium.phase.points", message);
        } else {
            c.check(
                points.is_empty(),
                "medium.phase.file",
                "and `points` are both given: leave one of the two out",
            );
        }
    }
}
