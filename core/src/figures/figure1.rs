//! Figure 1: a chromatic medium rendered with the new integrator.

use super::figure::{Cell, Figure, Panel, Strip};
use super::options::Stage;

pub(super) const FIGURE: Figure = Figure {
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
