//! Reproduction of the figures of the report, and the study that it leaves to future work.
//!
//! ```text
//!   Figure (scene, panels, layout) ──► Rendered (panels, reference, numbers) ──┬─► PNG, EXR, figures.csv
//!                                          └─► study (variants at equal time) ─┴─► figures.json, index.html
//!                                                  └─► conclusion, from the numbers alone
//! ```
//!
//! A new figure is one file and one line of [`FIGURES`]; a new variant is one line of [`study::VARIANTS`], a
//! new comparison of two variants one line of [`study::TOPICS`]. "The report" is Jan Horešovský,
//! "Implementing null-scattering path integral formulation in Mitsuba 2" (semester project, EPFL).

mod compose;
mod error;
mod figure;
mod numbers;
mod options;
mod page;
mod plan;
mod render;
mod report_figures;
mod results;
mod run;
pub mod study;
mod text;
mod volume;
mod write;

pub use error::FiguresError;
pub use figure::{Cell, Figure, Panel, Strip};
pub use numbers::PanelNumbers;
pub use options::{Options, OwnVolume, Stage, StudyOptions};
pub use render::{Rendered, render};
pub use results::Results;
pub use run::{Progress, run};

/// All figures of the report, in its order.
pub static FIGURES: &[Figure] =
    &[report_figures::FIGURE_1, report_figures::FIGURE_2, report_figures::FIGURE_3, report_figures::FIGURE_4];

/// Figure with the given number.
#[must_use]
pub fn find(id: &str) -> Option<&'static Figure> {
    FIGURES.iter().find(|figure| figure.id == id)
}
