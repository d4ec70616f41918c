//! What a path tells of itself while it is traced.
//!
//! A [`Trace`](super::Trace) may carry an [`Observer`]. The same kernel then traces the same path with the same random
//! numbers, and tells every step as a [`Note`]; without one a step costs a test of an empty option. Paths are
//! replayed, taken apart by technique, and explained through this alone.

use super::{CancelToken, Event};
use crate::math::Ray;
use crate::spectrum::{Carried, Lanes, Sampled};
use glam::{Vec2, Vec3};
use std::fmt;

/// What has made a path that carries light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Technique {
    /// The walk, which has met a light.
    Walk,
    /// A connection from a vertex to a light.
    Connection,
    /// A vertex drawn by the angle under which a light sees it, and its connection.
    Equiangular,
    /// The walk, which has collided where the medium glows.
    Emission,
}

impl Technique {
    /// All, in the order of tables.
    pub const ALL: [Self; 4] = [Self::Walk, Self::Connection, Self::Equiangular, Self::Emission];

    /// Name for people.
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

/// A tentative collision, as it was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CollisionRecord {
    /// Where, in world space.
    pub point: Vec3,
    /// Optical depth by the majorants since the last note of the walk, per component.
    pub passed: Lanes,
    /// μa there.
    pub absorption: Lanes,
    /// μs there.
    pub scattering: Lanes,
    /// μn there, negative where the majorant is exceeded.
    pub null: Lanes,
    /// μ̄ there.
    pub majorant: Lanes,
    /// Density of a tentative collision with this part of the medium: μ̄ of all of it.
    pub tentative: Lanes,
    /// Density of taking it as null.
    pub null_density: Lanes,
    /// Density of taking it as scattering.
    pub scattering_density: Lanes,
}

/// The three numbers per component that an estimator keeps of a path, under the names that it has for them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeightRecord {
    /// For instance `f/P`, `p_uni/P`, `p_nee/P`.
    pub names: [&'static str; 3],
    /// Their values.
    pub values: [Lanes; 3],
}

impl WeightRecord {
    /// Of an estimator that keeps one number: throughput over density.
    #[must_use]
    pub fn throughput<const N: usize>(phi: Sampled<N>) -> Self {
        Self { names: ["φ", "", ""], values: [phi.lanes(), [0.0; 4], [0.0; 4]] }
    }
}

/// One step of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Note {
    /// It leaves the camera.
    Camera {
        /// Into the scene.
        ray: Ray,
        /// The random numbers of the place within the pixel.
        jitter: Vec2,
        /// The random number of the components.
        u: f32,
        /// What the components are.
        carried: Carried,
    },
    /// A walk, or a connection, has found a tentative collision; what is kept is that before its outcome.
    Collision(CollisionRecord, WeightRecord),
    /// A walk, or a connection, has left the medium after this optical depth.
    Exit {
        /// By the majorants, per component.
        passed: Lanes,
        /// What is kept of the path after it.
        kept: WeightRecord,
    },
    /// What is kept of the path after the last event of the walk or connection at hand, where the event could not tell
    /// it itself.
    Weights(WeightRecord),
    /// What a walk has drawn at its last collision.
    Drawn {
        /// The outcome.
        event: Event,
        /// The random number of it.
        u: f32,
    },
    /// The density by which f and the densities were divided, where events are drawn for all components at once.
    DrawnForAll {
        /// The outcome.
        event: Event,
        /// The random number, between 0 and 1.
        u: f32,
        /// The density of the outcome.
        density: f32,
    },
    /// A flight of which only its weight is known: what is left of the path's worth, over its density.
    Flight {
        /// Where it scatters, if it does.
        scattered_at: Option<Vec3>,
        /// By what the path is multiplied.
        weight: Lanes,
    },
    /// The path is reflected by a surface.
    Surface {
        /// Where.
        point: Vec3,
        /// Its albedo.
        albedo: Lanes,
    },
    /// The path has its next real vertex, and is worth this.
    Vertex(WeightRecord),
    /// It survives roulette with probability `q`, or ends.
    Roulette {
        /// The random number.
        u: f32,
        /// The probability.
        q: f32,
    },
    /// It leaves its vertex in a new direction.
    Leave {
        /// From the vertex.
        ray: Ray,
        /// The random numbers.
        u: Vec2,
        /// Phase function or cosine lobe.
        value: f32,
        /// The density of the direction, per steradian.
        density: f32,
    },
    /// A connection sets out from the last vertex, or from a vertex drawn by angle.
    Connect {
        /// From the vertex.
        ray: Ray,
        /// To the light.
        distance: f32,
        /// Phase function or cosine lobe.
        value: f32,
        /// The density with which the walk would have gone there.
        walk_density: f32,
        /// The density with which the light was sampled.
        light_density: f32,
        /// Which light.
        light: usize,
    },
    /// A transmittance that was estimated by something without a density.
    Transmittance {
        /// The estimate.
        estimate: Lanes,
    },
    /// A connection has ended, at its light or in the dark.
    Connected {
        /// Whether anything has arrived.
        arrives: bool,
    },
    /// A walk of its own sets out along the path's ray, to meet light for it.
    LightWalk,
    /// That has ended.
    LightWalkEnds,
    /// A vertex is being drawn by angle along the path's ray.
    EquiangularVertex,
    /// That vertex has been drawn.
    VertexByAngle {
        /// The collision there.
        found: CollisionRecord,
        /// The density of its distance, the choice of the light included.
        density: f32,
        /// The probability with which a connection from there chooses the light.
        choice: f32,
        /// What is kept of the path after it.
        kept: WeightRecord,
    },
    /// That vertex and its connection have ended.
    EquiangularVertexEnds,
    /// Light is added to the estimate.
    Credit {
        /// By what it was found.
        technique: Technique,
        /// Emitted radiance; on grey paths in the colours of the film.
        emitted: Lanes,
        /// The density with which the other technique would have sampled the light; zero if there is none.
        other_density: f32,
        /// What is added, component by component, in the same space.
        value: Lanes,
        /// The same as linear sRGB on the film.
        film: Vec3,
    },
    /// The path has ended: its estimate, as the film receives it.
    End {
        /// The sum of all that was added, in the order in which it was.
        sum: Lanes,
        /// Linear sRGB.
        film: Vec3,
    },
}

/// Somebody who looks on while a path is traced.
pub trait Observer {
    /// Takes note of a step.
    fn note(&mut self, note: &Note);
}

/// Who accompanies a path: somebody who may call it off, and perhaps somebody who looks on.
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
    /// A path that is observed.
    pub fn observed(cancel: CancelToken<'a>, observer: &'a mut dyn Observer) -> Self {
        Self { cancel, observer: Some(observer) }
    }

    /// Tells a step, if anybody looks on. What the closure knows should be moved into it: what is borrowed has to lie in
    /// memory, also where nobody looks on.
    #[inline(always)]
    pub(super) fn tell(&mut self, note: impl FnOnce() -> Note) {
        if let Some(observer) = &mut self.observer {
            told(*observer, note);
        }
    }
}

/// Apart from the path, so that it does not stand in the way of those that nobody observes.
#[cold]
#[inline(never)]
fn told(observer: &mut dyn Observer, note: impl FnOnce() -> Note) {
    observer.note(&note());
}

impl<'a> From<CancelToken<'a>> for PathContext<'a> {
    fn from(cancel: CancelToken<'a>) -> Self {
        Self { cancel, observer: None }
    }
}
