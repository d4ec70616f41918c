//! Covering array of the settings: every pair of values of all axes, and every triple of the most strongly
//! interacting axes.
//!
//! A target is a set of values of two or three axes. A row covers a target if it has these values, its
//! estimator uses the axes, none of the values is idle in the row (such as a heuristic among components where
//! one component is carried), and its image is declared unbiased with finite variance. Rows are found by a
//! greedy search with fixed random numbers.
//!
//! A target is left out if every row with its values and defaults elsewhere is declared biased, of infinite
//! variance or invalid. These declarations come from the registry and the table of keys only. A target whose
//! values are idle together in every scene (such as the interpolation of a uniform medium) is covered by any
//! row that has them.

use super::axes::{AXES, AtWork, Row, axis};
use majorant_core::estimator::REGISTRY;
use majorant_core::math::Sampler;
use std::collections::{BTreeMap, BTreeSet};

/// Indices of axes, each with the index of its value.
pub type Target = Vec<(usize, usize)>;

/// Axes for which every triple of values is covered.
const INTERACTING: [&str; 5] = [
    "estimator.id",
    "estimator.distances",
    "medium.majorant.factor",
    "medium.majorant.when_exceeded",
    "density",
];

pub struct Array {
    pub rows: Vec<Row>,
    /// Targets that no valid, unbiased row has, with the rule that forbids them.
    pub forbidden: BTreeMap<Target, String>,
    /// Targets whose values have no joint effect in any scene.
    pub idle: BTreeSet<Target>,
    pub targets: usize,
}

/// Targets whose axes are all used by at least one estimator.
fn targets() -> BTreeSet<Target> {
    let mut targets = BTreeSet::new();
    let usable = |target: &Target| {
        REGISTRY.iter().any(|entry| {
            target.iter().all(|(axis, value)| AXES[*axis].used_by(entry) && AXES[*axis].admits(*value, entry))
        })
    };
    for a in 0..AXES.len() {
        for b in a + 1..AXES.len() {
            for i in 0..AXES[a].values.len() {
                for j in 0..AXES[b].values.len() {
                    targets.insert(vec![(a, i), (b, j)]);
                }
            }
        }
    }
    let mut three = INTERACTING.map(axis);
    three.sort_unstable();
    for (x, a) in three.iter().enumerate() {
        for (y, b) in three.iter().enumerate().skip(x + 1) {
            for c in three.iter().skip(y + 1) {
                for i in 0..AXES[*a].values.len() {
                    for j in 0..AXES[*b].values.len() {
                        for k in 0..AXES[*c].values.len() {
                            targets.insert(vec![(*a, i), (*b, j), (*c, k)]);
                        }
                    }
                }
            }
        }
    }
    targets.retain(usable);
    targets
}

impl Array {
    pub fn generate() -> Self {
        let all = targets();
        let mut array =
            Self { rows: Vec::new(), forbidden: BTreeMap::new(), idle: BTreeSet::new(), targets: all.len() };
        let mut open = Vec::new();
        for target in all {
            let mut rule = None;
            let mut found: Option<(Row, bool)> = None;
            for row in Row::plainest(&target) {
                let works = row.at_work().covers(&target, false);
                // Another scene in which the target is idle adds no information.
                if found.is_some() && !works {
                    continue;
                }
                match row.rule_against() {
                    Some(against) => rule = Some(against),
                    None => found = Some((row, works)),
                }
                if matches!(found, Some((_, true))) {
                    break;
                }
            }
            match found {
                None => _ = array.forbidden.insert(target, rule.unwrap_or_default()),
                Some((row, works)) => {
                    if !works {
                        array.idle.insert(target.clone());
                    }
                    open.push(Open { target, idle: !works, row });
                }
            }
        }
        // Triples first, because they need the most rows.
        open.sort_by_key(|open| open.target.len());
        let targets = open.clone();
        let mut random = Sampler::new(2026, 0, 0);
        while let Some(next) = open.last().cloned() {
            let mut best = Candidate { gain: 0.0, row: next.row.clone() };
            best.improve(next.row.clone(), &next, &open);
            for _ in 0..100 {
                if let Some(row) = Row::random(&next.target, &mut random) {
                    best.improve(row, &next, &open);
                }
            }
            // Local search over single values while the gain increases.
            loop {
                let gain = best.gain;
                for row in best.row.neighbours() {
                    best.improve(row, &next, &open);
                }
                if best.gain <= gain {
                    break;
                }
            }
            let at_work = best.row.at_work();
            open.retain(|open| !open.is_covered_by(&at_work));
            array.rows.push(best.row);
        }
        array.remove_redundant_rows(&targets);
        array
    }

    /// Removes rows whose targets are all covered by other rows, the most expensive rows first.
    fn remove_redundant_rows(&mut self, targets: &[Open]) {
        let at_work: Vec<_> = self.rows.iter().map(Row::at_work).collect();
        let covered_by = |row: &AtWork| {
            let covered = targets.iter().enumerate().filter(|(_, target)| target.is_covered_by(row));
            covered.map(|(i, _)| i).collect::<Vec<_>>()
        };
        let covered: Vec<Vec<usize>> = at_work.iter().map(covered_by).collect();
        let mut times = vec![0u32; targets.len()];
        covered.iter().flatten().for_each(|i| times[*i] += 1);
        let mut order: Vec<usize> = (0..self.rows.len()).collect();
        order.sort_by(|a, b| self.rows[*b].cost().total_cmp(&self.rows[*a].cost()));
        let mut kept = vec![true; self.rows.len()];
        for row in order {
            if covered[row].iter().all(|i| times[*i] > 1) {
                covered[row].iter().for_each(|i| times[*i] -= 1);
                kept[row] = false;
            }
        }
        assert!(times.iter().all(|n| *n > 0), "a target is not covered by any row");
        let mut kept = kept.into_iter();
        self.rows.retain(|_| kept.next().unwrap());
    }
}

/// Target to be covered.
#[derive(Clone)]
struct Open {
    target: Target,
    /// Whether its values have no joint effect in any scene.
    idle: bool,
    /// Row with the values of the target and defaults elsewhere.
    row: Row,
}

impl Open {
    fn is_covered_by(&self, row: &AtWork) -> bool {
        row.covers(&self.target, self.idle)
    }
}

/// Candidate for the next row, with its gain.
struct Candidate {
    gain: f64,
    row: Row,
}

impl Candidate {
    /// Replaces the candidate by `row` if that covers `target`, has a higher gain, and is not forbidden.
    fn improve(&mut self, row: Row, target: &Open, open: &[Open]) {
        let at_work = row.at_work();
        if !target.is_covered_by(&at_work) {
            return;
        }
        let covered = open.iter().filter(|open| open.is_covered_by(&at_work)).count();
        // Number of covered targets relative to the paths that the row takes.
        let gain = covered as f64 / row.cost().powf(0.7);
        if gain > self.gain && row.rule_against().is_none() {
            *self = Self { gain, row };
        }
    }
}

/// Description of a target for messages.
pub fn words(target: &Target) -> String {
    let parts: Vec<_> = target
        .iter()
        .map(|(axis, value)| format!("{} = {}", AXES[*axis].key, AXES[*axis].words(*value)))
        .collect();
    parts.join(", ")
}
