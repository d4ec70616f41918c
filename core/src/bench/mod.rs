//! Equal-time benchmarks of estimators.
//!
//! ```text
//!   Plan (scenes × entrants × repeats) ──► trials, entrants taking turns ──► Row (means, intervals)
//! ```
//!
//! The figure of merit is the efficiency 1/(relMSE · CPU seconds). It does not depend on the length of a run,
//! and doubles when the same error is reached in half the time. CPU seconds include all threads of the
//! process and the film. Repeats of the estimators are interleaved, so that changes in machine load affect
//! all of them alike. The confidence intervals come from the scatter of the repeats.

mod csv;
mod factor_curve;
mod plan;
mod row;
mod run;

pub use csv::csv;
pub use factor_curve::{FACTORS, FactorPoint, factor_curve};
pub use plan::{Candidate, Plan, ReferencePlan, Subject};
pub use row::{Interval, Row, Trial};
pub use run::{BenchError, Progress, run};
