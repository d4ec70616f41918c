//! Figure 1: what the new integrator is for.

use super::figure::{Cell, Figure, Panel, Strip};
use super::options::Stage;

pub(super) const FIGURE: Figure = Figure {
    id: "1",
    title: "A chromatic heterogeneous medium",
    shows: "Smoke whose extinction depends on wavelength, by Uni+NEE MIS with hero wavelengths: no path density is \
            unknown, so both techniques and all wavelengths share every path. The report does not say how many \
            samples its picture has; here it has the references' many, and the numbers are those of few.",
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
