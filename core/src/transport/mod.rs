//! Algebra shared by the estimators, on the null-scattering path integral of Miller, Georgiev and
//! Jarosz 2019: the walk through majorant segments, event probabilities, path weights, connections.
//!
//! Each of these is defined here once; an estimator's file combines them and contains the whole path loop.

mod bookkeeping;
mod boundary;
mod cancel_token;
mod connection;
mod direction;
mod divided;
mod equiangular;
mod event;
mod event_densities;
mod fly_to_event;
mod heuristic;
mod observer;
mod vertex;
mod walk;
mod weights;
mod weights_apart;
mod weights_equiangular;
mod weights_faulty;
mod weights_pairwise;
mod world;

pub use bookkeeping::{ApartF32, ApartF64, Faulty, Pairwise, Rescaled, WalkWeights, WeightForm, Weights};
pub use boundary::Towards;
pub use cancel_token::CancelToken;
pub use connection::{Aim, Connection};
pub use direction::{DirectionSample, DirectionSampler, Guide};
pub use divided::Flight;
pub use equiangular::{Passage, Reached};
pub use event::{Collision, Event, EventRule};
pub use event_densities::EventDensities;
pub use fly_to_event::{FlightEnd, hero_event};
pub use observer::{CollisionRecord, Note, Observer, PathContext, Technique, WeightRecord};
pub use vertex::{Boundary, ScatteringPoint, Vertex};
pub use walk::{Part, Place, Walk};
pub use weights::PathWeights;
pub use weights_apart::WeightsApart;
pub use weights_equiangular::{EquiangularWeights, LightDensities};
pub use weights_faulty::FaultyWeights;
pub use weights_pairwise::WeightsPairwise;
pub use world::{Arrival, PathSettings, Trace, World};
