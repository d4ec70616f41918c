//! Estimators of light transport, one file each. A line in [`REGISTRY`] adds one: pickers, the
//! command line and the tests iterate it.

mod dispatch;
mod independent;
mod nee;
mod spectral_mis;
mod uni_nee_mis;

pub use dispatch::{Kernel, PathEstimate, PathIndex, Settings};

use crate::math::Ray;
use crate::medium::LocalMedium;
use crate::scene::{self, Problem, SceneDoc};
use crate::spectrum::{Components, Sampled};
use crate::transport::{Trace, World};

/// One estimator as people meet it.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Stable id, for files and the command line.
    pub id: &'static str,
    /// Name for people.
    pub name: &'static str,
    /// One sentence: what it does and when it wins.
    pub summary: &'static str,
    /// Where it comes from.
    pub reference: &'static str,
    /// Traces one path.
    pub kernel: Kernel,
}

/// Every estimator, in the order that pickers show.
pub static REGISTRY: &[Entry] = &[independent::ENTRY, spectral_mis::ENTRY, nee::ENTRY, uni_nee_mis::ENTRY];

/// The estimator with this id.
#[must_use]
pub fn find(id: &str) -> Option<&'static Entry> {
    REGISTRY.iter().find(|e| e.id == id)
}

/// Every problem of a document: those of its scene, and an estimator that does not exist.
#[must_use]
pub fn validate(doc: &SceneDoc) -> Vec<Problem> {
    let mut problems = scene::validate(doc);
    if find(&doc.estimator.id).is_none() {
        let known: Vec<_> = REGISTRY.iter().map(|e| e.id).collect();
        problems.push(Problem {
            path: "estimator.id".into(),
            message: format!("`{}` is not an estimator: choose {}", doc.estimator.id, known.join(", ")),
        });
    }
    problems
}

/// The contract of an estimator: radiance that arrives along a ray, at the path's components.
///
/// Its expectation, given that component j is carried at all, is the radiance at component j.
pub trait Estimator {
    /// Traces one path.
    fn estimate<L: LocalMedium<N>, C: Components<N>, const N: usize>(
        world: &World<'_, L, C, N>,
        ray: Ray,
        trace: &mut Trace<'_>,
    ) -> Sampled<N>;
}
