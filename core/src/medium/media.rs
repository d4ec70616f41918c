//! All media of a scene along a ray: the interface that transport uses.
//!
//! Coefficients of overlapping media add. Along a ray their majorant segments are merged at the union of the
//! breakpoints, with μ̄ = Σ_k μ̄_k on every piece, so that one walk with one exponential serves all of them.
//! A tentative collision in a piece belongs to medium k with probability μ̄_k / μ̄ of the hero, drawn before
//! any look-up; only that medium is looked up. k is a label of the collision and part of the path, for the
//! walk and for connections alike. The product of the density of a tentative collision and of the label,
//!
//! ```text
//!   μ̄_h e^(−∫μ̄_h) · μ̄_k,h / μ̄_h  =  μ̄_k,h e^(−∫μ̄_h)
//! ```
//!
//! is the density that the collision would have in medium k alone, except that e^(−∫μ̄_h) contains all media.
//! The event then has the densities of `transport/event.rs` with the coefficients and the majorant of medium
//! k alone, which replace those of the mixture in f, p_uni and p_nee:
//!
//! | event in medium k | f_j | p_uni,i | p_nee,i |
//! | --- | --- | --- | --- |
//! | null | μn,k,j | \|μn,k,i\| κ_k,i | μ̄_k,i |
//! | scattering | μs,k,j φ_k | (μs,k,i or μt,k,i) κ_k,i φ_k | the same without φ_k, times the light's density |
//! | emission | μa,k,j Le_k,j | μ̄_k,i | – |
//!
//! Phase function and emission are those of the label. A label that only some techniques kept, or a
//! connection with the sum of all media, would be another path space, and the weights would not sum to one.

use super::{ExtinctionPrior, LocalMedium, MajorantSegment, PlacedMedium};
use crate::math::Ray;
use crate::spectrum::Sampled;
use glam::Vec3;

/// All media of a scene at the components of one path.
pub trait LocalMedia<const N: usize> {
    /// Traversal of the media along a ray.
    type Traversal<'a>: Traversal<N>
    where
        Self: 'a;

    /// Extinction and albedo if there is a single medium with constant coefficients, so that flights and
    /// transmittance have closed forms.
    fn uniform(&self) -> Option<(Sampled<N>, Sampled<N>)> {
        None
    }

    /// The stretch of a ray of world space, with 0 ≤ t ≤ t_max, from its first entry into a medium to its
    /// last exit. Returns the parameter of the entry, from which the traversal measures t; `None` if the ray
    /// misses all media.
    fn traverse(&self, ray: &Ray, t_max: f32) -> Option<(f32, Self::Traversal<'_>)>;
}

/// Traversal of media along a ray: an iterator over the merged majorant segments, in order. Gaps between them
/// are empty.
pub trait Traversal<const N: usize>: Clone + Iterator<Item = MajorantSegment<N>> {
    /// Type of every medium.
    type Medium: LocalMedium<N>;

    /// Parameter of the exit from the last medium; infinite in a medium without a boundary.
    fn t_end(&self) -> f32;

    /// Draws the medium of a collision at `t` in the segment that the iterator returned last, in proportion
    /// to a positive function of each medium's majorant. The random number `u` is requested only where media
    /// overlap.
    fn draw(
        &self,
        t: f32,
        segment: &MajorantSegment<N>,
        proportion: impl Fn(Sampled<N>) -> f32,
        u: impl FnOnce() -> f32,
    ) -> Member<N>;

    /// The medium of a collision.
    fn medium(&self, member: &Member<N>) -> &Self::Medium;

    /// The medium of a collision with its region and its record of violations.
    fn placed(&self, member: &Member<N>) -> &PlacedMedium;

    /// Extinction at `t` in a segment, summed over all media there; one look-up in each.
    fn extinction(&self, t: f32, segment: &MajorantSegment<N>) -> Sampled<N>;

    /// Prior knowledge of the extinction at `t`, summed over all media there, without a look-up.
    fn extinction_prior(&self, t: f32) -> ExtinctionPrior<N>;
}

/// One of the media at a point.
#[derive(Clone, Copy, Debug)]
pub struct Member<const N: usize> {
    /// Position among the media that the ray crosses.
    pub(super) slot: usize,
    /// Index of the medium in the scene.
    pub index: u32,
    /// The point in medium space.
    pub inside: Vec3,
    /// Majorant segment of this medium alone.
    pub segment: MajorantSegment<N>,
    /// The medium's share of the majorant, averaged over the components: the probability with which it is
    /// drawn where the choice must not depend on the hero.
    pub share: f32,
}
