//! Rows that cover every pair of values of all axes, and the triples that interact most.
//!
//! A target is a set of values of two or three axes. A row covers it if it has these values, its estimator uses the axes, none
//! of them is idle in the row (a heuristic among components where one component is carried, say), and its image is
//! declared unbiased with finite variance. Rows are found greedily, by fixed random numbers. A target that no row can have is
//! left out with the rule that forbids it.

use super::axes::{AXES, Row};
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
    let three: Vec<usize> = INTERACTING.map(|key| AXES.iter().position(|a| a.key == key).unwrap()).to_vec();
    for (x, a) in three.iter().enumerate() {
        for (y, b) in three.iter().enumerate().skip(x + 1) {
            for c in three.iter().skip(y + 1) {
                for i in 0..AXES[*a].values.len() {
                    for j in 0..AXES[*b].values.len() {
                        for k in 0..AXES[*c].values.len() {
                            let mut target = vec![(*a, i), (*b, j), (*c, k)];
                            target.sort_unstable();
                            targets.insert(target);
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
        let mut open = targets();
        let count = open.len();
        let mut array = Self { rows: Vec::new(), forbidden: BTreeMap::new(), targets: count };
        let mut random = Sampler::new(2026, 0, 0);
        while let Some(target) = open.iter().next_back().cloned() {
            let mut best: Option<(f64, Row, Vec<Target>)> = None;
            let mut forbidden = None;
            let mut found = 0;
            for attempt in 0..400 {
                let Some(row) = Row::random(&target, &mut random) else { continue };
                match row.rule_against() {
                    Some(rule) => {
                        forbidden = Some(rule);
                        continue;
                    }
                    None if !row.at_work().covers(&target) => continue,
                    None => {}
                }
                let at_work = row.at_work();
                let covered: Vec<_> = open.iter().filter(|t| at_work.covers(t)).cloned().collect();
                // As many targets as can be had for the paths that the row will take.
                let gain = covered.len() as f64 / row.cost();
                if best.as_ref().is_none_or(|(most, ..)| gain > *most) {
                    best = Some((gain, row, covered));
                }
                found += 1;
                if found == 40 || (found > 0 && attempt > 100) {
                    break;
                }
            }
            if let Some((_, row, covered)) = best {
                for target in covered {
                    open.remove(&target);
                }
                array.rows.push(row);
            } else {
                open.remove(&target);
                array.forbidden.insert(target, forbidden.unwrap_or_default());
            }
        }
        array
    }
}

/// A target in words.
pub fn words(target: &Target) -> String {
    let parts: Vec<_> = target
        .iter()
        .map(|(axis, value)| format!("{} = {}", AXES[*axis].key, AXES[*axis].values[*value]))
        .collect();
    parts.join(", ")
}
