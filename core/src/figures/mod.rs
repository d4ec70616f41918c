//! The report's figures, rendered again, and the study that it leaves to future work.
//!
//! ```text
//!   Figure (scene, panels, layout) ──► Rendered (panels, reference, numbers) ──┬─► PNG, EXR, figures.csv
//!                                          └─► study (variants at equal time) ─┴─► figures.json, index.html
//!                                                  └─► conclusion, from the numbers alone
//! ```
//!
//! One figure is one file and one line of [`FIGURES`]; one line of [`study::VARIANTS`] adds a contestant, one of
//! [`study::TOPICS`] a comparison of two. "The report" is Jan Horešovský, "Implementing null-scattering path
//! integral formulation in Mitsuba 2" (semester project, EPFL).

mod compose;
mod error;
mod figure;
mod figure1;
mod figure2;
mod figure3;
mod figure4;
mod numbers;
mod options;
mod page;
mod plan;
mod render;
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
pub use run::{Progress, Results, run};

/// Every figure of the report, in its order.
pub static FIGURES: &[Figure] = &[figure1::FIGURE, figure2::FIGURE, figure3::FIGURE, figure4::FIGURE];

/// The figure of this number.
#[must_use]
pub fn find(id: &str) -> Option<&'static Figure> {
    FIGURES.iter().find(|figure| figure.id == id)
}
