//! Figure 4: what it costs to end paths at absorption.

use super::figure::{Cell, Figure, Panel, Strip};

pub(super) const FIGURE: Figure = Figure {
    id: "4",
    title: "The noise of absorption",
    shows: "A homogeneous medium, so that no null collisions are in the way; both pictures are unidirectional, with \
            as many samples. On the left every path is kept and weighted by the albedo, as in the older integrator; \
            on the right paths end where absorption is drawn, as in the report's new one.",
    strips: &[Strip {
        name: "figure4",
        scene: "homogeneous-absorption",
        about: "homogeneous cube that absorbs",
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
        // The report has none; numbers need one.
        reference: Panel { label: "Reference (Uni+NEE MIS)", estimator: "uni-nee-mis", set: &[] },
        cells: &[Cell::Panel(0), Cell::Panel(1)],
    }],
};
