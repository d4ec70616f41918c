//! RGB grids of extinction and albedo, each with its own resolution.
//!
//! Linear sRGB is converted to a coefficient at a wavelength by three basis spectra that are non-negative and
//! sum to one. The map is linear, so interpolating colours and interpolating spectra agree, and the maxima of
//! the grid's components bound the extinction at every wavelength.

use super::density_grid::DensitySegments;
use super::{
    CellWalk, Coefficients, ExtinctionPrior, Grid, Interpolation, LocalMedium, MajorantCells, MajorantGrid,
    MajorantPolicy, MajorantSegment, Medium, Violations,
};
use crate::math::BoxRay;
use crate::spectrum::{Components, Sampled, Spectrum};
use glam::{Affine3A, Vec3};
use std::sync::Arc;

/// Extinction field.
#[derive(Clone, Debug)]
pub enum ExtinctionField {
    /// Constant σt(λ).
    Uniform(Spectrum),
    /// density(x) · σ(λ), with the bounds of the density.
    Density(Arc<Grid<1>>, Arc<MajorantGrid<1>>, Spectrum),
    /// scale · rgb(x), with the bounds of the grid.
    Rgb(Arc<Grid<3>>, Arc<MajorantGrid<3>>, f32),
}

/// Albedo field.
#[derive(Clone, Debug)]
pub enum AlbedoField {
    /// Constant albedo(λ).
    Uniform(Spectrum),
    /// rgb(x), with the transform from the medium's unit cube to the grid's.
    Rgb(Arc<Grid<3>>, Affine3A),
}

/// Medium with an RGB grid of extinction, albedo or both.
#[derive(Clone, Debug)]
pub struct RgbGrids {
    extinction: ExtinctionField,
    albedo: AlbedoField,
    interpolation: Interpolation,
    majorant: MajorantPolicy,
}

impl RgbGrids {
    /// Creates a medium from the two fields.
    #[must_use]
    pub fn new(
        extinction: ExtinctionField,
        albedo: AlbedoField,
        interpolation: Interpolation,
        majorant: MajorantPolicy,
    ) -> Self {
        Self { extinction, albedo, interpolation, majorant }
    }
}

impl RgbGrids {
    /// Relation of the majorant to its bounds.
    pub(super) fn majorant(&self) -> MajorantPolicy {
        self.majorant
    }

    /// Returns the medium with bounds raised by violations; see [`super::AnyMedium::raised`].
    pub(super) fn raised(&self, by: &Violations) -> Self {
        let mut raised = self.clone();
        match &mut raised.extinction {
            ExtinctionField::Uniform(_) => raised.majorant = self.majorant.raised(by.largest([0; 3])),
            ExtinctionField::Density(_, bounds, _) => *bounds = Arc::new(bounds.raised(by)),
            ExtinctionField::Rgb(_, bounds, _) => *bounds = Arc::new(bounds.raised(by)),
        }
        raised
    }

    /// Cells of the local majorants, if the extinction comes from a grid.
    #[must_use]
    pub fn majorant_cells(&self) -> Option<MajorantCells<'_>> {
        match &self.extinction {
            ExtinctionField::Uniform(_) => None,
            ExtinctionField::Density(_, bounds, _) => Some(MajorantCells::Density(bounds)),
            ExtinctionField::Rgb(_, bounds, _) => Some(MajorantCells::Rgb(bounds)),
        }
    }
}

/// An [`RgbGrids`] medium at the components of a path.
#[derive(Clone, Debug)]
pub struct LocalRgbGrids<'a, const N: usize> {
    medium: &'a RgbGrids,
    /// Columns: values of unit red, green and blue at each component.
    primaries: [Sampled<N>; 3],
    extinction: Sampled<N>,
    albedo: Sampled<N>,
    /// Majorant at a density bound of 1, or the scale of an RGB grid.
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
            ExtinctionField::Uniform(s) | ExtinctionField::Density(_, _, s) => components.evaluate(s),
            ExtinctionField::Rgb(_, _, scale) => Sampled::splat(*scale),
        };
        let majorant = match &self.extinction {
            ExtinctionField::Uniform(s) | ExtinctionField::Density(_, _, s) => {
                self.majorant.of(components, s)
            }
            ExtinctionField::Rgb(..) => extinction,
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
            majorant,
        }
    }
}

