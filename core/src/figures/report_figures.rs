//! The four figures of the report.

use super::figure::{Cell, Figure, Panel, Strip};
use super::options::Stage;

/// Figure 1: a chromatic medium rendered with the new integrator.
pub(super) const FIGURE_1: Figure = Figure {
    id: "1",
    title: "A chromatic heterogeneous medium",
    shows: "Smoke whose extinction depends on wavelength, rendered by Uni+NEE MIS with hero wavelengths: every path \
            density is known, so that both techniques and all wavelengths share every path. The report does not \
            state the number of samples of its image; here it has that of the references, and the measurements are \
            of an image with few samples.",
    strips: &[Strip {
        name: "figure1",
        scene: "first-light",
        about: "chromatic plume, one area light and a dim environment",
        stage: Some(Stage::Plume),
        size: [320, 180],
        panels: &[Panel { label: "Uni+NEE MIS", estimator: "uni-nee-mis", set: &[] }],
        reference: Panel { label: "Uni+NEE MIS", estimator: "uni-nee-mis", set: &[] },
        cells: &[Cell::Reference],
    }],
};

/// Figure 2: reduction of colour noise by hero wavelengths.
pub(super) const FIGURE_2: Figure = Figure {
    id: "2",
    title: "Spectral MIS removes colour noise",
    shows: "Isotropic smoke of albedo 0.99 and extinction 430:8, 540:40, 572:8. Independent tracking estimates every \
            wavelength by separate paths; spectral MIS shares each path among four wavelengths.",
    strips: &[Strip {
        name: "figure2",
        scene: "plume-spectral",
        about: "chromatic plume in front of a large light",
        stage: Some(Stage::Plume),
        size: [256, 256],
        panels: &[
            Panel { label: "Independent tracking", estimator: "independent", set: &[] },
            Panel { label: "Spectral MIS", estimator: "spectral-mis", set: &[] },
        ],
        reference: Panel { label: "Reference (Uni+NEE MIS)", estimator: "uni-nee-mis", set: &[] },
        cells: &[Cell::Panel(0), Cell::Panel(1), Cell::Reference],
    }],
};

const PANELS: &[Panel] = &[
    Panel { label: "Spectral MIS", estimator: "spectral-mis", set: &[] },
    Panel { label: "NEE", estimator: "nee", set: &[] },
    Panel { label: "Uni+NEE MIS", estimator: "uni-nee-mis", set: &[] },
];
const CELLS: &[Cell] = &[Cell::Panel(0), Cell::Panel(1), Cell::Panel(2), Cell::Reference];

/// Figure 3: two scenes in which one technique each has high variance, and their combination in neither.
pub(super) const FIGURE_3: Figure = Figure {
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

/// Figure 4: variance of analogue absorption.
pub(super) const FIGURE_4: Figure = Figure {
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
