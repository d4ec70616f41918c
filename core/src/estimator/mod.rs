//! Estimators of light transport, one file each.
//!
//! A line in [`REGISTRY`] adds one: pickers, the command line, the self-check and the tests iterate over it.

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
use crate::medium::LocalMedia;
use crate::scene::{
    self, Bookkeeping, Heuristic, Heuristics, Problem, ReferenceDoc, SceneDoc, ShapeDoc, WhenExceeded, Within,
};
use crate::spectrum::Components;
use crate::transmittance::TransmittanceKind;
use crate::transport::{Trace, World};

/// Registry entry of an estimator.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Stable id, for files and the command line.
    pub id: &'static str,
    /// Display name.
    pub name: &'static str,
    /// One sentence on the method and when it wins.
    pub summary: &'static str,
    /// Source in the literature.
    pub reference: &'static str,
    /// Settings that change its estimate; every other axis leaves its image bitwise unchanged.
    pub uses: &'static [Axis],
    /// Reason why the variance of the estimate is infinite, if it is. The mean is then correct, but no number
    /// of samples shows it.
    pub infinite_variance: fn(&SceneDoc) -> Option<&'static str>,
    /// Reason why the estimate of a document's image is biased, if it is.
    pub bias_of: fn(&SceneDoc) -> Option<&'static str>,
    /// Function that traces one path.
    pub kernel: Kernel,
}

impl Entry {
    /// Whether a setting changes the estimate.
    #[must_use]
    pub fn uses(&self, axis: Axis) -> bool {
        self.uses.contains(&axis)
    }

    /// Reason why a setting has no effect on the estimator; `None` if it has one.
    #[must_use]
    pub fn unused(&self, axis: Axis) -> Option<&'static str> {
        (!self.uses(axis)).then(|| axis.reason_unused())
    }

    /// Whether the estimator connects vertices to lights.
    #[must_use]
    pub fn connects(&self) -> bool {
        self.uses(Axis::Lights)
    }

    /// Whether its paths carry several components, combined by a heuristic.
    #[must_use]
    pub fn carries_family(&self) -> bool {
        self.uses(Axis::Components)
    }

    /// Whether events are drawn from the hero's densities and majorant only.
    #[must_use]
    pub fn hero_draws(&self) -> bool {
        !self.uses(Axis::Tracking)
    }

    /// Reason why the estimate of a document's image is biased, by a setting in the document or by the
    /// estimator itself. `None` means that its expectation is the true image.
    #[must_use]
    pub fn bias(&self, doc: &SceneDoc) -> Option<&'static str> {
        (self.bias_of)(doc)
    }
}

/// Bias of all estimators that sample free flights from a majorant, due to clamping the extinction at it.
fn clamped_majorant(doc: &SceneDoc) -> Option<&'static str> {
    let exceeded = || doc.enabled_media().map(|medium| &medium.majorant).filter(|m| m.factor < 1.0);
    let is = |rule| exceeded().any(|majorant| majorant.when_exceeded == rule);
    if is(WhenExceeded::Clamp) {
        Some("the majorant is clamped")
    } else if is(WhenExceeded::Progressive) {
        Some("the majorant is clamped until it has been raised: the error vanishes with more samples")
    } else {
        None
    }
}

/// Whether there is a single medium, extinction and albedo are the same everywhere in it, and no ray enters it
/// more than once, as it may enter a mesh.
fn is_uniform(doc: &SceneDoc) -> bool {
    let mut media = doc.enabled_media();
    let (Some(medium), None) = (media.next(), media.next()) else { return false };
    let object = match &medium.within {
        Within::Object(name) => doc.object_named(name),
        Within::Grid | Within::Everywhere => None,
    };
    let in_mesh = object.is_some_and(|(_, object)| matches!(object.shape, ShapeDoc::Mesh { .. }));
    medium.is_uniform() && !in_mesh
}

