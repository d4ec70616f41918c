//! The coefficients of one collision.

use super::MajorantSegment;
use crate::spectrum::Sampled;

/// μa, μs, μn and μ̄ at a point, per component and scene unit; μ̄ = μa + μs + μn.
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
    /// Largest quotient μt / μ̄ over components, of the medium as it is, where it exceeds 1 and is looked for; else 1.
    pub excess: f32,
}

impl<const N: usize> Coefficients<N> {
    /// From extinction μt and albedo, under the segment's majorant and its rule for where that is
    /// exceeded. Clamped, the medium is cut off at the majorant: the null coefficient stops at zero and
    /// real collisions happen as often as collisions are drawn.
    #[must_use]
    pub fn new(mut extinction: Sampled<N>, albedo: Sampled<N>, segment: &MajorantSegment<N>) -> Self {
        let excess = if segment.watched { excess(extinction, segment.majorant) } else { 1.0 };
        if segment.clamp_null {
            extinction = extinction.zip(segment.majorant, f32::min);
        }
        let scattering = extinction * albedo;
        let null = segment.majorant - extinction;
        Self { absorption: extinction - scattering, scattering, null, majorant: segment.majorant, excess }
    }

    /// Extinction μt = μa + μs.
    #[must_use]
    pub fn extinction(&self) -> Sampled<N> {
        self.absorption + self.scattering
    }
}

fn excess<const N: usize>(extinction: Sampled<N>, majorant: Sampled<N>) -> f32 {
    extinction.zip(majorant, |t, m| if t > m { t / m } else { 1.0 }).max_component()
}
