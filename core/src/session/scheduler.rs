//! Scheduler that keeps the contenders equal in the quantity selected by [`Fairness`].
//!
//! The contender with the least of this quantity gets the next pass, limited to the samples that bring it
//! level with the contender that has the most. A new or edited view therefore catches up before the others
//! continue, so that images side by side have the same cost. Only path tracing is charged; film merging,
//! images and statistics are not.

use super::Role;
use super::active::Active;
use crate::scene::Fairness;
use std::collections::BTreeMap;

/// Amount that a contender has received so far, in the unit of the fairness.
fn had(view: &Active, fairness: Fairness) -> f64 {
    match fairness {
        Fairness::Time => view.cpu_seconds,
        Fairness::Samples => view.spp as f64,
        // A path counts as one look-up at least: a view that never hits the medium must not get every pass.
        Fairness::Lookups => view.tally.lookups.max(view.tally.paths) as f64,
    }
}

/// Scheduler state: fairness, and the balance between background and contenders.
#[derive(Debug, Default)]
pub(super) struct Scheduler {
    pub fairness: Fairness,
    /// Mean CPU seconds per contender, minus those of the background.
    background_lag: f64,
}

/// Bound on the accumulated difference, however long there was no background work.
const MAX_LAG_SECONDS: f64 = 1.0;

impl Scheduler {
    /// Returns the view that gets the next pass, and the maximum number of samples per pixel that it may
    /// take.
    pub fn next<K: Copy + Ord>(&self, views: &BTreeMap<K, Active>) -> Option<(K, u64)> {
        let runnable = || views.iter().filter(|(_, v)| v.runnable());
        let background = runnable().find(|(_, v)| v.role == Role::Background);
        let view_overrides = runnable()
            .filter(|(_, v)| v.role == Role::View)
            .min_by(|(_, a), (_, b)| had(a, self.fairness).total_cmp(&had(b, self.fairness)));
        match (view_overrides, background) {
            (None, None) => None,
            (None, Some((id, _))) => Some((*id, u64::MAX)),
            (Some(_), Some((id, _))) if self.background_lag > 0.0 => Some((*id, u64::MAX)),
            (Some((id, view)), _) => {
                let ahead = runnable()
                    .filter(|(_, v)| v.role == Role::View)
                    .map(|(_, v)| had(v, self.fairness))
                    .fold(0.0, f64::max);
                Some((*id, self.samples_to(view, ahead)))
            }
        }
    }

    /// Samples per pixel that bring a view level with `ahead`; unbounded if it already is.
    fn samples_to(&self, view: &Active, ahead: f64) -> u64 {
        let mine = had(view, self.fairness);
        if ahead <= mine {
            return u64::MAX;
        }
        if view.spp == 0 {
            return 1;
        }
        let per_sample = mine / view.spp as f64;
        ((ahead - mine) / per_sample).round().max(1.0) as u64
    }

    /// Records the cost of a pass; `contenders` is the number that can run.
    pub fn note(&mut self, role: Role, cpu_seconds: f64, contenders: usize) {
        match role {
            Role::View => self.background_lag += cpu_seconds / contenders.max(1) as f64,
            Role::Background => self.background_lag -= cpu_seconds,
        }
        self.background_lag = self.background_lag.clamp(-MAX_LAG_SECONDS, MAX_LAG_SECONDS);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimator::{Settings, find};
    use crate::io::Library;
    use crate::scene::{Limits, SceneDoc, build};
    use crate::session::Probe;
    use std::sync::Arc;
    use std::sync::atomic::AtomicU64;

    fn view(role: Role) -> Active {
        let mut doc = SceneDoc::default();
        (doc.film.width, doc.film.height) = (1, 1);
        let scene = Arc::new(build(&doc, &mut Library::default()).unwrap());
        let kernel = find("nee").unwrap().kernel;
        let probe = Probe::new(scene, kernel, Settings::new(&doc.estimator, 0));
        let pool = Arc::new(rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap());
        let mut view = Active::new((1, Arc::new(AtomicU64::new(1))), probe, pool, Limits::default());
        view.role = role;
        view
    }

    /// Seconds and look-ups per sample of each view.
    const COSTS: [(f64, u64); 3] = [(0.001, 10), (0.004, 5), (0.01, 300)];

    /// Runs passes of at most `fitting` samples with simulated costs.
    fn run(views: &mut BTreeMap<usize, Active>, scheduler: &mut Scheduler, passes: usize, fitting: u64) {
        for _ in 0..passes {
            let (id, most) = scheduler.next(views).unwrap();
            let contenders = views.values().filter(|v| v.runnable() && v.role == Role::View).count();
            let view = views.get_mut(&id).unwrap();
            let count = fitting.min(most);
            let (seconds, lookups) = COSTS[id % COSTS.len()];
            view.spp += count;
            view.cpu_seconds += seconds * count as f64;
            view.tally.lookups += lookups * count;
            scheduler.note(view.role, seconds * count as f64, contenders);
        }
    }

    fn spread(views: &BTreeMap<usize, Active>, fairness: Fairness) -> f64 {
        let all = || views.values().filter(|v| v.role == Role::View).map(|v| had(v, fairness));
        (all().fold(0.0, f64::max) - all().fold(f64::INFINITY, f64::min)) / all().fold(0.0, f64::max)
    }

    #[test]
    fn contenders_keep_level_in_what_the_comparison_is_fair_in() {
        for fairness in [Fairness::Time, Fairness::Samples, Fairness::Lookups] {
            let mut views: BTreeMap<usize, Active> = (0..3).map(|i| (i, view(Role::View))).collect();
            let mut scheduler = Scheduler { fairness, ..Scheduler::default() };
            run(&mut views, &mut scheduler, 600, 8);
            assert!(spread(&views, fairness) < 0.05, "{fairness:?}: {}", spread(&views, fairness));
            // The views differ in the other two quantities, since their costs differ.
            let other = if fairness == Fairness::Time { Fairness::Samples } else { Fairness::Time };
            assert!(spread(&views, other) > 0.3, "{fairness:?}");
        }
    }

    #[test]
    fn a_new_view_catches_up_before_the_others_continue() {
        let mut views: BTreeMap<usize, Active> = (0..2).map(|i| (i, view(Role::View))).collect();
        let mut scheduler = Scheduler { fairness: Fairness::Samples, ..Scheduler::default() };
        run(&mut views, &mut scheduler, 100, 8);
        let before: u64 = views.values().map(|v| v.spp).max().unwrap();
        views.insert(2, view(Role::View));
        while views[&2].spp < before {
            run(&mut views, &mut scheduler, 1, 8);
        }
        assert_eq!(
            views.values().map(|v| v.spp).max(),
            Some(before),
            "exactly level, and no view went beyond"
        );
    }

    #[test]
    fn the_background_gets_one_contenders_share_and_all_of_it_once_they_are_done() {
        let mut views: BTreeMap<usize, Active> = (0..2).map(|i| (i, view(Role::View))).collect();
        views.insert(2, view(Role::Background));
        let mut scheduler = Scheduler::default();
        run(&mut views, &mut scheduler, 3000, 8);
        let share = views[&2].cpu_seconds / views[&0].cpu_seconds;
        assert!((share - 1.0).abs() < 0.05, "{share}");
        for id in [0, 1] {
            views.get_mut(&id).unwrap().paused = true;
        }
        let before = views[&2].spp;
        run(&mut views, &mut scheduler, 10, 8);
        assert_eq!(views[&2].spp, before + 80);
    }
}
