//! A scalar density: σt(x, λ) = scale · density(x) · σ(λ), albedo(λ) the same everywhere.

use super::{Coefficients, Grid, LocalMedium, MajorantPolicy, MajorantSegment, Medium};
use crate::math::Ray;
use crate::spectrum::{Components, Sampled, Spectrum};
use glam::Vec3;
use std::sync::Arc;

/// A medium whose density comes from a grid.
#[derive(Clone, Debug)]
pub struct DensityGrid {
    /// Density by place, trilinear.
    pub density: Arc<Grid<1>>,
    /// Extinction of density 1: scale · σ(λ), per scene unit.
    pub extinction: Spectrum,
    /// Albedo(λ).
    pub albedo: Spectrum,
    /// Majorant relative to the largest extinction.
    pub majorant: MajorantPolicy,
}

/// [`DensityGrid`] at a path's components.
#[derive(Clone, Copy, Debug)]
pub struct LocalDensityGrid<'a, const N: usize> {
    density: &'a Grid<1>,
    extinction: Sampled<N>,
    albedo: Sampled<N>,
    majorant: Sampled<N>,
    policy: MajorantPolicy,
}

impl Medium for DensityGrid {
    type Local<'a, const N: usize> = LocalDensityGrid<'a, N>;

    fn local<const N: usize, C: Components<N>>(&self, components: &C) -> LocalDensityGrid<'_, N> {
        let per_density = self.majorant.global(components, &self.extinction);
        LocalDensityGrid {
            density: &self.density,
            extinction: components.evaluate(&self.extinction),
            albedo: components.evaluate(&self.albedo),
            majorant: per_density * self.density.max()[0],
            policy: self.majorant,
        }
    }
}

impl<const N: usize> LocalMedium<N> for LocalDensityGrid<'_, N> {
    type Segments<'a>
        = std::iter::Once<MajorantSegment<N>>
    where
        Self: 'a;

    fn coefficients(&self, point: Vec3, majorant: &MajorantSegment<N>) -> Coefficients<N> {
        let [density] = self.density.at(point);
        Coefficients::new(self.extinction * density, self.albedo, majorant)
    }

    fn segments<'a>(&'a self, _ray: &Ray, t0: f32, t1: f32) -> Self::Segments<'a> {
        std::iter::once(self.policy.segment(self.majorant, t0, t1))
    }
}
