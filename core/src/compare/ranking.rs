//! Ranking of the views: cost, noise, error, speed-up with its interval, and bias.

use super::agreement::{Agreement, Verdict, agreement};
use super::estimate::{Estimate, RegionNoise};
use super::fitness::unfit_picture;
use super::reference::Reference;
use crate::estimator;
use crate::film::Snapshot;
use crate::math::SamplerKind;
use crate::measure::{self, Measure, Measured, Region};
use crate::scene::SceneDoc;
use std::borrow::Cow;

/// A view in a ranking.
#[derive(Clone, Copy, Debug)]
pub struct RankedView<'a> {
    /// A, B, C, …
    pub label: &'a str,
    /// Document that it renders.
    pub doc: &'a SceneDoc,
    /// Newest image.
    pub snapshot: &'a Snapshot,
}

impl RankedView<'_> {
    /// Display name of the estimator.
    #[must_use]
    pub fn name(&self) -> &str {
        estimator::find(&self.doc.estimator.id).map_or(self.doc.estimator.id.as_str(), |e| e.name)
    }

    /// Reason why its estimate is biased, if a setting of its document biases it.
    #[must_use]
    pub fn declared_bias(&self) -> Option<&'static str> {
        estimator::find(&self.doc.estimator.id).and_then(|e| e.bias(self.doc))
    }

    /// Reason why its image cannot serve as a reference, if so: a reference has to be unbiased with known
    /// noise.
    #[must_use]
    pub fn unfit_as_reference(&self) -> Option<&'static str> {
        unfit_picture(self.doc, self.snapshot)
    }

    /// Whether two views can be compared: they show the same image with different random numbers.
    fn is_comparable(&self, other: &Self) -> bool {
        self.snapshot.target == other.snapshot.target
            && self.doc.render.seed != other.doc.render.seed
            && (self.snapshot.width, self.snapshot.height) == (other.snapshot.width, other.snapshot.height)
    }
}

/// Parameters of a ranking.
#[derive(Clone, Debug)]
pub struct Question<'a> {
    /// Reference for errors; `None`: for each view the mean of the other unbiased views.
    pub reference: Option<&'a Reference>,
    /// View whose image is the reference, if one was promoted.
    pub reference_view: Option<usize>,
    /// View to which speed-ups are relative.
    pub baseline: usize,
    /// Region of pixels; `None`: the whole image.
    pub region: Option<Region>,
    /// Error measures to compute.
    pub measures: Vec<&'static Measure>,
}

/// Comparison image of a view.
#[derive(Clone, Debug, PartialEq)]
pub enum ComparedWith {
    /// The reference, by its origin.
    Reference(String),
    /// The mean of the other unbiased views, by their labels.
    Others(String),
    /// No comparison image, with the reason.
    Nothing(&'static str),
}

/// One line of the ranking.
#[derive(Clone, Debug)]
pub struct Standing {
    /// A, B, C, …
    pub label: String,
    /// Estimator id.
    pub estimator: String,
    /// Display name of the estimator.
    pub name: String,
    /// Samples per pixel.
    pub spp: u64,
    /// CPU seconds of path tracing.
    pub cpu_seconds: f64,
    /// Wall-clock seconds of rendering.
    pub seconds: f64,
    /// Look-ups of the medium.
    pub lookups: u64,
    /// Look-ups per path.
    pub lookups_per_path: f64,
    /// Errors by measure, in the order of the question.
    pub errors: Vec<(&'static Measure, Measured)>,
    /// Variance of the mean of a pixel, averaged over pixels and channels.
    pub variance: f64,
    /// Standard error of `variance`.
    pub variance_error: f64,
    /// Component of `variance` that is colour noise.
    pub chroma_variance: f64,
    /// 1 / (variance · CPU seconds).
    pub efficiency: f64,
    /// Efficiency relative to the baseline.
    pub speedup: f64,
    /// 95 % interval of `speedup`.
    pub speedup_interval: [f64; 2],
    /// Image that it was compared with.
    pub against: ComparedWith,
    /// Result of that comparison.
    pub agreement: Option<Agreement>,
    /// Reason why its document biases it, if so.
    pub declared_bias: Option<&'static str>,
    /// Whether its samples are stratified over a pixel. The errors of its means are then smaller than their
    /// scatter, and so are the differences that a verdict can detect.
    pub evenly_spread: bool,
    /// Pixels in the region.
    pub pixels: u64,
    /// Pixels without a finite value.
    pub excluded: u64,
}

impl Standing {
    /// The verdict; undecided without a comparison.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        self.agreement.map_or(Verdict::Undecided, |a| a.verdict)
    }

