//! Density grids: σt(x, λ) = scale · density(x) · σ(λ), with an albedo(λ) that is constant in space.

use super::{
    CellWalk, Coefficients, ExtinctionPrior, Grid, Interpolation, LocalMedium, MajorantGrid, MajorantPolicy,
    MajorantSegment, Medium,
};
use crate::math::BoxRay;
use crate::spectrum::{Components, Sampled, Spectrum};
use glam::Vec3;
use std::sync::Arc;

/// Medium with a scalar density grid.
#[derive(Clone, Debug)]
pub struct DensityGrid {
    /// Density.
    pub density: Arc<Grid<1>>,
    /// Interpolation between samples.
    pub interpolation: Interpolation,
    /// Bounds of the density, per cell.
    pub bounds: Arc<MajorantGrid<1>>,
    /// Extinction at density 1: scale · σ(λ), per scene unit.
    pub extinction: Spectrum,
    /// Albedo(λ).
    pub albedo: Spectrum,
    /// Majorant relative to the bounds.
    pub majorant: MajorantPolicy,
}

/// A [`DensityGrid`] at the components of a path.
#[derive(Clone, Copy, Debug)]
pub struct LocalDensityGrid<'a, const N: usize> {
    density: &'a Grid<1>,
    interpolation: Interpolation,
    bounds: &'a MajorantGrid<1>,
    extinction: Sampled<N>,
    albedo: Sampled<N>,
    /// Majorant at a density bound of 1.
    majorant: Sampled<N>,
    policy: MajorantPolicy,
}

impl Medium for DensityGrid {
    type Local<'a, const N: usize> = LocalDensityGrid<'a, N>;

    fn local<const N: usize, C: Components<N>>(&self, components: &C) -> LocalDensityGrid<'_, N> {
        LocalDensityGrid {
            density: &self.density,
            interpolation: self.interpolation,
            bounds: &self.bounds,
            extinction: components.evaluate(&self.extinction),
            albedo: components.evaluate(&self.albedo),
            majorant: self.majorant.of(components, &self.extinction),
            policy: self.majorant,
        }
    }
}

impl<const N: usize> LocalMedium<N> for LocalDensityGrid<'_, N> {
    type Segments<'a>
        = DensitySegments<'a, N>
    where
        Self: 'a;

    #[inline]
    fn coefficients(&self, point: Vec3, majorant: &MajorantSegment<N>) -> Coefficients<N> {
        let [density] = self.density.look_up(point, self.interpolation, 0);
        Coefficients::new(self.extinction * density, self.albedo, majorant)
    }

    #[inline]
    fn extinction_prior(&self, point: Vec3) -> ExtinctionPrior<N> {
        ExtinctionPrior::of_mean(self.extinction * self.bounds.mean(self.bounds.cell_at(point)))
    }

    #[inline]
    fn control(&self, point: Vec3) -> Option<(Sampled<N>, Sampled<N>)> {
        let [least] = self.bounds.least(self.bounds.cell_at(point));
        (least > 0.0).then(|| (self.extinction * least, self.albedo))
    }

    #[inline]
    fn segments<'a>(&'a self, ray: &BoxRay) -> Self::Segments<'a> {
        DensitySegments { cells: self.bounds.walk(ray), majorant: self.majorant, policy: self.policy }
    }
}

/// Majorant segments along a ray, proportional to the bounds of a density.
#[derive(Clone, Debug)]
pub struct DensitySegments<'a, const N: usize> {
    pub(super) cells: CellWalk<'a, 1>,
    pub(super) majorant: Sampled<N>,
    pub(super) policy: MajorantPolicy,
}

impl<const N: usize> Iterator for DensitySegments<'_, N> {
    type Item = MajorantSegment<N>;

    #[inline]
    fn next(&mut self) -> Option<MajorantSegment<N>> {
        let cell = self.cells.next()?;
        Some(self.policy.segment(self.majorant * cell.bound[0], cell.t0, cell.t1))
    }
}
