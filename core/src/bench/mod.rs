//! Equal-time benchmarks: how much certainty does a second buy?
//!
//! ```text
//!   Plan (scenes × entrants × repeats) ──► trials, entrants taking turns ──► Row (means, intervals)
//! ```
//!
//! The figure of merit is the efficiency 1/(relMSE · CPU seconds): it does not depend on how long a run
//! is, and doubles when the same error is reached in half the time. CPU seconds are those of all threads
//! of the process, film included. Repeats take turns, so that a machine's moods meet every estimator alike;
//! their scatter gives the intervals.

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
