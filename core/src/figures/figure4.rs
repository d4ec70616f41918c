//! Figure 4: variance of analogue absorption.

use super::figure::{Cell, Figure, Panel, Strip};

pub(super) const FIGURE: Figure = Figure {
    id: "4",
    title: "The noise of absorption",
    shows: "A homogeneous medium, so that there are no null collisions. Both images are unidirectional, with the \
            same number of samples. On the left every path is kept and weighted by the albedo, as in the older \
            integrator; on the right absorption terminates paths, as in the new integrator of the report.",
    strips: &[Strip {
        name: "figure4",
        scene: "homogeneous-absorption",
        about: "homogeneous absorbing cube",
        stage: None,
        size: [192, 192],
        panels: &[
            Panel {
                label: "Weighted by albedo",
                estimator: "spectral-mis",
                set: &["estimator.absorption=weighted"],
            },
            Panel { label: "Absorption as an event", estimator: "spectral-mis", set: &[] },
        ],
        // The report has none; the measurements need one.
        reference: Panel { label: "Reference (Uni+NEE MIS)", estimator: "uni-nee-mis", set: &[] },
        cells: &[Cell::Panel(0), Cell::Panel(1)],
    }],
};
