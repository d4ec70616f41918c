//! Coefficients at a collision, and prior knowledge of the extinction without a look-up.

use super::MajorantSegment;
use crate::spectrum::Sampled;

/// Coefficients μa, μs, μn and μ̄ at a point, per component and scene unit; μ̄ = μa + μs + μn.
#[derive(Clone, Copy, Debug)]
pub struct Coefficients<const N: usize> {
    /// Absorption coefficient μa.
    pub absorption: Sampled<N>,
    /// Scattering coefficient μs.
    pub scattering: Sampled<N>,
    /// Null coefficient μn = μ̄ − μt; negative where the extinction exceeds the majorant.
    pub null: Sampled<N>,
    /// Majorant μ̄.
    pub majorant: Sampled<N>,
    /// Maximum ratio μt / μ̄ over the components, before clamping, where it exceeds 1 and is watched; else 1.
    pub excess: f32,
}

impl<const N: usize> Coefficients<N> {
    /// Computes the coefficients from extinction μt and albedo, for a segment's majorant and its rule for
    /// violations. With clamping, the extinction is limited to the majorant: the null coefficient stops at
    /// zero, and every collision is real.
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

/// Expected extinction in the majorant cell of a point, per component and scene unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExtinctionPrior<const N: usize> {
    /// Lower bound of the extinction; zero if unknown.
    pub minorant: Sampled<N>,
    /// Approximate mean of the extinction; zero if unknown.
    pub mean: Sampled<N>,
}

impl<const N: usize> ExtinctionPrior<N> {
    /// Unknown extinction.
    pub const UNKNOWN: Self = Self { minorant: Sampled::ZERO, mean: Sampled::ZERO };

    /// Prior of a constant extinction.
    #[must_use]
    pub fn exact(extinction: Sampled<N>) -> Self {
        Self { minorant: extinction, mean: extinction }
    }

    /// Prior of which only the mean is known.
    #[must_use]
    pub fn of_mean(mean: Sampled<N>) -> Self {
        Self { minorant: Sampled::ZERO, mean }
    }
}
