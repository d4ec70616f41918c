//! Data of a report, computed once for all formats.

use crate::compare::curve::{Axis, Checkpoint, Point};
use crate::compare::maps::{MAPS, Map, Range};
use crate::compare::{ComparedWith, Estimate, Experiment, Reference, Standing, View};
use crate::measure::{self, MEASURES, Measure};
use std::borrow::Cow;
use std::sync::Arc;

/// A comparison with its statistics.
pub(super) struct Gathered<'a> {
    pub experiment: &'a Experiment,
    /// Standings with every measure, in the order of the views.
    pub standings: Vec<Standing>,
    /// Views that have a standing, in the same order.
    pub views: Vec<Shown<'a>>,
    /// Maps that some view has, each with the common range of all views.
    pub maps: Vec<(&'static Map, Range)>,
    /// Selected measure of the comparison.
    pub measure: &'static Measure,
}

/// A view with its maps and curves.
pub(super) struct Shown<'a> {
    pub view: &'a View,
    /// Name in files, e.g. `A-nee`.
    pub name: String,
    /// Maps that it has.
    pub maps: Vec<(&'static Map, Vec<f32>)>,
    /// Error curves by measure.
    pub curves: Vec<(&'static Measure, Vec<Point>)>,
}

impl<'a> Gathered<'a> {
    pub fn of(experiment: &'a Experiment) -> Self {
        let standings = experiment.rank(MEASURES.iter().collect());
        let ranked = |view: &View| standings.iter().any(|s| s.label == view.label);
        let views: Vec<Shown<'_>> = experiment
            .views
            .iter()
            .filter(|(_, view)| ranked(view))
            .map(|(number, view)| Shown::of(experiment, *number, view))
            .collect();
        let maps = MAPS.iter().filter_map(|map| Some((map, range(map, &views)?))).collect();
        let measure = measure::find(&experiment.doc.compare.measure.0).unwrap_or(&MEASURES[0]);
        Self { experiment, standings, views, maps, measure }
    }

    /// Reference shared by all views, if there is one.
    pub fn reference(&self) -> Option<&Reference> {
        self.experiment.reference.as_deref()
    }

    /// Display text for the image that the views were compared with.
    pub fn compared_with(&self) -> String {
        match (self.reference(), self.standings.iter().find(|s| !matches!(s.against, ComparedWith::Nothing(_)))) {
            (Some(reference), _) => reference.origin.clone(),
            (None, Some(_)) if self.experiment.has_errors() => {
                "for every view the mean of the other unbiased views, corrected for its noise".into()
            }
            (None, Some(_)) => {
                "for every view the mean of the other unbiased views; verdicts only, as errors need a reference".into()
            }
            (None, None) => "nothing".into(),
        }
    }
}

impl<'a> Shown<'a> {
    fn of(experiment: &Experiment, number: usize, view: &'a View) -> Self {
        let (_, comparison) = experiment.compared_with(number);
        let held: Option<Cow<'_, Reference>> = experiment.measured_against(number);
        let maps = Estimate::of(&view.snapshot).map(|estimate| {
            let [tested, measured] = [&comparison, &held].map(|r| r.as_ref().map(|r| r.estimate()));
            let reference = |map: &Map| if map.is_test() { tested.as_ref() } else { measured.as_ref() };
            let values = MAPS.iter().map(|map| (map, map.values(&estimate, reference(map))));
            values.filter(|(_, values)| values.iter().any(|v| v.is_finite())).collect()
        });
        // The last point of a curve equals the table, however near the last checkpoint is.
        let last = view.checkpoints.kept().last().is_none_or(|c| c.spp < view.snapshot.spp);
        let last = last.then(|| Arc::new(Checkpoint::of(&view.snapshot)));
        // FLIP evaluates the neighbourhood of every pixel at many exposures: once per view is enough, unless
        // it is the selected measure.
        let chosen = &experiment.doc.compare.measure.0;
        let followed = MEASURES.iter().filter(|m| m.id != "flip" || m.id == chosen);
        let curves = followed.map(|measure| {
            let kept = view.checkpoints.kept().iter().chain(&last);
            let points = held.as_ref().map(|held| {
                kept.filter_map(|c| c.point(measure, held, experiment.region())).collect::<Vec<_>>()
            });
            (measure, points.unwrap_or_default())
        });
        Self {
            view,
            name: format!("{}-{}", view.label, view.doc.estimator.id),
            maps: maps.unwrap_or_default(),
            curves: curves.collect(),
        }
    }

    /// Values of a map, if the view has it.
    pub fn map(&self, map: &Map) -> Option<&[f32]> {
        self.maps.iter().find(|(m, _)| m.id == map.id).map(|(_, values)| values.as_slice())
    }

    /// Error curve by a measure, restricted to points with positive coordinates.
    pub fn curve(&self, measure: &Measure, axis: Axis) -> Vec<Point> {
        let points = self.curves.iter().find(|(m, _)| m.id == measure.id).map(|(_, p)| p.as_slice());
        let drawable = |p: &&Point| p.value > 0.0 && p.value.is_finite() && p.at(axis) > 0.0;
        points.unwrap_or_default().iter().filter(drawable).copied().collect()
    }
}

/// Common range of a map over all views that have it.
fn range(map: &Map, views: &[Shown<'_>]) -> Option<Range> {
    let values: Vec<&[f32]> = views.iter().filter_map(|v| v.map(map)).collect();
    (!values.is_empty()).then(|| Range::of(map.scale, values.into_iter()))
}
