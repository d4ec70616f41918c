//! Thermal emission of a medium: black-body radiance by the temperature at a point.

use super::{Grid, Interpolation};
use glam::{Affine3A, Vec3};
use std::sync::Arc;

/// Temperature field of an emitting medium.
#[derive(Clone, Debug)]
pub struct Emission {
    /// Temperature grid, in units of `kelvin`; `None` for a constant temperature in the box.
    pub temperature: Option<Arc<Grid<1>>>,
    /// Transform from the medium's unit cube to that of the temperature grid.
    pub temperature_from_medium: Affine3A,
    /// Kelvins per unit of the grid.
    pub kelvin: f32,
    /// Multiplier of the radiance.
    pub scale: f32,
}

impl Emission {
    /// Temperature in kelvins at a point of the medium's unit cube; zero outside the temperature grid.
    #[must_use]
    #[inline]
    pub fn kelvin_at(&self, point: Vec3) -> f32 {
        let Some(grid) = &self.temperature else { return self.kelvin };
        let at = self.temperature_from_medium.transform_point3(point);
        let inside = at.cmpge(Vec3::ZERO).all() && at.cmple(Vec3::ONE).all();
        if inside { self.kelvin * grid.look_up(at, Interpolation::Trilinear, 2)[0] } else { 0.0 }
    }
}
