//! Monte Carlo light transport in participating media, on the null-scattering path integral.
//!
//! ```text
//!   math ─► spectrum ─► medium, phase, surface, light ─► scene ─► transport ─► estimator
//!   medium ─► transmittance (of a ray) ─► transport
//!   scene ─► io (scenes, volumes, images, results) ─► session
//!   estimator ─► inspect (analysis of paths) ─► session ─► compare ─► bench ─► figures
//!   film ─► measure (errors of an image against a reference) ─► compare
//! ```
//!
//! A [`scene::SceneDoc`] is the editable document; [`scene::build`] freezes it into a [`scene::Scene`]; a
//! [`session::Session`] renders views of it in the background and publishes [`film::Snapshot`]s. Modules
//! follow concepts: one estimator, medium, phase function or light per file. Imports follow the arrows only.
//! The crate does not depend on the window.

pub mod bench;
pub mod check;
pub mod compare;
pub mod estimator;
pub mod figures;
pub mod film;
pub mod inspect;
pub mod io;
pub mod light;
pub mod material;
pub mod math;
pub mod measure;
pub mod medium;
pub mod phase;
pub mod scene;
pub mod session;
pub mod spectrum;
pub mod surface;
pub mod transmittance;
pub mod transport;
