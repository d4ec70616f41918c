//! Shared majorants: all components use the largest component's majorant.

use super::{Coefficients, LocalMedium, MajorantSegment};
use crate::math::BoxRay;
use crate::spectrum::Sampled;
use glam::Vec3;
use std::iter::Map;

/// Wrapper of a medium that uses the largest component's majorant for all components.
#[derive(Clone, Copy, Debug)]
pub struct SharedMajorant<L>(pub L);

fn shared<const N: usize>(segment: MajorantSegment<N>) -> MajorantSegment<N> {
    MajorantSegment { majorant: Sampled::splat(segment.majorant.max_component()), ..segment }
}

impl<L: LocalMedium<N>, const N: usize> LocalMedium<N> for SharedMajorant<L> {
    type Segments<'a>
        = Map<L::Segments<'a>, fn(MajorantSegment<N>) -> MajorantSegment<N>>
    where
        Self: 'a;

    fn uniform(&self) -> Option<(Sampled<N>, Sampled<N>)> {
        self.0.uniform()
    }

    fn coefficients(&self, point: Vec3, majorant: &MajorantSegment<N>) -> Coefficients<N> {
        self.0.coefficients(point, majorant)
    }

    fn segments<'a>(&'a self, ray: &BoxRay) -> Self::Segments<'a> {
        self.0.segments(ray).map(shared)
    }
}