impl<const N: usize> LocalMedium<N> for LocalRgbGrids<'_, N> {
    type Segments<'a>
        = Segments<'a, N>
    where
        Self: 'a;

    fn coefficients(&self, point: Vec3, majorant: &MajorantSegment<N>) -> Coefficients<N> {
        let interpolation = self.medium.interpolation;
        let extinction = match &self.medium.extinction {
            ExtinctionField::Uniform(_) => self.extinction,
            ExtinctionField::Density(grid, ..) => self.extinction * grid.look_up(point, interpolation, 0)[0],
            ExtinctionField::Rgb(grid, ..) => {
                self.extinction * self.upsample(grid.look_up(point, interpolation, 0))
            }
        };
        let albedo = match &self.medium.albedo {
            AlbedoField::Uniform(_) => self.albedo,
            AlbedoField::Rgb(grid, grid_from_unit) => {
                self.upsample(grid.look_up(grid_from_unit.transform_point3(point), interpolation, 1))
            }
        };
        Coefficients::new(extinction, albedo, majorant)
    }

    fn extinction_prior(&self, point: Vec3) -> ExtinctionPrior<N> {
        match &self.medium.extinction {
            ExtinctionField::Uniform(_) => ExtinctionPrior::exact(self.extinction),
            ExtinctionField::Density(_, bounds, _) => {
                ExtinctionPrior::of_mean(self.extinction * bounds.mean(bounds.cell_at(point)))
            }
            ExtinctionField::Rgb(_, bounds, _) => {
                // Only the mean of the largest channel is stored; the others are assumed to be proportional
                // to their bounds.
                let cell = bounds.cell_at(point);
                let bound = bounds.bound(cell);
                let largest = bound.iter().fold(f32::MIN_POSITIVE, |a, b| a.max(*b));
                ExtinctionPrior::of_mean(
                    self.extinction * self.upsample(bound) * (bounds.mean(cell) / largest),
                )
            }
        }
    }

    fn control(&self, point: Vec3) -> Option<(Sampled<N>, Sampled<N>)> {
        let AlbedoField::Uniform(_) = &self.medium.albedo else { return None };
        let extinction = match &self.medium.extinction {
            ExtinctionField::Uniform(_) => self.extinction,
            ExtinctionField::Density(_, bounds, _) => {
                self.extinction * bounds.least(bounds.cell_at(point))[0]
            }
            ExtinctionField::Rgb(_, bounds, _) => {
                self.extinction * self.upsample(bounds.least(bounds.cell_at(point)))
            }
        };
        (!extinction.is_zero()).then_some((extinction, self.albedo))
    }

    fn segments<'a>(&'a self, ray: &BoxRay) -> Self::Segments<'a> {
        let policy = self.medium.majorant;
        match &self.medium.extinction {
            ExtinctionField::Uniform(_) => Segments::One(Some(policy.segment(self.majorant, 0.0, ray.t_end))),
            ExtinctionField::Density(_, bounds, _) => Segments::Density(DensitySegments {
                cells: bounds.walk(ray),
                majorant: self.majorant,
                policy,
            }),
            ExtinctionField::Rgb(_, bounds, _) => Segments::Rgb(bounds.walk(ray), self),
        }
    }
}

/// Majorant segments along a ray, for any extinction field.
#[derive(Clone, Debug)]
pub enum Segments<'a, const N: usize> {
    /// A single segment of constant extinction.
    One(Option<MajorantSegment<N>>),
    /// Segments proportional to the bounds of a density.
    Density(DensitySegments<'a, N>),
    /// Segments from the bounds of three channels.
    Rgb(CellWalk<'a, 3>, &'a LocalRgbGrids<'a, N>),
}

impl<const N: usize> Iterator for Segments<'_, N> {
    type Item = MajorantSegment<N>;

    fn next(&mut self) -> Option<MajorantSegment<N>> {
        match self {
            Self::One(segment) => segment.take(),
            Self::Density(segments) => segments.next(),
            Self::Rgb(cells, local) => {
                let cell = cells.next()?;
                let policy = local.medium.majorant;
                let largest = cell.bound.iter().fold(0.0f32, |a, b| a.max(*b)) * local.majorant.hero();
                let majorant = policy.of_bound(local.majorant * local.upsample(cell.bound), largest);
                Some(policy.segment(majorant, cell.t0, cell.t1))
            }
        }
    }
}
