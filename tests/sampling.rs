//! Every sampling routine against the density that it claims, by χ² over bins: what the estimators'
//! weights rest on.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may panic")]

#[path = "sampling/basics.rs"]
mod basics;
#[path = "sampling/flight.rs"]
mod flight;
#[path = "sampling/lights.rs"]
mod lights;
#[path = "sampling/phase.rs"]
mod phase;
