//! Comparison of estimators: efficiency, errors and bias, with their uncertainty.
//!
//! ```text
//!   Session (fair turns) ──► Snapshot of every view ──┐
//!   Reference: rendered, read, pooled ────────────────┴─► rank ──► Standing per view, Verdict
//!                                                     └─► maps, curves, report
//! ```
//!
//! All functions are pure functions of images with their noise. [`rank`] compares every view with the
//! reference, or with the mean of the *other* unbiased views where there is none.

mod agreement;
pub mod curve;
mod estimate;
mod experiment;
mod fitness;
pub mod maps;
mod open;
mod ranking;
#[cfg(test)]
mod ranking_tests;
mod reference;
pub mod report;
mod run;

pub use agreement::{ALPHA, Agreement, Verdict, Worst, agreement};
pub use estimate::{Estimate, RegionNoise};
pub use experiment::{Experiment, View, label, view_colour};
pub use fitness::{unfit_document, unfit_picture};
pub use open::{ReferenceError, open, seed_of};
pub use ranking::{ComparedWith, Comparison, Question, RankedView, Standing, can_measure, comparisons, rank};
pub use reference::Reference;
pub use run::{Finished, LEAST_SAMPLES, Progress, RunError, reference_doc, run};
