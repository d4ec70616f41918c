//! What an estimator keeps of a path, whichever way it does.

use super::{
    Collision, DirectionSample, FaultyWeights, PathSettings, PathWeights, WeightRecord, WeightsApart,
    WeightsPairwise,
};
use crate::scene::Heuristics;
use crate::spectrum::{Radiance, Sampled};

/// f, p_uni and p_nee of a path under construction, in some form.
pub trait WalkWeights<const N: usize>: Copy {
    /// A path that has just left the camera.
    const CAMERA: Self;

    /// The same, for paths with these settings.
    #[must_use]
    fn starting(_: &PathSettings) -> Self {
        Self::CAMERA
    }

    /// A stretch without collision, of optical depth μ̄ᵢ t by the majorants: e^(−μ̄ᵢ t) for all. The
    /// exponential is taken once for many stretches, when a value is asked for.
    fn pass(&mut self, optical_depth: Sampled<N>);

    /// A collision that the walk has drawn as null. Next-event estimation takes every collision of a
    /// connection as null, hence its μ̄.
    fn null(&mut self, c: &Collision<N>);

    /// A collision on a connection, which takes all as null (ratio tracking).
    fn null_by_ratio(&mut self, c: &Collision<N>);

    /// A collision that the walk has drawn as scattering: μs, without the phase function.
    fn scatter(&mut self, c: &Collision<N>);

    /// A diffuse reflection: its albedo, without the cosine lobe.
    fn reflect(&mut self, albedo: Sampled<N>);

    /// Leaves a vertex in a direction that was drawn: f gains the phase function or cosine lobe, p_uni the
    /// density; p_nee neither, as a light would have been sampled here instead. The light's own density
    /// joins p_nee in [`Weights::combined`].
    fn leave(&mut self, outgoing: &DirectionSample);

    /// The value of a path that ends at a collision, where the medium emits: every tentative collision is such an
    /// end, so that its density is p_uni,i μ̄_i, and by the balance heuristic f_j μa_j / mean (p_uni,i μ̄_i).
    fn emitted<R: Radiance<N>>(&self, radiance: R, c: &Collision<N>, heuristics: Heuristics) -> R;

    /// Continues with probability `q`.
    fn survive(&mut self, q: f32);

    /// How bright the path is at its brightest component relative to how likely it is for any hero;
    /// the same whichever component is the hero.
    fn throughput(&self) -> f32;

    /// The numbers that are kept, for whoever looks on.
    fn kept(&self) -> WeightRecord;

    /// Whether nothing can come of the path any more.
    fn is_dark(&self) -> bool;

    /// The path's value if only unidirectional sampling makes it; by the balance heuristic f_j / mean p_uni.
    fn unidirectional<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R;
}

/// What an estimator keeps of a path from whose vertices it connects to lights.
pub trait Weights<const N: usize>: WalkWeights<N> {
    /// A connection from a vertex in a direction that was drawn with `light_density`, and would be a turn of
    /// the path. From here on P is p_nee of the hero.
    #[must_use]
    fn connect(&self, outgoing: &DirectionSample, light_density: f32) -> Self;

    /// A connection's transmittance, estimated by something that has no density.
    fn attenuate(&mut self, transmittance: Sampled<N>);

    /// A connection's value if only connections make such paths; by the balance heuristic f_j / mean p_nee.
    fn connected_only<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R;

    /// The value of a walk that has met a light which light sampling would have drawn with
    /// `light_density`; by the balance heuristics f_j / mean (p_uni + p_nee).
    fn combined<R: Radiance<N>>(&self, radiance: R, light_density: f32, heuristics: Heuristics) -> R;

    /// The value of a connection; by the balance heuristics f_j / mean (p_uni + p_nee). Its light density is
    /// in P already.
    fn connected_combined<R: Radiance<N>>(&self, radiance: R, heuristics: Heuristics) -> R;
}

/// A way to keep the books: the form of the weights at any number of components.
pub trait WeightForm {
    /// The form.
    type Weights<const N: usize>: Weights<N>;
}

/// Quotients by the density with which the path was made: the default.
#[derive(Clone, Copy, Debug)]
pub struct Rescaled;

/// f and p apart in single precision, as the report prints them.
#[derive(Clone, Copy, Debug)]
pub struct ApartF32;

/// f and p apart in double precision.
#[derive(Clone, Copy, Debug)]
pub struct ApartF64;

/// Miller's quotients p_i / f_j of all pairs.
#[derive(Clone, Copy, Debug)]
pub struct Pairwise;

/// Quotients with a planted mistake.
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
