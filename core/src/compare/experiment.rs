//! A comparison with everything that came of it so far: what rankings, maps and reports are made from.

use super::curve::{Checkpoints, Point};
use super::ranking::{self, Against, Contender, Opponent, Question, Standing};
use super::reference::Reference;
use crate::film::Snapshot;
use crate::measure::{Measure, Region};
use crate::scene::{ReferenceDoc, SceneDoc};
use std::borrow::Cow;
use std::sync::Arc;

/// One view with its newest picture.
#[derive(Clone, Debug)]
pub struct View {
    /// A, B, C, …
    pub label: String,
    /// What it renders, file names as the session got them.
    pub doc: Arc<SceneDoc>,
    /// Its newest picture.
    pub snapshot: Arc<Snapshot>,
    /// Earlier ones.
    pub checkpoints: Arc<Checkpoints>,
}

/// A comparison with everything that came of it so far.
#[derive(Clone, Debug)]
pub struct Experiment {
    /// The scene with its comparison.
    pub doc: Arc<SceneDoc>,
    /// Its views that have a picture, each with its number from 0.
    pub views: Vec<(usize, View)>,
    /// What errors are measured against, if there is a picture of it.
    pub reference: Option<Arc<Reference>>,
}

/// A, B, C, … for 0, 1, 2, …
#[must_use]
pub fn label(view: usize) -> String {
    u8::try_from(view)
        .ok()
        .filter(|v| *v < 26)
        .map_or_else(|| view.to_string(), |v| char::from(b'A' + v).to_string())
}

/// Okabe and Ito's colours (2008), which every eye tells apart and which stand out on white and on black, and a grey in place of their black.
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
    /// The region that numbers are about, if it is not the whole. One that lies beside the picture, whose size
    /// may have changed, is none.
    #[must_use]
    pub fn region(&self) -> Option<Region> {
        let [x0, y0, x1, y1] = self.doc.compare.region?.map(|x| x as usize);
        let region = Region { x0, y0, x1, y1 };
        let film = &self.doc.film;
        (!region.clipped(film.width as usize, film.height as usize).is_empty()).then_some(region)
    }

    fn contenders(&self) -> Vec<Contender<'_>> {
        let views = self.views.iter().map(|(_, v)| v);
        views.map(|v| Contender { label: &v.label, doc: &v.doc, snapshot: &v.snapshot }).collect()
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

    /// The table.
    #[must_use]
    pub fn rank(&self, measures: Vec<&'static Measure>) -> Vec<Standing> {
        self.rank_against(measures, &self.opponents())
    }

    /// Whether errors are measured: against a reference, or against the mean of the other unbiased views if that was
    /// chosen. Without either, variances and verdicts are all there is.
    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.reference.is_some() || self.doc.compare.reference == ReferenceDoc::Pooled
    }

    /// The table, with what [`Self::opponents`] has found: pooled pictures are dear.
    #[must_use]
    pub fn rank_against(&self, measures: Vec<&'static Measure>, opponents: &[Opponent<'_>]) -> Vec<Standing> {
        let measures = if self.has_errors() { measures } else { Vec::new() };
        ranking::rank(&self.contenders(), &self.question(measures), opponents)
    }

    /// What every view is held against, in the order of `views`.
    #[must_use]
    pub fn opponents(&self) -> Vec<Opponent<'_>> {
        ranking::opponents(&self.contenders(), &self.question(Vec::new()))
    }

    /// What a view is held against, by its number: the reference, or the mean of the other unbiased views.
    #[must_use]
    pub fn held_against(&self, view: usize) -> (Against, Option<Cow<'_, Reference>>) {
        let place = self.views.iter().position(|(n, _)| *n == view).unwrap_or(usize::MAX);
        ranking::opponent(&self.contenders(), place, &self.question(Vec::new()))
    }

    /// What the errors of a view are measured against, by its number: [`Self::held_against`] as far as it is known well
    /// enough for that ([`ranking::can_measure`]); none without a reference.
    #[must_use]
    pub fn measured_against(&self, view: usize) -> Option<Cow<'_, Reference>> {
        let found = self.views.iter().find(|(n, _)| *n == view).map(|(_, v)| v)?;
        let opponent = self.held_against(view);
        let usable = self.has_errors() && ranking::can_measure(&found.snapshot, &opponent, self.region());
        opponent.1.filter(|_| usable)
    }

    /// The error curve of a view against the reference; empty without one.
    #[must_use]
    pub fn curve(&self, view: usize, measure: &Measure) -> Vec<Point> {
        let found = self.views.iter().find(|(n, _)| *n == view).map(|(_, v)| v);
        let (Some(found), Some(held)) = (found, self.measured_against(view)) else { return Vec::new() };
        let kept = found.checkpoints.kept();
        kept.iter().filter_map(|c| c.point(measure, &held, self.region())).collect()
    }
}
