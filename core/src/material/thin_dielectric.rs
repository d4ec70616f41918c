//! A pane of negligible thickness, as a window or a soap film: light is reflected between its two sides any number
//! of times, and leaves in the direction from which it came or of the mirror.
//!
//! ```text
//!   R' = R + T² R / (1 − R²) = 2R / (1 + R),   T' = 1 − R'
//! ```

use crate::spectrum::Spectrum;

/// Thin dielectric.
#[derive(Clone, Debug)]
pub struct ThinDielectric {
    /// Refractive index of the pane.
    pub ior: Spectrum,
}
