//! Estimators of light transport, one file each. A line in [`REGISTRY`] adds one: pickers, the
//! command line, the self-check and the tests iterate it.

mod axis;
mod dispatch;
mod equiangular_mis;
mod independent;
mod mitsuba2_volpath;
mod nee;
mod spectral_mis;
mod spectral_tracking;
mod uni_nee_mis;

pub use axis::{Axis, AxisSet};
pub use dispatch::{Kernel, PathEstimate, PathIndex, Settings};

use crate::math::Ray;
use crate::medium::LocalMedium;
use crate::scene::{
    self, Bookkeeping, DensityDoc, Heuristic, Heuristics, Problem, ReferenceDoc, SceneDoc, WhenExceeded,
};
use crate::spectrum::Components;
use crate::transmittance::TransmittanceKind;
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
    /// Choices that change its estimate; every other axis leaves its image as it is, bit by bit.
    pub uses: &'static [Axis],
    /// Why the variance of its estimate has no bound, if so: its mean is right, and no number of samples shows it.
    pub infinite_variance: fn(&SceneDoc) -> Option<&'static str>,
    /// Why its estimate of a document's image is biased, if it is.
    pub bias_of: fn(&SceneDoc) -> Option<&'static str>,
    /// Traces one path.
    pub kernel: Kernel,
}

impl Entry {
    /// Whether a choice changes its estimate.
    #[must_use]
    pub fn uses(&self, axis: Axis) -> bool {
        self.uses.contains(&axis)
    }

    /// Why a choice changes nothing about it, if it does not.
    #[must_use]
    pub fn unused(&self, axis: Axis) -> Option<&'static str> {
        (!self.uses(axis)).then(|| axis.why_unused())
    }

    /// Whether it connects vertices to lights.
    #[must_use]
    pub fn connects(&self) -> bool {
        self.uses(Axis::Lights)
    }

    /// Whether its paths carry several components that share them by a heuristic.
    #[must_use]
    pub fn carries_family(&self) -> bool {
        self.uses(Axis::Components)
    }

    /// Whether its hero alone draws the events, from the hero's own majorant.
    #[must_use]
    pub fn hero_draws(&self) -> bool {
        !self.uses(Axis::Tracking)
    }

    /// Why the estimate of a document's image is biased: by a choice in the document, or because the
    /// estimator is. `None` means that its expectation is the true image.
    #[must_use]
    pub fn bias(&self, doc: &SceneDoc) -> Option<&'static str> {
        (self.bias_of)(doc)
    }
}

/// What biases every estimator that samples free flights by a majorant: cutting the medium off at it.
fn clamped_majorant(doc: &SceneDoc) -> Option<&'static str> {
    let majorant = &doc.medium.majorant;
    match majorant.when_exceeded {
        WhenExceeded::Clamp if majorant.factor < 1.0 => Some("the majorant is clamped"),
        WhenExceeded::Progressive if majorant.factor < 1.0 => {
            Some("the majorant is clamped until it has been raised: the error vanishes with more samples")
        }
        _ => None,
    }
}

/// Whether extinction and albedo are the same everywhere in the medium.
fn is_uniform(doc: &SceneDoc) -> bool {
    matches!(doc.medium.density, DensityDoc::Uniform {}) && doc.medium.albedo_grid.is_none()
}

/// What biases estimators whose connections may be estimated in any way. Along constant extinction a march is exact.
fn biased_transmittance(doc: &SceneDoc) -> Option<&'static str> {
    if is_uniform(doc) {
        return None;
    }
    let kind = TransmittanceKind::find(&doc.estimator.transmittance);
    kind.is_some_and(|kind| !kind.entry().unbiased)
        .then_some("transmittance is marched by steps of fixed length")
}

/// Every estimator, in the order that pickers show.
pub static REGISTRY: &[Entry] = &[
    independent::ENTRY,
    spectral_mis::ENTRY,
    nee::ENTRY,
    uni_nee_mis::ENTRY,
    equiangular_mis::ENTRY,
    spectral_tracking::ENTRY,
    mitsuba2_volpath::ENTRY,
];

/// The estimator with this id.
#[must_use]
pub fn find(id: &str) -> Option<&'static Entry> {
    REGISTRY.iter().find(|e| e.id == id)
}

