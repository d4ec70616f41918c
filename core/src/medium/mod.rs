//! Participating media.
//!
//! A medium provides two things only (the report's appendix B): its coefficients at a point, and majorant
//! segments along a ray. Sampling, events and transmittance are in [`crate::transport`].
//!
//! A grid fills the unit cube of its own *medium space*, which an affine transform places in the world. Rays
//! are transformed to medium space with unchanged parameter `t`, so that distances, and therefore coefficients
//! per scene unit, are preserved under any placement. A homogeneous medium may instead fill a ball or all of
//! space ([`Region`]).
//!
//! A scene has any number of media; where they overlap, their coefficients add. [`LocalMedia`] is the
//! interface to all of them along a ray.

mod albedo;
mod any;
mod cell_walk;
mod coefficients;
mod density_grid;
mod emission;
mod grid;
mod homogeneous;
mod majorant;
mod majorant_grid;
mod majorants;
mod media;
mod one;
mod placed;
mod region;
mod rgb_grids;
mod several;
mod shared_majorant;
mod violations;

pub use albedo::{diffuse_albedo, single_scattering_albedo};
pub use any::LocalAny;
pub use cell_walk::{CellSegment, CellWalk};
pub use coefficients::{Coefficients, ExtinctionPrior};
pub use density_grid::DensityGrid;
pub use emission::Emission;
pub use grid::{BRICK_EDGE, Bricks, Grid, Interpolation, Lattice, Packing, Precision};
pub use homogeneous::Homogeneous;
pub use majorant::{MajorantDoc, MajorantPolicy, MajorantSegment, WhenExceeded};
pub use majorant_grid::MajorantGrid;
pub use majorants::{MAX_MAJORANT_CELLS, Majorants};
pub use media::{LocalMedia, Member, Traversal};
pub use one::{One, OneTraversal};
pub use placed::PlacedMedium;
pub use region::Region;
pub use rgb_grids::{AlbedoField, ExtinctionField, RgbGrids};
pub use several::{Several, SeveralTraversal};
pub use shared_majorant::SharedMajorant;
pub use violations::Violations;

use crate::math::BoxRay;
use crate::spectrum::{Components, Sampled};
use glam::Vec3;
use std::sync::Arc;

/// Medium, independent of the components of a path.
pub trait Medium: Send + Sync {
    /// The medium at the components of one path.
    type Local<'a, const N: usize>: LocalMedium<N>
    where
        Self: 'a;

    /// Evaluates all spectra at a path's components, once per path.
    fn local<const N: usize, C: Components<N>>(&self, components: &C) -> Self::Local<'_, N>;
}

/// Medium at the components of one path: the interface that transport uses.
pub trait LocalMedium<const N: usize> {
    /// Majorant segments along a ray.
    type Segments<'a>: Clone + Iterator<Item = MajorantSegment<N>>
    where
        Self: 'a;

    /// Extinction and albedo if they are constant in space, so that flights and transmittance have closed
    /// forms.
    fn uniform(&self) -> Option<(Sampled<N>, Sampled<N>)> {
        None
    }

    /// Absorption, scattering and null coefficient at a point of medium space, relative to the majorant of
    /// the segment that contains the point. One density look-up.
    fn coefficients(&self, point: Vec3, majorant: &MajorantSegment<N>) -> Coefficients<N>;

    /// Prior knowledge of the extinction around a point of medium space, without a look-up. Unknown by
    /// default.
    fn extinction_prior(&self, _point: Vec3) -> ExtinctionPrior<N> {
        ExtinctionPrior::UNKNOWN
    }

    /// Control extinction μc of decomposition tracking, a lower bound of the extinction around a point of
    /// medium space, and the albedo there, if both are known without a look-up.
    fn control(&self, _point: Vec3) -> Option<(Sampled<N>, Sampled<N>)> {
        None
    }

