//! Inspection of paths: a single path replayed step by step with its weights, and images separated into
//! contributions.
//!
//! No code here traces paths itself: the estimator's kernel does, with the same random numbers as for the
//! film, and reports its steps to an [`Observer`](crate::transport::Observer).

mod advice;
mod heaviest;
mod ledger;
mod path_densities;
mod product;
mod ray_bench;
mod recording;
mod step;
mod strategies;

pub use advice::{Advice, Evidence, Shares, advise};
pub use heaviest::{Heaviest, HeavySample};
pub use ledger::{Contribution, Ledger, Row};
pub use product::Product;
pub use ray_bench::{Along, BenchPlan, Look, RayBench};
pub use recording::Recording;
pub use step::{Branch, Step};
pub(crate) use strategies::scene_of;
pub use strategies::{Layer, Split, Strategies, StrategyPlan};
