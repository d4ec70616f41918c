//! Ranking table of the page, and its summary.

use crate::compare::report::gather::Gathered;
use crate::compare::report::{plot, words};
use crate::compare::{Standing, Verdict};
use serde::Serialize;

/// A line of the ranking.
#[derive(Serialize)]
pub(super) struct Line {
    label: String,
    name: String,
    estimator: String,
    colour: String,
    spp: u64,
    seconds: String,
    lookups: String,
    relmse: String,
    measure: String,
    variance: String,
    chroma: String,
    efficiency: String,
    speedup: String,
    interval: Option<String>,
    verdict: String,
    /// `agrees`, `biased` or `undecided`.
    kind: String,
}

/// Lines sorted by efficiency in descending order, with biased views last.
pub(super) fn ranking(gathered: &Gathered<'_>) -> Vec<Line> {
    let mut order: Vec<(usize, &Standing)> = gathered.standings.iter().enumerate().collect();
    order.sort_by(|(_, a), (_, b)| {
        let biased = |s: &Standing| s.verdict() == Verdict::Differs;
        biased(a).cmp(&biased(b)).then(b.efficiency.total_cmp(&a.efficiency))
    });
    order
        .into_iter()
        .map(|(place, s)| Line {
            label: s.label.clone(),
            name: s.name.clone(),
            estimator: s.estimator.clone(),
            colour: plot::css_colour(place),
            spp: s.spp,
            seconds: words::number(s.cpu_seconds),
            lookups: words::number(s.lookups_per_path),
            relmse: error(s, "relmse"),
            measure: error(s, gathered.measure.id),
            variance: words::number(s.variance),
            chroma: words::percent(s.chroma_variance / s.variance),
            efficiency: words::number(s.efficiency),
            speedup: words::speedup(s),
            interval: words::interval(s),
            verdict: words::verdict(s),
            kind: s.verdict().to_string(),
        })
        .collect()
}

fn error(standing: &Standing, id: &str) -> String {
    standing.error(id).map_or_else(|| "–".into(), |m| words::quantity(m.corrected(), m.uncertainty()))
}

/// Summary in one or two sentences.
pub(super) fn summary(standings: &[Standing]) -> String {
    let those = |verdict: Verdict| standings.iter().filter(move |s| s.verdict() == verdict);
    let labels = |verdict| those(verdict).map(|s| s.label.as_str()).collect::<Vec<_>>().join(", ");
    // An undecided view may have missed its brightest paths, and with them most of its variance.
    let mut sure: Vec<&Standing> = those(Verdict::Agrees).collect();
    sure.sort_by(|a, b| b.efficiency.total_cmp(&a.efficiency));
    let mut sentences = Vec::new();
    match sure[..] {
        [best, next, ..] => sentences.push(format!(
            "{} (view {}) is the most efficient, {} times as efficient as the next, {} ({}).",
            best.name,
            best.label,
            words::times(best.efficiency / next.efficiency),
            next.name,
            next.label
        )),
        [only] => sentences.push(format!("Only {} (view {}) is known to agree.", only.name, only.label)),
        [] => {}
    }
    for (verdict, text) in
        [(Verdict::Undecided, "Undecided:"), (Verdict::Differs, "Biased, and therefore ranked last:")]
    {
        let labels = labels(verdict);
        if !labels.is_empty() {
            sentences.push(format!("{text} {labels}."));
        }
    }
    sentences.join(" ")
}
