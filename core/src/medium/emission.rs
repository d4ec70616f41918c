//! Emission of a medium that glows: a black body's radiance, by the temperature at a point.

use super::{Grid, Interpolation};
use glam::{Affine3A, Vec3};
use std::sync::Arc;

/// Where it glows, and how hot it is there.
#[derive(Clone, Debug)]
pub struct Emission {
    /// Temperature by place, in units of `kelvin`; `None` for the same everywhere in the box.
    pub temperature: Option<Arc<Grid<1>>>,
    /// Takes points of the medium's unit cube to those of the temperature's.
    pub temperature_from_medium: Affine3A,
    /// Kelvins of a temperature of 1.
    pub kelvin: f32,
    /// Multiplies the radiance.
    pub scale: f32,
}

impl Emission {
    /// Kelvins at a point of the medium's unit cube; a grid that ends short of it is cold there.
    #[must_use]
    #[inline]
    pub fn kelvin_at(&self, point: Vec3) -> f32 {
        let Some(grid) = &self.temperature else { return self.kelvin };
        let at = self.temperature_from_medium.transform_point3(point);
        let inside = at.cmpge(Vec3::ZERO).all() && at.cmple(Vec3::ONE).all();
        if inside { self.kelvin * grid.look_up(at, Interpolation::Trilinear, 2)[0] } else { 0.0 }
    }
}
