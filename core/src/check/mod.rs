//! Validation of the estimators against known answers.
//!
//! ```text
//!   FAMILIES ──► Case (scene + answer) ─┐
//!                                       ├─► batch means ──► comparisons ──► Row (verdict) ──► Report
//!   estimator::REGISTRY ────────────────┘
//! ```
//!
//! A [`Case`] is a scene with a derived answer; the derivation is at the head of its family's file in
//! `cases/`. Answers are evaluated in double precision and share no code with the renderer. Every estimator
//! of the registry runs on every case for which it is unbiased. Where no answer is known, as for a user's own
//! scene, the estimators are compared with each other, pair by pair.
//!
//! The statistics are those of [`stats`]: t-tests on independent batch means of pixel blocks, Šidák's
//! correction over all comparisons of a run, and a stated power: every row gives the relative bias of the
//! image mean that would have been detected with 95 % probability.

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
