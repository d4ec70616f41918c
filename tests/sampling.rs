//! χ² tests of every sampling routine against its probability density, on which the estimators' weights rest.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may panic")]

#[path = "sampling/basics.rs"]
mod basics;
#[path = "sampling/flight.rs"]
mod flight;
#[path = "sampling/lights.rs"]
mod lights;
#[path = "sampling/phase.rs"]
mod phase;
