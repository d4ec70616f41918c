//! Figure 2: reduction of colour noise by hero wavelengths.

use super::figure::{Cell, Figure, Panel, Strip};
use super::options::Stage;

pub(super) const FIGURE: Figure = Figure {
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
