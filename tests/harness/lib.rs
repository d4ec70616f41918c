//! Shared support of the tests: statistics, scenes, sessions, volume files.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    missing_docs,
    reason = "test support: it may panic, and prints its tables"
)]

pub mod chi2;
pub mod fixture;
pub mod render;
pub mod session;
pub mod volumes;
