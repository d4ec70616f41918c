//! Figure 3: two scenes in which one technique each has high variance, and their combination in neither.

use super::figure::{Cell, Figure, Panel, Strip};
use super::options::Stage;

const PANELS: &[Panel] = &[
    Panel { label: "Spectral MIS", estimator: "spectral-mis", set: &[] },
    Panel { label: "NEE", estimator: "nee", set: &[] },
    Panel { label: "Uni+NEE MIS", estimator: "uni-nee-mis", set: &[] },
];
const CELLS: &[Cell] = &[Cell::Panel(0), Cell::Panel(1), Cell::Panel(2), Cell::Reference];

pub(super) const FIGURE: Figure = Figure {
    id: "3",
    title: "Uni+NEE MIS is robust",
    shows: "Above, a large light behind a cloud that scatters sharply forward (g = 0.99): next-event estimation \
            fails. Below, a small light at the side of a dense cloud (g = 0.9): unidirectional sampling fails. \
            Uni+NEE MIS keeps the better of the two.",
    strips: &[
        Strip {
            name: "figure3-upper",
            scene: "cloud-backlit",
            about: "back-lit cloud, g = 0.99",
            stage: Some(Stage::Cloud),
            size: [256, 192],
            panels: PANELS,
            reference: Panel { label: "Reference (Spectral MIS)", estimator: "spectral-mis", set: &[] },
            cells: CELLS,
        },
        Strip {
            name: "figure3-lower",
            scene: "cloud-sidelit",
            about: "side-lit cloud, g = 0.9",
            stage: Some(Stage::Cloud),
            size: [256, 192],
            panels: PANELS,
            // The estimator of the report; its choice of directions changes only the noise, by a factor of
            // seven.
            reference: Panel {
                label: "Reference (NEE)",
                estimator: "nee",
                set: &["estimator.directions=towards-lights"],
            },
            cells: CELLS,
        },
    ],
};
