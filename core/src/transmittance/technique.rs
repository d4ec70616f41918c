//! What every technique is and gives.

use super::Profile;
use crate::math::Sampler;
use crate::spectrum::Sampled;

/// An estimate of exp(−∫μ dt).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate<const N: usize> {
    /// Transmittance per component. Estimates of components are correlated: they share their look-ups.
    pub weight: Sampled<N>,
    /// Evaluations of the extinction.
    pub lookups: u32,
}

/// A technique as people meet it.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Stable id, for files and the command line.
    pub id: &'static str,
    /// Name for people.
    pub name: &'static str,
    /// What is computed, in one line.
    pub formula: &'static str,
    /// What it does and when it wins, in one or two sentences.
    pub summary: &'static str,
    /// What it costs.
    pub cost: &'static str,
    /// Where it comes from.
    pub reference: &'static str,
    /// Whether the expectation is the transmittance.
    pub unbiased: bool,
    /// Whether its null collisions are those of a walk through the medium, drawn with a density that is known per
    /// component: multiple importance sampling can then weigh the connection against the walk, vertex by
    /// vertex. Without, the estimate is a number that can be multiplied with, and no more.
    pub has_pdf: bool,
}

/// A way to estimate transmittance along a ray.
pub trait Technique: Copy + Default {
    /// How people meet it.
    const ENTRY: Entry;

    /// One estimate from independent random numbers.
    fn estimate<P: Profile<N>, const N: usize>(&self, profile: &P, sampler: &mut Sampler) -> Estimate<N>;
}
