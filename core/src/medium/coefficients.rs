//! The coefficients of one collision.

use super::MajorantSegment;
use crate::spectrum::Sampled;

/// μa, μs, μn and μ̄ at a point, per component and scene unit; μ̄ = μa + μs + μn unless clamped.
#[derive(Clone, Copy, Debug)]
pub struct Coefficients<const N: usize> {
    /// Absorption coefficient μa.
    pub absorption: Sampled<N>,
    /// Scattering coefficient μs.
    pub scattering: Sampled<N>,
    /// Null coefficient μn = μ̄ − μt; negative where the majorant does not bound.
    pub null: Sampled<N>,
    /// Majorant μ̄.
    pub majorant: Sampled<N>,
}

impl<const N: usize> Coefficients<N> {
    /// From extinction μt and albedo, under the segment's majorant and its rule for where that is
    /// exceeded.
    #[must_use]
    pub fn new(extinction: Sampled<N>, albedo: Sampled<N>, segment: &MajorantSegment<N>) -> Self {
        let scattering = extinction * albedo;
        let mut null = segment.majorant - extinction;
        if segment.clamp_null {
            null = null.map(|n| n.max(0.0));
        }
        Self { absorption: extinction - scattering, scattering, null, majorant: segment.majorant }
    }

    /// Extinction μt = μa + μs.
    #[must_use]
    pub fn extinction(&self) -> Sampled<N> {
        self.absorption + self.scattering
    }
}
