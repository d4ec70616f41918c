//! Any kind of medium at the components of a path, matched per segment and per look-up.

use super::rgb_grids::Segments;
use super::{
    AnyMedium, Coefficients, DensityGrid, ExtinctionPrior, Homogeneous, LocalMedium, MajorantSegment, Medium,
    RgbGrids,
};
use crate::math::BoxRay;
use crate::spectrum::{Components, Sampled};
use glam::Vec3;

/// An [`AnyMedium`] at the components of a path.
pub enum LocalAny<'a, const N: usize> {
    /// Constant coefficients.
    Homogeneous(<Homogeneous as Medium>::Local<'a, N>),
    /// A scalar density grid.
    DensityGrid(<DensityGrid as Medium>::Local<'a, N>),
    /// RGB grids.
    RgbGrids(<RgbGrids as Medium>::Local<'a, N>),
}

impl Medium for AnyMedium {
    type Local<'a, const N: usize> = LocalAny<'a, N>;

    fn local<const N: usize, C: Components<N>>(&self, components: &C) -> LocalAny<'_, N> {
        match self {
            Self::Homogeneous(m) => LocalAny::Homogeneous(m.local(components)),
            Self::DensityGrid(m) => LocalAny::DensityGrid(m.local(components)),
            Self::RgbGrids(m) => LocalAny::RgbGrids(m.local(components)),
        }
    }
}

impl<const N: usize> LocalMedium<N> for LocalAny<'_, N> {
    type Segments<'a>
        = Segments<'a, N>
    where
        Self: 'a;

    fn coefficients(&self, point: Vec3, majorant: &MajorantSegment<N>) -> Coefficients<N> {
        match self {
            Self::Homogeneous(m) => m.coefficients(point, majorant),
            Self::DensityGrid(m) => m.coefficients(point, majorant),
            Self::RgbGrids(m) => m.coefficients(point, majorant),
        }
    }

    fn extinction_prior(&self, point: Vec3) -> ExtinctionPrior<N> {
        match self {
            Self::Homogeneous(m) => m.extinction_prior(point),
            Self::DensityGrid(m) => m.extinction_prior(point),
            Self::RgbGrids(m) => m.extinction_prior(point),
        }
    }

    fn control(&self, point: Vec3) -> Option<(Sampled<N>, Sampled<N>)> {
        match self {
            Self::Homogeneous(m) => m.control(point),
            Self::DensityGrid(m) => m.control(point),
            Self::RgbGrids(m) => m.control(point),
        }
    }

    fn segments<'a>(&'a self, ray: &BoxRay) -> Segments<'a, N> {
        match self {
            Self::Homogeneous(m) => Segments::One(m.segments(ray).next()),
            Self::DensityGrid(m) => Segments::Density(m.segments(ray)),
            Self::RgbGrids(m) => m.segments(ray),
        }
    }
}