    /// Majorant segments along a ray through the unit cube, in order. Gaps between them are empty.
    fn segments<'a>(&'a self, ray: &BoxRay) -> Self::Segments<'a>;
}

/// Any kind of medium, matched once before a monomorphised loop.
#[derive(Clone, Debug)]
pub enum AnyMedium {
    /// Constant coefficients.
    Homogeneous(Homogeneous),
    /// A scalar density grid times an extinction spectrum.
    DensityGrid(DensityGrid),
    /// RGB grids for extinction, albedo or both.
    RgbGrids(RgbGrids),
}

/// Grid of local bounds of a medium.
#[derive(Clone, Copy, Debug)]
pub enum MajorantCells<'a> {
    /// Bounds of a density.
    Density(&'a MajorantGrid<1>),
    /// Bounds of an RGB grid.
    Rgb(&'a MajorantGrid<3>),
}

impl MajorantCells<'_> {
    /// Cells per axis.
    #[must_use]
    pub fn cells(&self) -> usize {
        match self {
            Self::Density(grid) => grid.cells(),
            Self::Rgb(grid) => grid.cells(),
        }
    }

    /// Mean of the field in a cell over its bound, which is the fraction of real collisions there at factor
    /// 1; `None` in an empty cell.
    #[must_use]
    pub fn tightness(&self, cell: [usize; 3]) -> Option<f32> {
        let (mean, bound) = match self {
            Self::Density(grid) => (grid.mean(cell), grid.bound(cell)[0]),
            Self::Rgb(grid) => (grid.mean(cell), grid.bound(cell).into_iter().fold(0.0, f32::max)),
        };
        (bound > 0.0).then(|| (mean / bound).min(1.0))
    }
}

impl AnyMedium {
    /// Cells of the local majorants; `None` in a homogeneous medium, whose majorant is its extinction.
    #[must_use]
    pub fn majorant_cells(&self) -> Option<MajorantCells<'_>> {
        match self {
            Self::Homogeneous(_) => None,
            Self::DensityGrid(m) => Some(MajorantCells::Density(&m.bounds)),
            Self::RgbGrids(m) => m.majorant_cells(),
        }
    }

    /// Returns whether the extinction may exceed the majorant.
    #[must_use]
    pub fn is_watched(&self) -> bool {
        match self {
            Self::Homogeneous(m) => m.majorant.is_watched(),
            Self::DensityGrid(m) => m.majorant.is_watched(),
            Self::RgbGrids(m) => m.majorant().is_watched(),
        }
    }

    /// Returns whether bounds are raised where they are found to be exceeded.
    #[must_use]
    pub fn is_progressive(&self) -> bool {
        match self {
            Self::Homogeneous(m) => m.majorant.is_progressive(),
            Self::DensityGrid(m) => m.majorant.is_progressive(),
            Self::RgbGrids(m) => m.majorant().is_progressive(),
        }
    }

    /// Returns the medium with its bounds raised wherever the extinction was found to exceed them.
    #[must_use]
    pub fn raised(&self, by: &Violations) -> Self {
        match self {
            Self::Homogeneous(m) => Self::Homogeneous(Homogeneous {
                majorant: m.majorant.raised(by.largest([0; 3])),
                ..m.clone()
            }),
            Self::DensityGrid(m) => {
                Self::DensityGrid(DensityGrid { bounds: Arc::new(m.bounds.raised(by)), ..m.clone() })
            }
            Self::RgbGrids(m) => Self::RgbGrids(m.raised(by)),
        }
    }

    /// Returns whether extinction and albedo are independent of wavelength everywhere.
    #[must_use]
    pub fn is_achromatic(&self) -> bool {
        match self {
            Self::Homogeneous(m) => m.extinction.is_flat() && m.albedo.is_flat(),
            Self::DensityGrid(m) => m.extinction.is_flat() && m.albedo.is_flat(),
            Self::RgbGrids(_) => false,
        }
    }
}
