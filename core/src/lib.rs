//! Monte Carlo light transport in participating media, on the null-scattering path integral.
//!
//! ```text
//!   math ─► spectrum ─► medium, phase, surface, light ─► scene ─► transport ─► estimator ─► session
//!                                                          ▲
//!                                         io (scenes, volumes, pictures, results)
//! ```
//!
//! A [`scene::SceneDoc`] is what people edit; [`scene::build`] freezes it into a [`scene::Scene`]; a
//! [`session::Session`] renders views of it in the background and publishes [`film::Snapshot`]s.
//! Rooms follow concepts: one estimator, one medium, one phase function, one light is one file.
//! Imports point one way, along the arrows. Nothing here knows a window.

pub mod estimator;
pub mod film;
pub mod io;
pub mod light;
pub mod math;
pub mod medium;
pub mod phase;
pub mod scene;
pub mod session;
pub mod spectrum;
pub mod surface;
pub mod transport;
