//! Rows that cover every pair of values of all axes, and the triples that interact most.
//!
//! A target is a set of values of two or three axes. A row covers it if it has these values, its estimator uses the axes, none
//! of them is idle in the row (a heuristic among components where one component is carried, say), and its image is
//! declared unbiased with finite variance. Rows are found greedily, by fixed random numbers.
//!
//! A target is left out if every row is declared biased, of infinite variance or not valid that has it and defaults
//! elsewhere: by what the registry and the table of keys say, and by nothing here. A target whose values are idle together
//! in every scene (how a uniform medium is interpolated) is covered by a row that has them.

use super::axes::{AXES, AtWork, Row, axis};
use majorant_core::estimator::REGISTRY;
use majorant_core::math::Sampler;
use std::collections::{BTreeMap, BTreeSet};

/// Axes by number with their values by number.
pub type Target = Vec<(usize, usize)>;

/// Axes of which every triple is covered.
const INTERACTING: [&str; 5] = [
    "estimator.id",
    "estimator.distances",
    "medium.majorant.factor",
    "medium.majorant.when_exceeded",
    "density",
];

pub struct Array {
    pub rows: Vec<Row>,
    /// Targets that no row can have, with the rule that forbids them.
    pub forbidden: BTreeMap<Target, String>,
    /// Targets whose values change nothing together.
    pub idle: BTreeSet<Target>,
    pub targets: usize,
}

/// Every target that some estimator has axes for.
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
                // A further scene in which the target changes nothing says no more.
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
        // Triples first: they need the most rows.
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
            // Then value by value, as long as it gets better.
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
        array.leave_out_what_others_cover(&targets);
        array
    }

    /// Later rows may cover all that an earlier one was made for. The costly ones go first.
    fn leave_out_what_others_cover(&mut self, targets: &[Open]) {
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
        assert!(times.iter().all(|n| *n > 0), "a target is covered by no row");
        let mut kept = kept.into_iter();
        self.rows.retain(|_| kept.next().unwrap());
    }
}

/// A target that is to be covered.
#[derive(Clone)]
struct Open {
    target: Target,
    /// Whether its values change nothing together.
    idle: bool,
    /// A row that has it.
    row: Row,
}

impl Open {
    fn is_covered_by(&self, row: &AtWork) -> bool {
        row.covers(&self.target, self.idle)
    }
}

/// A row that may be chosen.
struct Candidate {
    gain: f64,
    row: Row,
}

impl Candidate {
    /// Takes another row if it covers more for what it costs, `target` among it, and no rule forbids it.
    fn improve(&mut self, row: Row, target: &Open, open: &[Open]) {
        let at_work = row.at_work();
        if !target.is_covered_by(&at_work) {
            return;
        }
        let covered = open.iter().filter(|open| open.is_covered_by(&at_work)).count();
        // As many targets as can be had for the paths that the row will take.
        let gain = covered as f64 / row.cost().powf(0.7);
        if gain > self.gain && row.rule_against().is_none() {
            *self = Self { gain, row };
        }
    }
}

/// A target in words.
pub fn words(target: &Target) -> String {
    let parts: Vec<_> = target
        .iter()
        .map(|(axis, value)| format!("{} = {}", AXES[*axis].key, AXES[*axis].words(*value)))
        .collect();
    parts.join(", ")
}
