//! Observation of a path while it is traced.
//!
//! A [`Trace`](super::Trace) may have an [`Observer`]. The same kernel then traces the same path with the
//! same random numbers and reports every step as a [`Note`]; without an observer a step costs a test of an
//! empty option. Replay of paths, contributions by technique, and explanations of paths are all built on it.

use super::{CancelToken, Event};
use crate::math::Ray;
use crate::spectrum::{Carried, Lanes, Sampled};
use glam::{Vec2, Vec3};
use std::fmt;

/// Sampling technique of a contribution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Technique {
    /// The walk, which has reached a light.
    Walk,
    /// A connection from a vertex to a light.
    Connection,
    /// A vertex drawn by equiangular sampling, and its connection.
    Equiangular,
    /// The walk, which has collided where the medium emits.
    Emission,
}

impl Technique {
    /// All techniques, in the order of tables.
    pub const ALL: [Self; 4] = [Self::Walk, Self::Connection, Self::Equiangular, Self::Emission];

    /// Display name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Walk => "unidirectional",
            Self::Connection => "next-event",
            Self::Equiangular => "equiangular",
            Self::Emission => "emission",
        }
    }
}

/// Record of a tentative collision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CollisionRecord {
    /// Position in world space.
    pub point: Vec3,
    /// Index of the medium among those of the scene.
    pub medium: u32,
    /// Majorant optical depth since the last note of the walk, per component.
    pub passed: Lanes,
    /// Absorption coefficient μa.
    pub absorption: Lanes,
    /// Scattering coefficient μs.
    pub scattering: Lanes,
    /// Null coefficient μn, negative where the majorant is exceeded.
    pub null: Lanes,
    /// Majorant μ̄.
    pub majorant: Lanes,
    /// Density of a tentative collision with this part of the medium: μ̄ for the whole medium.
    pub tentative: Lanes,
    /// Density of a null collision.
    pub null_density: Lanes,
    /// Density of scattering.
    pub scattering_density: Lanes,
}

/// Path weights in an estimator's own form: three numbers per component, with their names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeightRecord {
    /// Names of the numbers, for instance `f/P`, `p_uni/P`, `p_nee/P`.
    pub names: [&'static str; 3],
    /// Values of the numbers.
    pub values: [Lanes; 3],
}

impl WeightRecord {
    /// Record of an estimator that keeps one number: throughput over density.
    #[must_use]
    pub fn throughput<const N: usize>(phi: Sampled<N>) -> Self {
        Self { names: ["φ", "", ""], values: [phi.lanes(), [0.0; 4], [0.0; 4]] }
    }
}