    /// Error by the id of its measure.
    #[must_use]
    pub fn error(&self, id: &str) -> Option<&Measured> {
        self.errors.iter().find(|(m, _)| m.id == id).map(|(_, measured)| measured)
    }
}

/// Two-sided 95 % quantile of the normal distribution.
const INTERVAL: f64 = 1.959_964;

/// A comparison image with its description.
pub type Comparison<'a> = (ComparedWith, Option<Cow<'a, Reference>>);

/// Comparison images of all views.
#[must_use]
pub fn comparisons<'a>(ranked_views: &[RankedView<'_>], question: &Question<'a>) -> Vec<Comparison<'a>> {
    (0..ranked_views.len()).map(|i| comparison(ranked_views, i, question)).collect()
}

/// Ranks the views by comparison with their opponents. Views with fewer than three samples per pixel have no
/// statistics yet and are omitted.
#[must_use]
pub fn rank(
    ranked_views: &[RankedView<'_>],
    question: &Question<'_>,
    comparisons: &[Comparison<'_>],
) -> Vec<Standing> {
    let baseline = ranked_views.get(question.baseline);
    let baseline = baseline.and_then(|b| Some((efficiency(b, question.region)?, b.snapshot.target.as_str())));
    let views = ranked_views.iter().zip(comparisons).enumerate();
    // Errors can be measured against a biased view, but it gives no verdict.
    let promoted = question.reference_view.and_then(|v| ranked_views.get(v));
    let judged = promoted.is_none_or(|view| view.unfit_as_reference().is_none());
    let standings = views.filter_map(|(i, (view, held))| standing(view, i, held, question, baseline));
    standings.map(|s| Standing { agreement: s.agreement.filter(|_| judged), ..s }).collect()
}

/// Region of a question, clipped to an image.
fn region_of(region: Option<Region>, snapshot: &Snapshot) -> Region {
    let whole = Region::whole(snapshot.width, snapshot.height);
    region.map_or(whole, |r| r.clipped(snapshot.width, snapshot.height))
}

/// 1 / (variance · CPU seconds) with its relative standard error.
#[derive(Clone, Copy, Debug)]
struct Efficiency {
    value: f64,
    relative_error: f64,
}

fn efficiency(view: &RankedView<'_>, region: Option<Region>) -> Option<Efficiency> {
    let noise = RegionNoise::of(&Estimate::of(view.snapshot)?, region_of(region, view.snapshot), |_| true);
    let (variance, error) = noise.pixel_variance();
    let value = 1.0 / (variance * view.snapshot.cpu_seconds);
    Some(Efficiency { value, relative_error: (error / variance).hypot(view.snapshot.cost_error) })
}

fn standing(
    view: &RankedView<'_>,
    index: usize,
    comparison: &Comparison<'_>,
    question: &Question<'_>,
    baseline: Option<(Efficiency, &str)>,
) -> Option<Standing> {
    let snapshot = view.snapshot;
    let (against, held) = comparison;
    let estimate = Estimate::of(snapshot)?;
    let region = region_of(question.region, snapshot);
    let noise = RegionNoise::of(&estimate, region, |_| true);
    let (variance, variance_error) = noise.pixel_variance();
    let mine = efficiency(view, question.region)?;
    let (speedup, speedup_interval) = match baseline {
        Some(_) if index == question.baseline => (1.0, [1.0, 1.0]),
        // A speed-up is defined only for the same image.
        Some((_, target)) if target != snapshot.target => (f64::NAN, [f64::NAN; 2]),
        Some((base, _)) => {
            let ratio = mine.value / base.value;
            let factor = (INTERVAL * mine.relative_error.hypot(base.relative_error)).exp();
            (ratio, [ratio / factor, ratio * factor])
        }
        None => (f64::NAN, [f64::NAN; 2]),
    };
    let agreement = held.as_ref().and_then(|r| agreement(&estimate, &r.estimate(), region));
    let usable = !question.measures.is_empty() && can_measure(snapshot, comparison, question.region);
    let held = held.as_ref().filter(|_| usable);
    let errors = held.map(|r| errors(&estimate, r, region, &question.measures)).unwrap_or_default();
    let pixels = ((region.x1 - region.x0) * (region.y1 - region.y0)) as u64;
    Some(Standing {
        label: view.label.to_owned(),
        estimator: view.doc.estimator.id.clone(),
        name: view.name().to_owned(),
        spp: snapshot.spp,
        cpu_seconds: snapshot.cpu_seconds,
        seconds: snapshot.seconds,
        lookups: snapshot.tally.lookups,
        lookups_per_path: snapshot.tally.lookups as f64 / snapshot.tally.paths.max(1) as f64,
        errors,
        variance,
        variance_error,
        chroma_variance: noise.pixel_chroma_variance(),
        efficiency: mine.value,
        speedup,
        speedup_interval,
        against: against.clone(),
        agreement,
        declared_bias: view.declared_bias(),
        evenly_spread: view.doc.estimator.sampler != SamplerKind::Independent,
        pixels,
        excluded: pixels - noise.pixels,
    })
}

/// Largest relative standard error at which the noise of the other views counts as known.
const KNOWN: f64 = 0.25;
/// Largest ratio of the variance of the mean of the other views to that of the view.
const WORSE: f64 = 2.0;

/// Whether the errors of a view can be measured against its opponent. This always holds for a reference,
/// whose noise is stated beside every error. The mean of the other views has to have known noise, of about
/// the same level as the view's: an error against a much noisier image would be the noise of that image.
#[must_use]
pub fn can_measure(view: &Snapshot, (against, held): &Comparison<'_>, region: Option<Region>) -> bool {
    let (Some(held), Some(estimate)) = (held, Estimate::of(view)) else { return false };
    if !matches!(against, ComparedWith::Others(_)) {
        return true;
    }
    let region = region_of(region, view);
    let noise = |estimate: &Estimate<'_>| RegionNoise::of(estimate, region, |_| true).pixel_variance();
    let ((mine, _), (theirs, error)) = (noise(&estimate), noise(&held.estimate()));
    theirs > 0.0 && theirs <= WORSE * mine && error <= KNOWN * theirs
}

fn errors(
    estimate: &Estimate<'_>,
    reference: &Reference,
    region: Region,
    measures: &[&'static Measure],
) -> Vec<(&'static Measure, Measured)> {
    let held = measure::ReferencePicture {
        picture: reference.estimate().picture,
        standard_error: reference.standard_error(),
    };
    let measured = measures.iter().map(|m| (*m, (m.measure)(&estimate.picture, &held, region)));
    measured.filter_map(|(m, result)| Some((m, result.ok()?))).collect()
}

/// Comparison image of a view, with its description.
pub(super) fn comparison<'a>(
    ranked_views: &[RankedView<'_>],
    index: usize,
    question: &Question<'a>,
) -> Comparison<'a> {
    let Some(view) = ranked_views.get(index) else {
        return (ComparedWith::Nothing("the view does not exist"), None);
    };
    if question.reference_view == Some(index) {
        return (ComparedWith::Nothing("it is the reference"), None);
    }
    if let Some(reference) = question.reference {
        let promoted = question.reference_view.and_then(|v| ranked_views.get(v));
        if promoted.is_some_and(|p| p.doc.render.seed == view.doc.render.seed) {
            return (ComparedWith::Nothing("it has the seed of the reference: choose another seed"), None);
        }
        if reference.seed == Some(view.doc.render.seed) {
            return (ComparedWith::Nothing("it has the seed of the reference: choose another seed"), None);
        }
        if reference.fits(&view.snapshot.target) {
            return (ComparedWith::Reference(reference.origin.clone()), Some(Cow::Borrowed(reference)));
        }
        return (ComparedWith::Nothing("the reference shows a different image"), None);
    }
    let others: Vec<&RankedView<'_>> = ranked_views
        .iter()
        .enumerate()
        .filter(|(j, other)| *j != index && other.unfit_as_reference().is_none() && view.is_comparable(other))
        .map(|(_, other)| other)
        .filter(|other| Estimate::of(other.snapshot).is_some())
        .collect();
    let mut seeds = Vec::new();
    let others: Vec<&RankedView<'_>> = others
        .into_iter()
        // Images with equal random numbers carry no more information than one of them.
        .filter(|other| {
            let fresh = !seeds.contains(&other.doc.render.seed);
            seeds.push(other.doc.render.seed);
            fresh
        })
        .collect();
    let labels = others.iter().map(|o| o.label).collect::<Vec<_>>().join(", ");
    let snapshots: Vec<&Snapshot> = others.iter().map(|o| o.snapshot).collect();
    match Reference::pooled(&snapshots, labels.clone()) {
        Some(pooled) => (ComparedWith::Others(labels), Some(Cow::Owned(pooled))),
        None => {
            (ComparedWith::Nothing("no other unbiased view shows the same image with its own seed"), None)
        }
    }
}
