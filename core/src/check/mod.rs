//! Whether the program is true: estimators against answers that are known.
//!
//! ```text
//!   FAMILIES ──► Case (scene + answer) ─┐
//!                                       ├─► batch means ──► comparisons ──► Row (verdict) ──► Report
//!   estimator::REGISTRY ────────────────┘
//! ```
//!
//! A [`Case`] is a scene with a derived answer; the derivation stands at the head of its family's file
//! in `cases/`. Answers are evaluated in double precision and share no code with the renderer. Every
//! estimator of the registry runs on every case that it is unbiased for. Where nobody knows the answer,
//! a person's own scene among them, the estimators are held against each other, pair by pair.
//!
//! The statistics are those of [`stats`]: t-tests on independent batch means of pixel blocks, Šidák's
//! correction over all comparisons of a run, and a stated power: for every row the relative bias of the
//! image's mean that would have been found with 95 % probability.

mod answer;
mod batches;
mod case;
mod cases;
mod compare;
mod error;
mod fixture;
mod own_scene;
mod report;
mod run;
pub mod stats;
mod truth;

pub use answer::{Answer, Value};
pub use batches::{BATCHES, Batches, Layout, Plan};
pub use case::{Case, Family};
pub use cases::{FAMILIES, built_in, named};
pub use error::CheckError;
pub use own_scene::own_scene;
pub use report::{Report, Row, Verdict};
pub use run::{Check, Effort, Progress};