/// Every problem of a document: those of its scene, and an estimator that does not exist.
#[must_use]
pub fn validate(doc: &SceneDoc) -> Vec<Problem> {
    let mut problems = scene::validate(doc);
    let mut named = vec![("estimator.id".to_owned(), &doc.estimator.id)];
    for (i, view) in doc.compare.views.iter().enumerate() {
        named.push((format!("compare.views[{i}].estimator.id"), &view.estimator.id));
    }
    if let ReferenceDoc::Render { estimator, .. } = &doc.compare.reference {
        named.push(("compare.reference.estimator".to_owned(), estimator));
    }
    let views = doc.compare.views.iter().enumerate();
    let views = views.map(|(i, view)| (format!("compare.views[{i}].estimator"), &view.estimator));
    for (path, estimator) in [("estimator".to_owned(), &doc.estimator)].into_iter().chain(views) {
        let problem =
            |key: &str, message: &str| Problem { path: format!("{path}.{key}"), message: message.into() };
        if estimator.heuristics.techniques == Heuristic::HeroOnly {
            let why = "techniques cannot go without a heuristic: choose balance, power or maximum";
            problems.push(problem("heuristics.techniques", why));
        }
        if TransmittanceKind::find(&estimator.transmittance).is_none() {
            let known: Vec<_> = TransmittanceKind::all().iter().map(|kind| kind.entry().id).collect();
            let why = format!(
                "`{}` estimates no transmittance: choose {}",
                estimator.transmittance,
                known.join(", ")
            );
            problems.push(problem("transmittance", &why));
        }
        if estimator.bookkeeping == Bookkeeping::Pairwise && estimator.heuristics != Heuristics::default() {
            let why =
                "of quotients of pairs only the balance heuristic can be formed: choose rescaled, or balance";
            problems.push(problem("bookkeeping", why));
        }
    }
    for (path, id) in named.into_iter().filter(|(_, id)| find(id).is_none()) {
        let known: Vec<_> = REGISTRY.iter().map(|e| e.id).collect();
        let message = format!("`{id}` is not an estimator: choose {}", known.join(", "));
        problems.push(Problem { path, message });
    }
    problems
}

/// The contract of an estimator: radiance that arrives along a ray, at the path's components.
///
/// Its expectation, given that component j is carried at all, is the radiance at component j.
pub trait Estimator {
    /// The axes that change its estimate. All others are put to their defaults before a path begins.
    const USES: &'static [Axis];
    /// Whether flights are drawn from one majorant for all components, that of the largest.
    const SHARED_MAJORANT: bool = false;

    /// Traces one path.
    fn estimate<L: LocalMedium<N>, C: Components<N>, const N: usize>(
        world: &World<'_, L, C, N>,
        ray: Ray,
        trace: &mut Trace<'_>,
    ) -> C::Radiance;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{DensityDoc, GridRef};

    #[test]
    fn a_bias_is_named_where_there_is_one_and_nowhere_else() {
        let with = |factor: f32, when_exceeded: WhenExceeded| {
            let mut doc = SceneDoc::default();
            doc.medium.majorant.factor = factor;
            doc.medium.majorant.when_exceeded = when_exceeded;
            doc
        };
        for entry in REGISTRY {
            // A uniform medium has closed forms in the older baseline, which then asks for no majorant.
            let uses_majorant = entry.id != "mitsuba2-volpath";
            let clamped = entry.bias(&with(0.5, WhenExceeded::Clamp));
            assert_eq!(clamped.is_some_and(|why| why.contains("clamped")), uses_majorant, "{clamped:?}");
            // A majorant that bounds is never exceeded.
            assert_eq!(entry.bias(&with(1.0, WhenExceeded::Clamp)), None);
            assert_eq!(entry.bias(&with(0.5, WhenExceeded::Weighted)), None);
            // Delta tracking has no weights to make up for it.
            let mut grid = with(0.5, WhenExceeded::Weighted);
            grid.medium.density = DensityDoc::Grid(GridRef { file: "embedded:cloud.vdb".into(), grid: None });
            assert_eq!(entry.bias(&grid).is_some(), entry.id == "mitsuba2-volpath");
            let mut marched = grid.clone();
            marched.medium.majorant.factor = 1.0;
            marched.estimator.transmittance = "marching".into();
            assert_eq!(entry.bias(&marched).is_some(), entry.uses(Axis::Transmittance), "{}", entry.id);
            marched.medium.density = DensityDoc::Uniform {};
            assert_eq!(
                entry.bias(&marched),
                None,
                "{}: a march through constant extinction is exact",
                entry.id
            );
        }
    }

    #[test]
    fn estimators_are_found_by_their_ids_and_no_others() {
        for entry in REGISTRY {
            assert_eq!(find(entry.id).map(|e| e.name), Some(entry.name));
            let mut doc = SceneDoc::default();
            doc.estimator.id = entry.id.to_owned();
            assert_eq!(validate(&doc), []);
        }
        let mut doc = SceneDoc::default();
        doc.estimator.id = "magic".into();
        doc.medium.scale = -1.0;
        let paths: Vec<_> = validate(&doc).into_iter().map(|p| p.path).collect();
        assert_eq!(paths, ["medium.scale", "estimator.id"]);
    }
}
