//! Traits of the path weights, and the forms in which an estimator can store them.

use super::{
    Collision, DirectionSample, FaultyWeights, PathSettings, PathWeights, WeightRecord, WeightsApart,
    WeightsPairwise,
};
use crate::scene::Heuristics;
use crate::spectrum::{Radiance, Sampled};

/// f, p_uni and p_nee of a path under construction, in any form.
pub trait WalkWeights<const N: usize>: Copy {
    /// Weights of a path that has just left the camera.
    const CAMERA: Self;

    /// Initial weights for paths with these settings.
    #[must_use]
    fn starting(_: &PathSettings) -> Self {
        Self::CAMERA
    }

    /// Multiplies in a stretch without collision, of majorant optical depth μ̄ᵢ t: e^(−μ̄ᵢ t) for all three.
    /// The exponential may be evaluated once for many stretches, when a value is computed.
    fn pass(&mut self, optical_depth: Sampled<N>);

    /// Updates the weights for a collision that the walk has drawn as null. p_nee is multiplied by μ̄,
    /// because next-event estimation takes every collision of a connection as null.
    fn null(&mut self, c: &Collision<N>);

    /// Updates the weights for a collision on a connection, where ratio tracking takes every collision as
    /// null.
    fn null_by_ratio(&mut self, c: &Collision<N>);

    /// Updates the weights for a collision that the walk has drawn as scattering: μs, without the phase
    /// function.
    fn scatter(&mut self, c: &Collision<N>);

    /// Updates the weights for a diffuse reflection: its albedo, without the cosine lobe.
    fn reflect(&mut self, albedo: Sampled<N>);

    /// Updates the weights for leaving a vertex in a sampled direction: f is multiplied by the phase function
    /// or cosine lobe, p_uni by the density, and p_nee by neither, as next-event estimation would have
    /// sampled a light here. The light's density is multiplied into p_nee in [`Weights::combined`].
    fn choose_direction(&mut self, outgoing: &DirectionSample);

    /// Updates the weights for leaving a surface whose lobes depend on the component: f_j is multiplied by the
    /// value, p_uni,i by the density. p_nee is multiplied by neither, and is zero if no connection can have
    /// the direction.
    fn leave(&mut self, value: Sampled<N>, density: Sampled<N>, connects: bool);

    /// Multiplies f and p_uni of a connection, relative to the direction with which it was made.
    fn adjust(&mut self, value: Sampled<N>, density: Sampled<N>);

    /// Value of a path that ends at a collision where the medium emits. Every tentative collision is such an
    /// end, so its density is p_uni,i μ̄_i, and with the balance heuristic the value is
    /// f_j μa_j / mean (p_uni,i μ̄_i).
    fn emitted<R: Radiance<N>>(&self, radiance: R, c: &Collision<N>, heuristics: Heuristics) -> R;

    /// Updates the weights for surviving Russian roulette with probability `q`.
    fn survive(&mut self, q: f32);

    /// Largest contribution of any component, divided by the mean density over heroes; independent of which
    /// component is the hero.
    fn throughput(&self) -> f32;

    /// Returns the weights in their stored form, for an observer.
    fn weight_record(&self) -> WeightRecord;

    /// Whether the path can no longer contribute.
    fn is_zero(&self) -> bool;

    /// Value of a path made by unidirectional sampling only; with the balance heuristic f_j / mean p_uni.
    fn unidirectional<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R;
}

/// Path weights of an estimator that connects vertices to lights.
pub trait Weights<const N: usize>: WalkWeights<N> {
    /// Weights of a connection from a vertex in the direction `outgoing`, drawn with `light_density`; the
    /// walk would have drawn it with the density in `outgoing`. From here on P is p_nee of the hero.
    #[must_use]
    fn connect(&self, outgoing: &DirectionSample, light_density: f32) -> Self;

    /// Multiplies in a connection's transmittance from an estimator that has no path density.
    fn attenuate(&mut self, transmittance: Sampled<N>);

    /// Value of a connection where only connections make such paths; with the balance heuristic
    /// f_j / mean p_nee.
    fn connected_only<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R;

    /// Value of a walk that has reached a light which light sampling would have drawn with `light_density`;
    /// with the balance heuristics f_j / mean (p_uni + p_nee).
    fn combined<R: Radiance<N>>(&self, radiance: R, light_density: f32, heuristics: Heuristics) -> R;

    /// Value of a connection; with the balance heuristics f_j / mean (p_uni + p_nee). P already includes its
    /// light density.
    fn connected_combined<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R;
}

/// Form of the path weights, for any number of components.
pub trait WeightForm {
    /// Weights in this form.
    type Weights<const N: usize>: Weights<N>;
}

/// Quotients by the density with which the path was made ([`PathWeights`]); the default.
#[derive(Clone, Copy, Debug)]
pub struct Rescaled;

/// Separate f and p in single precision, as in the report.
#[derive(Clone, Copy, Debug)]
pub struct ApartF32;

/// Separate f and p in double precision.
#[derive(Clone, Copy, Debug)]
pub struct ApartF64;

/// Miller's quotients p_i / f_j of all pairs.
#[derive(Clone, Copy, Debug)]
pub struct Pairwise;

/// Rescaled weights with a deliberate error ([`FaultyWeights`]).
#[derive(Clone, Copy, Debug)]
pub struct Faulty;

impl WeightForm for Faulty {
    type Weights<const N: usize> = FaultyWeights<N>;
}

impl WeightForm for Rescaled {
    type Weights<const N: usize> = PathWeights<N>;
}

impl WeightForm for ApartF32 {
    type Weights<const N: usize> = WeightsApart<f32, N>;
}

impl WeightForm for ApartF64 {
    type Weights<const N: usize> = WeightsApart<f64, N>;
}

impl WeightForm for Pairwise {
    type Weights<const N: usize> = WeightsPairwise<N>;
}
