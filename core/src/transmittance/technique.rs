//! Common interface of the transmittance techniques.

use super::Profile;
use crate::math::Sampler;
use crate::spectrum::Sampled;

/// An estimate of exp(−∫μ dt).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate<const N: usize> {
    /// Transmittance per component. The estimates of components are correlated, as they share look-ups.
    pub weight: Sampled<N>,
    /// Number of evaluations of the extinction.
    pub lookups: u32,
}

/// Registry entry of a technique.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Stable id, for files and the command line.
    pub id: &'static str,
    /// Display name.
    pub name: &'static str,
    /// Formula, in one line.
    pub formula: &'static str,
    /// One or two sentences on the method and when it wins.
    pub summary: &'static str,
    /// Cost per estimate.
    pub cost: &'static str,
    /// Source in the literature.
    pub reference: &'static str,
    /// Whether the expectation is the transmittance.
    pub unbiased: bool,
    /// Whether its null collisions are those of a walk through the medium, drawn with a density known per
    /// component. Multiple importance sampling can then weight the connection against the walk. Otherwise the
    /// estimate is only a factor of the contribution.
    pub has_pdf: bool,
}

/// Estimator of transmittance along a ray.
pub trait Technique: Copy + Default {
    /// Description of the technique.
    const ENTRY: Entry;

    /// Draws one estimate from independent random numbers.
    fn estimate<P: Profile<N>, const N: usize>(&self, profile: &P, sampler: &mut Sampler) -> Estimate<N>;
}