/// Bias of estimators with selectable transmittance of connections. Along constant extinction marching is
/// exact.
fn biased_transmittance(doc: &SceneDoc) -> Option<&'static str> {
    if is_uniform(doc) {
        return None;
    }
    let kind = TransmittanceKind::find(&doc.estimator.transmittance);
    kind.is_some_and(|kind| !kind.entry().unbiased)
        .then_some("transmittance is estimated by ray marching with a fixed step")
}

/// All estimators, in the order shown by pickers.
pub static REGISTRY: &[Entry] = &[
    independent::ENTRY,
    spectral_mis::ENTRY,
    nee::ENTRY,
    uni_nee_mis::ENTRY,
    equiangular_mis::ENTRY,
    spectral_tracking::ENTRY,
    mitsuba2_volpath::ENTRY,
];

/// Finds the estimator with this id.
#[must_use]
pub fn find(id: &str) -> Option<&'static Entry> {
    REGISTRY.iter().find(|e| e.id == id)
}

/// Problems of a document: those of its scene and of its estimator settings, including unknown estimators.
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
            let why = "techniques need a heuristic: choose balance, power or maximum";
            problems.push(problem("heuristics.techniques", why));
        }
        if TransmittanceKind::find(&estimator.transmittance).is_none() {
            let known: Vec<_> = TransmittanceKind::all().iter().map(|kind| kind.entry().id).collect();
            let why = format!(
                "`{}` is not a transmittance estimator: choose {}",
                estimator.transmittance,
                known.join(", ")
            );
            problems.push(problem("transmittance", &why));
        }
        if estimator.bookkeeping == Bookkeeping::Pairwise && estimator.heuristics != Heuristics::default() {
            let why = "pairwise weights support the balance heuristic only: choose rescaled, or balance";
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

/// Estimator of the radiance that arrives along a ray, at the path's components.
///
/// Its expectation, given that component j is carried at all, is the radiance at component j.
pub trait Estimator {
    /// Axes that change the estimate. All others are set to their defaults before a path begins.
    const USES: &'static [Axis];
    /// Whether flights are drawn from one majorant for all components, the largest.
    const SHARED_MAJORANT: bool = false;

    /// Traces one path.
    fn estimate<M: LocalMedia<N>, C: Components<N>, const N: usize>(
        world: &World<'_, M, C, N>,
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
            doc.medium_mut().majorant.factor = factor;
            doc.medium_mut().majorant.when_exceeded = when_exceeded;
            doc
        };
        for entry in REGISTRY {
            // The older baseline uses closed forms in a uniform medium, and no majorant.
            let uses_majorant = entry.id != "mitsuba2-volpath";
            let clamped = entry.bias(&with(0.5, WhenExceeded::Clamp));
            assert_eq!(clamped.is_some_and(|why| why.contains("clamped")), uses_majorant, "{clamped:?}");
            // A bounding majorant is never exceeded.
            assert_eq!(entry.bias(&with(1.0, WhenExceeded::Clamp)), None);
            assert_eq!(entry.bias(&with(0.5, WhenExceeded::Weighted)), None);
            // Delta tracking has no weights to compensate.
            let mut grid = with(0.5, WhenExceeded::Weighted);
            grid.medium_mut().density =
                DensityDoc::Grid(GridRef { file: "embedded:cloud.vdb".into(), grid: None });
            assert_eq!(entry.bias(&grid).is_some(), entry.id == "mitsuba2-volpath");
            let mut marched = grid.clone();
            marched.medium_mut().majorant.factor = 1.0;
            marched.estimator.transmittance = "marching".into();
            assert_eq!(entry.bias(&marched).is_some(), entry.uses(Axis::Transmittance), "{}", entry.id);
            marched.medium_mut().density = DensityDoc::Uniform {};
            assert_eq!(
                entry.bias(&marched),
                None,
                "{}: marching through constant extinction is exact",
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
        doc.medium_mut().scale = -1.0;
        let paths: Vec<_> = validate(&doc).into_iter().map(|p| p.path).collect();
        assert_eq!(paths, ["medium.scale", "estimator.id"]);
    }
}
