//! Paths taken apart: one replayed step by step with its books, many sorted by how they came about.
//!
//! Nothing here traces paths of its own: the estimator's kernel does, with the same random numbers as for the film, and
//! tells its steps to an [`Observer`](crate::transport::Observer).

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
pub use heaviest::{Heaviest, Heavy};
pub use ledger::{Credit, Ledger, Row};
pub use product::Product;
pub use ray_bench::{Along, BenchPlan, Look, RayBench};
pub use recording::Recording;
pub use step::{Branch, Step};
pub(crate) use strategies::scene_of;
pub use strategies::{Layer, Split, Strategies, StrategyPlan};
