//! Who is next: contenders keep level, by what the comparison is fair in.
//!
//! The contender that has had least gets the next pass, and no more of it than brings it level with the
//! one ahead. A newcomer, or one that was edited, therefore catches up before the others go on: pictures side
//! by side have cost the same. Only path tracing counts; films, pictures and statistics are on the house.

use super::Role;
use super::active::Active;
use crate::scene::Fairness;
use std::collections::BTreeMap;

/// What a contender has had so far, in the unit that the comparison is fair in.
fn had(view: &Active, fairness: Fairness) -> f64 {
    match fairness {
        Fairness::Time => view.cpu_seconds,
        Fairness::Samples => f64::from(view.spp),
        Fairness::Lookups => view.tally.lookups as f64,
    }
}

/// Keeps the time of what is rendered in the background level with that of the contenders.
#[derive(Debug, Default)]
pub(super) struct Turns {
    pub fairness: Fairness,
    /// CPU seconds that a contender has had on average, less those of the background.
    owed: f64,
}

/// Background work is not owed more than this, however long there was none of it.
const LONGEST_DEBT_SECONDS: f64 = 1.0;

impl Turns {
    /// The next view to get a pass, with the most samples per pixel that it may take.
    pub fn next<K: Copy + Ord>(&self, views: &BTreeMap<K, Active>) -> Option<(K, u32)> {
        let runnable = || views.iter().filter(|(_, v)| v.runnable());
        let background = runnable().find(|(_, v)| v.role == Role::Background);
        let contender = runnable()
            .filter(|(_, v)| v.role == Role::Contender)
            .min_by(|(_, a), (_, b)| had(a, self.fairness).total_cmp(&had(b, self.fairness)));
        match (contender, background) {
            (None, None) => None,
            (None, Some((id, _))) => Some((*id, u32::MAX)),
            (Some(_), Some((id, _))) if self.owed > 0.0 => Some((*id, u32::MAX)),
            (Some((id, view)), _) => {
                let ahead = runnable()
                    .filter(|(_, v)| v.role == Role::Contender)
                    .map(|(_, v)| had(v, self.fairness))
                    .fold(0.0, f64::max);
                Some((*id, self.samples_to(view, ahead)))
            }
        }
    }

    /// Samples per pixel that bring a view level with what the one ahead has had; no bound if none is ahead.
    fn samples_to(&self, view: &Active, ahead: f64) -> u32 {
        let mine = had(view, self.fairness);
        if ahead <= mine {
            return u32::MAX;
        }
        if view.spp == 0 {
            return 1;
        }
        let per_sample = mine / f64::from(view.spp);
        ((ahead - mine) / per_sample).round().clamp(1.0, f64::from(u32::MAX)) as u32
    }

    /// Takes note of what a pass has cost; `contenders` are those that can run.
    pub fn note(&mut self, role: Role, cpu_seconds: f64, contenders: usize) {
        match role {
            Role::Contender => self.owed += cpu_seconds / contenders.max(1) as f64,
            Role::Background => self.owed -= cpu_seconds,
        }
        self.owed = self.owed.clamp(-LONGEST_DEBT_SECONDS, LONGEST_DEBT_SECONDS);
    }
}
