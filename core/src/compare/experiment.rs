//! A comparison with its current images, the input of rankings, maps and reports.

use super::curve::{Checkpoints, Point};
use super::ranking::{self, ComparedWith, Comparison, Question, RankedView, Standing};
use super::reference::Reference;
use crate::film::Snapshot;
use crate::measure::{Measure, Region};
use crate::scene::{ReferenceDoc, SceneDoc};
use std::borrow::Cow;
use std::sync::Arc;

/// One view with its newest image.
#[derive(Clone, Debug)]
pub struct View {
    /// A, B, C, …
    pub label: String,
    /// Document that it renders, with the file names passed to the session.
    pub doc: Arc<SceneDoc>,
    /// Newest image.
    pub snapshot: Arc<Snapshot>,
    /// Earlier images.
    pub checkpoints: Arc<Checkpoints>,
}

/// A comparison with its current images.
#[derive(Clone, Debug)]
pub struct Experiment {
    /// The scene with its comparison.
    pub doc: Arc<SceneDoc>,
    /// Views that have an image, each with its index from 0.
    pub views: Vec<(usize, View)>,
    /// Reference for errors, if it has an image.
    pub reference: Option<Arc<Reference>>,
}

/// Letter of a view: A, B, C, … for 0, 1, 2, …
#[must_use]
pub fn label(view: usize) -> String {
    u8::try_from(view)
        .ok()
        .filter(|v| *v < 26)
        .map_or_else(|| view.to_string(), |v| char::from(b'A' + v).to_string())
}

/// Okabe and Ito's colours (2008), which are distinguishable with colour-vision deficiencies and have
/// contrast on white and on black, with a grey in place of their black.
const COLOURS: [[u8; 3]; 8] = [
    [0x00, 0x72, 0xb2],
    [0xd5, 0x5e, 0x00],
    [0x00, 0x9e, 0x73],
    [0xcc, 0x79, 0xa7],
    [0xe6, 0x9f, 0x00],
    [0x56, 0xb4, 0xe9],
    [0xf0, 0xe4, 0x42],
    [0x99, 0x99, 0x99],
];

/// The colour of a view in plots, sRGB.
#[must_use]
pub fn view_colour(view: usize) -> [u8; 3] {
    COLOURS[view % COLOURS.len()]
}

impl Experiment {
    /// Region of the measurements, if it is not the whole image. A region outside the image, whose size may
    /// have changed, counts as none.
    #[must_use]
    pub fn region(&self) -> Option<Region> {
        let [x0, y0, x1, y1] = self.doc.compare.region?.map(|x| x as usize);
        let region = Region { x0, y0, x1, y1 };
        let film = &self.doc.film;
        (!region.clipped(film.width as usize, film.height as usize).is_empty()).then_some(region)
    }

    fn ranked_views(&self) -> Vec<RankedView<'_>> {
        let views = self.views.iter().map(|(_, v)| v);
        views.map(|v| RankedView { label: &v.label, doc: &v.doc, snapshot: &v.snapshot }).collect()
    }

    fn question(&self, measures: Vec<&'static Measure>) -> Question<'_> {
        let place = |number: usize| self.views.iter().position(|(n, _)| *n == number);
        let reference_view = match self.doc.compare.reference {
            ReferenceDoc::View { view } => place(view),
            _ => None,
        };
        Question {
            reference: self.reference.as_deref(),
            reference_view,
            baseline: place(self.doc.compare.baseline).unwrap_or(usize::MAX),
            region: self.region(),
            measures,
        }
    }

    /// Ranks the views.
    #[must_use]
    pub fn rank(&self, measures: Vec<&'static Measure>) -> Vec<Standing> {
        self.rank_against(measures, &self.comparisons())
    }

    /// Whether errors are measured: against a reference, or against the mean of the other unbiased views if
    /// that was chosen. Without either, only variances and verdicts are available.
    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.reference.is_some() || self.doc.compare.reference == ReferenceDoc::Pooled
    }

    /// Ranks the views with the result of [`Self::comparisons`], since pooling images is expensive.
    #[must_use]
    pub fn rank_against(
        &self,
        measures: Vec<&'static Measure>,
        comparisons: &[Comparison<'_>],
    ) -> Vec<Standing> {
        let measures = if self.has_errors() { measures } else { Vec::new() };
        ranking::rank(&self.ranked_views(), &self.question(measures), comparisons)
    }

    /// Comparison image of every view, in the order of `views`.
    #[must_use]
    pub fn comparisons(&self) -> Vec<Comparison<'_>> {
        ranking::comparisons(&self.ranked_views(), &self.question(Vec::new()))
    }

    /// Comparison image of a view, by index: the reference, or the mean of the other unbiased views.
    #[must_use]
    pub fn compared_with(&self, view: usize) -> (ComparedWith, Option<Cow<'_, Reference>>) {
        let place = self.views.iter().position(|(n, _)| *n == view).unwrap_or(usize::MAX);
        ranking::comparison(&self.ranked_views(), place, &self.question(Vec::new()))
    }

    /// Image against which the errors of a view are measured, by index: [`Self::compared_with`] if its noise
    /// is low enough ([`ranking::can_measure`]); `None` without a reference.
    #[must_use]
    pub fn measured_against(&self, view: usize) -> Option<Cow<'_, Reference>> {
        let found = self.views.iter().find(|(n, _)| *n == view).map(|(_, v)| v)?;
        let comparison = self.compared_with(view);
        let usable = self.has_errors() && ranking::can_measure(&found.snapshot, &comparison, self.region());
        comparison.1.filter(|_| usable)
    }

    /// Error curve of a view against the reference; empty without one.
    #[must_use]
    pub fn curve(&self, view: usize, measure: &Measure) -> Vec<Point> {
        let found = self.views.iter().find(|(n, _)| *n == view).map(|(_, v)| v);
        let (Some(found), Some(held)) = (found, self.measured_against(view)) else { return Vec::new() };
        let kept = found.checkpoints.kept();
        kept.iter().filter_map(|c| c.point(measure, &held, self.region())).collect()
    }
}