/// One step of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Note {
    /// The path leaves the camera.
    Camera {
        /// Camera ray.
        ray: Ray,
        /// Random numbers of the position within the pixel.
        jitter: Vec2,
        /// Random number of the components.
        u: f32,
        /// Meaning of the components.
        carried: Carried,
    },
    /// A walk or a connection has found a tentative collision; the weights are those before its outcome.
    Collision(CollisionRecord, WeightRecord),
    /// A walk or a connection has left the medium.
    Exit {
        /// Majorant optical depth since the last note, per component.
        passed: Lanes,
        /// Path weights at the exit.
        weight_record: WeightRecord,
    },
    /// Path weights after the last event of the current walk or connection, where the note of the event does
    /// not have them.
    Weights(WeightRecord),
    /// A walk has drawn the event at its last collision.
    Drawn {
        /// The outcome.
        event: Event,
        /// Random number.
        u: f32,
    },
    /// An event has been drawn for all components at once.
    DrawnForAll {
        /// The outcome.
        event: Event,
        /// Random number, between 0 and 1.
        u: f32,
        /// Density of the outcome, by which f and the densities were divided.
        density: f32,
    },
    /// A free flight of which only the weight is known: contribution over density.
    Flight {
        /// Scattering position; `None` if the flight leaves the medium.
        scattered_at: Option<Vec3>,
        /// Factor of the path's weight.
        weight: Lanes,
    },
    /// The path is reflected by a surface.
    Surface {
        /// Position.
        point: Vec3,
        /// Albedo of the surface.
        albedo: Lanes,
    },
    /// The path has reached its next real vertex, with these weights.
    Vertex(WeightRecord),
    /// Russian roulette: the path survives with probability `q`, or ends.
    Roulette {
        /// Random number.
        u: f32,
        /// Survival probability.
        q: f32,
    },
    /// The path leaves its vertex in a new direction.
    Direction {
        /// Ray from the vertex.
        ray: Ray,
        /// Random numbers.
        u: Vec2,
        /// Phase function or cosine lobe.
        value: f32,
        /// Density of the direction, per steradian.
        density: f32,
    },
    /// The path leaves a surface whose lobes depend on the component.
    Boundary {
        /// Ray from the vertex.
        ray: Ray,
        /// Random numbers.
        u: Vec2,
        /// Value of the lobe at every component.
        value: Lanes,
        /// Density of the direction at every component.
        density: Lanes,
        /// Whether the lobe is smooth, so that no connection has the direction.
        is_specular: bool,
    },
    /// Values and densities of a connection at every component, relative to those with which it started.
    Adjusted {
        /// Factor of f.
        value: Lanes,
        /// Factor of p_uni.
        density: Lanes,
    },
    /// A connection starts at the last vertex, or at a vertex drawn by equiangular sampling.
    Connect {
        /// Ray from the vertex.
        ray: Ray,
        /// Distance to the light.
        distance: f32,
        /// Phase function or cosine lobe.
        value: f32,
        /// Density with which the walk would have drawn the direction.
        walk_density: f32,
        /// Density with which the light was sampled.
        light_density: f32,
        /// Index of the light.
        light: usize,
    },
    /// The transmittance has been estimated by an estimator without a path density.
    Transmittance {
        /// Estimated transmittance.
        estimate: Lanes,
    },
    /// A connection has ended, with or without a contribution.
    Connected {
        /// Whether the contribution is not zero.
        arrives: bool,
    },
    /// A separate walk to find lights starts along the path's ray.
    LightWalk,
    /// The separate walk has ended.
    LightWalkEnds,
    /// A vertex is being drawn by equiangular sampling along the path's ray.
    EquiangularVertex,
    /// The equiangular vertex has been sampled.
    EquiangularVertexSampled {
        /// The collision there.
        found: CollisionRecord,
        /// Density of its distance, including the probability of the light.
        density: f32,
        /// Probability that a connection from there selects the light.
        choice: f32,
        /// Path weights after it.
        weight_record: WeightRecord,
    },
    /// The equiangular vertex and its connection have ended.
    EquiangularVertexEnds,
    /// A contribution is added to the estimate.
    Contribution {
        /// Technique that made the path.
        technique: Technique,
        /// Emitted radiance; on grey paths in linear sRGB of the film.
        emitted: Lanes,
        /// Density with which the other technique would have sampled the light; zero if there is none.
        other_density: f32,
        /// The contribution, per component, in the same space.
        value: Lanes,
        /// The contribution as linear sRGB on the film.
        film: Vec3,
    },
    /// The path has ended, with this estimate.
    End {
        /// Sum of all contributions, in the order in which they were added.
        sum: Lanes,
        /// The estimate as linear sRGB on the film.
        film: Vec3,
    },
}

/// Observer of a path while it is traced.
pub trait Observer {
    /// Receives a step of the path.
    fn note(&mut self, note: &Note);
}

/// Cancellation token and optional observer of one path.
pub struct PathContext<'a> {
    pub(super) cancel: CancelToken<'a>,
    pub(super) observer: Option<&'a mut dyn Observer>,
}

impl fmt::Debug for PathContext<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("PathContext").field("observed", &self.observer.is_some()).finish_non_exhaustive()
    }
}

impl<'a> PathContext<'a> {
    /// Creates the context of an observed path.
    pub fn observed(cancel: CancelToken<'a>, observer: &'a mut dyn Observer) -> Self {
        Self { cancel, observer: Some(observer) }
    }

    /// Reports a step to the observer, if there is one. Move the captured values into the closure: borrowed
    /// values have to be kept in memory, even without an observer.
    #[inline(always)]
    pub(super) fn notify(&mut self, note: impl FnOnce() -> Note) {
        if let Some(observer) = &mut self.observer {
            notify_cold(*observer, note);
        }
    }
}

/// Kept out of line, so that paths without an observer do not pay for it.
#[cold]
#[inline(never)]
fn notify_cold(observer: &mut dyn Observer, note: impl FnOnce() -> Note) {
    observer.note(&note());
}

impl<'a> From<CancelToken<'a>> for PathContext<'a> {
    fn from(cancel: CancelToken<'a>) -> Self {
        Self { cancel, observer: None }
    }
}
