//! Figure 2: hero wavelengths against colour noise.

use super::figure::{Cell, Figure, Panel, Strip};
use super::options::Stage;

pub(super) const FIGURE: Figure = Figure {
    id: "2",
    title: "Spectral MIS takes colour noise away",
    shows: "Isotropic smoke of albedo 0.99 and extinction 430:8, 540:40, 572:8. Independent tracking estimates every \
            wavelength by paths of its own; spectral MIS lets four wavelengths share each path.",
    strips: &[Strip {
        name: "figure2",
        scene: "plume-spectral",
        about: "chromatic plume before a large light",
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
