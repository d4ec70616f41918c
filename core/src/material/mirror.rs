//! An ideal mirror: reflects a fraction of the light that does not depend on the angle.

use crate::spectrum::Spectrum;

/// Mirror.
#[derive(Clone, Debug)]
pub struct Mirror {
    /// Reflected fraction, 0 to 1.
    pub reflectance: Spectrum,
}
