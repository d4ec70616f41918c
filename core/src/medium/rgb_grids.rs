//! RGB grids for extinction and for albedo, each with a resolution of its own.
//!
//! Linear sRGB becomes a coefficient at a wavelength through three basis spectra that are not negative
//! and sum to one. The map is linear, so interpolating colours and interpolating spectra agree, and the
//! grid's largest components bound the extinction at every wavelength.

use super::{Coefficients, Grid, LocalMedium, MajorantPolicy, MajorantSegment, Medium};
use crate::math::Ray;
use crate::spectrum::{Components, Quantity, Sampled, Spectrum, SpectrumDoc};
use glam::{Affine3A, Vec3};
use std::sync::Arc;

/// Where extinction comes from.
#[derive(Clone, Debug)]
pub enum ExtinctionField {
    /// σt(λ) everywhere.
    Uniform(Spectrum),
    /// density(x) · σ(λ).
    Density(Arc<Grid<1>>, Spectrum),
    /// scale · rgb(x).
    Rgb(Arc<Grid<3>>, f32),
}

/// Where albedo comes from.
#[derive(Clone, Debug)]
pub enum AlbedoField {
    /// albedo(λ) everywhere.
    Uniform(Spectrum),
    /// rgb(x), looked up through a map from the medium's unit cube to the grid's own.
    Rgb(Arc<Grid<3>>, Affine3A),
}

/// A medium in which extinction, albedo or both come from RGB grids.
#[derive(Clone, Debug)]
pub struct RgbGrids {
    extinction: ExtinctionField,
    albedo: AlbedoField,
    /// Bounds the extinction at every wavelength.
    bound: Spectrum,
    majorant: MajorantPolicy,
}

impl RgbGrids {
    /// Combines the two fields.
    #[must_use]
    pub fn new(extinction: ExtinctionField, albedo: AlbedoField, majorant: MajorantPolicy) -> Self {
        let bound = match &extinction {
            ExtinctionField::Uniform(sigma) => sigma.clone(),
            ExtinctionField::Density(grid, sigma) => sigma.clone().scaled(grid.max()[0]),
            ExtinctionField::Rgb(grid, scale) => {
                let rgb = SpectrumDoc::Rgb(grid.max());
                Spectrum::new(&rgb, Quantity::Coefficient).scaled(*scale)
            }
        };
        Self { extinction, albedo, bound, majorant }
    }
}

/// [`RgbGrids`] at a path's components.
#[derive(Clone, Debug)]
pub struct LocalRgbGrids<'a, const N: usize> {
    medium: &'a RgbGrids,
    /// Columns: what 1 of red, green and blue is at each component.
    primaries: [Sampled<N>; 3],
    extinction: Sampled<N>,
    albedo: Sampled<N>,
    majorant: Sampled<N>,
}

impl<const N: usize> LocalRgbGrids<'_, N> {
    fn upsample(&self, rgb: [f32; 3]) -> Sampled<N> {
        self.primaries[0] * rgb[0] + self.primaries[1] * rgb[1] + self.primaries[2] * rgb[2]
    }
}

impl Medium for RgbGrids {
    type Local<'a, const N: usize> = LocalRgbGrids<'a, N>;

    fn local<const N: usize, C: Components<N>>(&self, components: &C) -> LocalRgbGrids<'_, N> {
        let extinction = match &self.extinction {
            ExtinctionField::Uniform(s) | ExtinctionField::Density(_, s) => components.evaluate(s),
            ExtinctionField::Rgb(_, scale) => Sampled::splat(*scale),
        };
        let albedo = match &self.albedo {
            AlbedoField::Uniform(s) => components.evaluate(s),
            AlbedoField::Rgb(..) => Sampled::ONE,
        };
        LocalRgbGrids {
            medium: self,
            primaries: Vec3::AXES.map(|axis| components.upsample(axis)),
            extinction,
            albedo,
            majorant: self.majorant.global(components, &self.bound),
        }
    }
}

impl<const N: usize> LocalMedium<N> for LocalRgbGrids<'_, N> {
    type Segments<'a>
        = std::iter::Once<MajorantSegment<N>>
    where
        Self: 'a;

    fn coefficients(&self, point: Vec3, majorant: &MajorantSegment<N>) -> Coefficients<N> {
        let extinction = match &self.medium.extinction {
            ExtinctionField::Uniform(_) => self.extinction,
            ExtinctionField::Density(grid, _) => self.extinction * grid.at(point)[0],
            ExtinctionField::Rgb(grid, _) => self.extinction * self.upsample(grid.at(point)),
        };
        let albedo = match &self.medium.albedo {
            AlbedoField::Uniform(_) => self.albedo,
            AlbedoField::Rgb(grid, grid_from_unit) => {
                self.upsample(grid.at(grid_from_unit.transform_point3(point)))
            }
        };
        Coefficients::new(extinction, albedo, majorant)
    }

    fn segments<'a>(&'a self, _ray: &Ray, t0: f32, t1: f32) -> Self::Segments<'a> {
        std::iter::once(self.medium.majorant.segment(self.majorant, t0, t1))
    }
}
