//! Provenance of statistics: they are shown only with the images that they describe.
//!
//! Edits do not wait for a running analysis. Every number therefore carries the submissions, the reference,
//! the box and the baseline from which it was computed, and is hidden in the same frame in which one of these
//! changes.

use super::analysis::Analysis;
use super::reference::ReferenceId;
use crate::model::Pair;
use majorant_core::compare::{ComparedWith, Standing, label};

/// Identities of the inputs of an analysis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Provenance {
    /// Submission of each view; `None` while its image is one of an older submission.
    pub views: Vec<Option<u64>>,
    /// The reference of the errors.
    pub reference: ReferenceId,
    /// Box to which statistics are restricted.
    pub region: Option<[u32; 4]>,
    /// Baseline of the speed-ups.
    pub baseline: usize,
}

impl Provenance {
    /// Whether a view has the same submission in both.
    fn agree_on(&self, other: &Self, view: usize) -> bool {
        let of = |p: &Self| p.views.get(view).copied().flatten();
        of(self).is_some() && of(self) == of(other)
    }

    fn agree_on_label(&self, other: &Self, wanted: &str) -> bool {
        (0..self.views.len()).any(|view| label(view) == wanted && self.agree_on(other, view))
    }
}

impl Analysis {
    /// Returns the numbers that are valid for the provenance `now`.
    #[must_use]
    pub fn matching(&self, now: &Provenance) -> Self {
        let of = &self.of;
        let view = |view: usize| of.agree_on(now, view);
        let mut kept =
            Self { measure: self.measure, seconds: self.seconds, of: of.clone(), ..Self::default() };
        if let Some((at, samples)) = &self.pixel {
            kept.pixel = Some((*at, samples.iter().filter(|s| view(s.view)).cloned().collect()));
        }
        if of.region != now.region {
            return kept;
        }
        kept.standings = self
            .standings
            .iter()
            .filter(|s| of.agree_on_label(now, &s.label))
            .map(|s| standing(s, of, now))
            .collect();
        let measured = |view: usize| kept.standing(&label(view)).is_some_and(|s| !s.errors.is_empty());
        kept.curves = self.curves.iter().filter(|c| measured(c.view)).cloned().collect();
        kept.pair = self.pair.filter(|(Pair(a, b), _)| view(*a) && view(*b));
        kept
    }
}

/// Row of an unchanged view, without the numbers whose other inputs have changed.
fn standing(standing: &Standing, of: &Provenance, now: &Provenance) -> Standing {
    let mut standing = standing.clone();
    let stands = match &standing.against {
        ComparedWith::Reference(_) => of.reference == now.reference,
        ComparedWith::Others(labels) => {
            of.reference == now.reference && labels.split(", ").all(|label| of.agree_on_label(now, label))
        }
        ComparedWith::Nothing(_) => of.reference == now.reference,
    };
    if !stands {
        standing.errors.clear();
        standing.agreement = None;
        standing.against = ComparedWith::Nothing("the reference has changed");
    }
    if of.baseline != now.baseline || !of.agree_on(now, of.baseline) {
        (standing.speedup, standing.speedup_interval) = (f64::NAN, [f64::NAN; 2]);
    }
    standing
}

#[cfg(test)]
mod tests {
    use super::*;
    use majorant_core::compare::{Agreement, Verdict};
    use majorant_core::measure::{Measured, find};

    fn line(view: usize, against: ComparedWith) -> Standing {
        let measured = Measured { value: 1.0, error: 0.1, reference_share: 0.0, pixels: 4, excluded: 0 };
        let found = Agreement {
            verdict: Verdict::Agrees,
            difference: 0.0,
            error: 0.1,
            z: 0.0,
            p: 0.5,
            worst: None,
            excluded: 0,
        };
        Standing {
            label: label(view),
            estimator: "nee".into(),
            name: "NEE".into(),
            spp: 8,
            cpu_seconds: 1.0,
            seconds: 1.0,
            lookups: 1,
            lookups_per_path: 1.0,
            errors: find("relmse").map(|m| (m, measured)).into_iter().collect(),
            variance: 1.0,
            variance_error: 0.1,
            chroma_variance: 0.5,
            efficiency: 1.0,
            speedup: 1.0,
            speedup_interval: [0.9, 1.1],
            against,
            agreement: Some(found),
            declared_bias: None,
            evenly_spread: false,
            pixels: 4,
            excluded: 0,
        }
    }

    fn analysis(reference: ReferenceId, against: [ComparedWith; 3]) -> Analysis {
        let lines = against.into_iter().enumerate().map(|(view, against)| line(view, against));
        Analysis {
            of: Provenance { views: vec![Some(1), Some(2), Some(3)], reference, region: None, baseline: 0 },
            standings: lines.collect(),
            ..Analysis::default()
        }
    }

    /// Labels, whether errors and verdict are valid, and whether the speed-up is.
    fn kept(analysis: &Analysis, now: &Provenance) -> Vec<(String, bool, bool)> {
        let kept = analysis.matching(now).standings.into_iter().map(|s| {
            assert_eq!(s.errors.is_empty(), s.agreement.is_none());
            (s.label, s.agreement.is_some(), s.speedup.is_finite())
        });
        kept.collect()
    }

    #[test]
    fn a_number_goes_with_each_thing_that_it_depends_on() {
        let others = |labels: &str| ComparedWith::Others(labels.into());
        let pooled = analysis(ReferenceId::Pooled, [others("B, C"), others("A, C"), others("A")]);
        let line = |label: &str, held, speedup| (label.to_owned(), held, speedup);
        let same = pooled.of.clone();
        assert_eq!(
            kept(&pooled, &same),
            [line("A", true, true), line("B", true, true), line("C", true, true)]
        );
        // The third view was edited: its row and the comparisons with it are removed.
        let mut now = same.clone();
        now.views[2] = Some(4);
        assert_eq!(kept(&pooled, &now), [line("A", false, true), line("B", false, true)]);
        // It shows the image of the previous submission.
        now.views[2] = None;
        assert_eq!(kept(&pooled, &now), [line("A", false, true), line("B", false, true)]);
        // The baseline was edited.
        let mut now = same.clone();
        now.views[0] = Some(5);
        assert_eq!(kept(&pooled, &now), [line("B", false, false), line("C", false, false)]);
        // Two views were swapped, or only one remains.
        let mut now = same.clone();
        now.views.swap(0, 1);
        assert_eq!(kept(&pooled, &now), [line("C", false, false)]);
        now.views.truncate(1);
        assert_eq!(kept(&pooled, &now), []);
        // Another view is the baseline.
        let mut now = same.clone();
        now.baseline = 1;
        assert_eq!(kept(&pooled, &now)[2], line("C", true, false));
        // Another box.
        let mut now = same.clone();
        now.region = Some([0, 0, 1, 1]);
        assert_eq!(kept(&pooled, &now), []);
        // The reference was removed: so are the errors.
        let mut now = same;
        now.reference = ReferenceId::None;
        assert_eq!(kept(&pooled, &now)[0], line("A", false, true));
        // The reference was restarted.
        let reference = || ComparedWith::Reference("NEE, 8 spp".into());
        let held = analysis(ReferenceId::Submission(7), [reference(), reference(), reference()]);
        assert_eq!(kept(&held, &held.of)[1], line("B", true, true));
        let now = Provenance { reference: ReferenceId::Submission(9), ..held.of.clone() };
        assert_eq!(kept(&held, &now)[1], line("B", false, true));
    }
}
