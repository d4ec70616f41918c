//! Homogeneous medium: σt(λ) and albedo(λ) are constant in the box.

use super::{Coefficients, ExtinctionPrior, LocalMedium, MajorantPolicy, MajorantSegment, Medium};
use crate::math::BoxRay;
use crate::spectrum::{Components, Sampled, Spectrum};
use glam::Vec3;

/// A medium with constant coefficients.
#[derive(Clone, Debug)]
pub struct Homogeneous {
    /// Extinction σt(λ), per scene unit.
    pub extinction: Spectrum,
    /// Albedo(λ).
    pub albedo: Spectrum,
    /// Majorant relative to the extinction.
    pub majorant: MajorantPolicy,
}

/// A [`Homogeneous`] medium at the components of a path.
#[derive(Clone, Copy, Debug)]
pub struct LocalHomogeneous<const N: usize> {
    extinction: Sampled<N>,
    albedo: Sampled<N>,
    majorant: Sampled<N>,
    policy: MajorantPolicy,
}

impl Medium for Homogeneous {
    type Local<'a, const N: usize> = LocalHomogeneous<N>;

    fn local<const N: usize, C: Components<N>>(&self, components: &C) -> LocalHomogeneous<N> {
        LocalHomogeneous {
            extinction: components.evaluate(&self.extinction),
            albedo: components.evaluate(&self.albedo),
            majorant: self.majorant.of(components, &self.extinction),
            policy: self.majorant,
        }
    }
}

impl<const N: usize> LocalMedium<N> for LocalHomogeneous<N> {
    type Segments<'a> = std::iter::Once<MajorantSegment<N>>;

    fn uniform(&self) -> Option<(Sampled<N>, Sampled<N>)> {
        Some((self.extinction, self.albedo))
    }

    fn coefficients(&self, _point: Vec3, majorant: &MajorantSegment<N>) -> Coefficients<N> {
        Coefficients::new(self.extinction, self.albedo, majorant)
    }

    fn extinction_prior(&self, _point: Vec3) -> ExtinctionPrior<N> {
        ExtinctionPrior::exact(self.extinction)
    }

    fn control(&self, _point: Vec3) -> Option<(Sampled<N>, Sampled<N>)> {
        Some((self.extinction, self.albedo))
    }

    fn segments<'a>(&'a self, ray: &BoxRay) -> Self::Segments<'a> {
        std::iter::once(self.policy.segment(self.majorant, 0.0, ray.t_end))
    }
}
