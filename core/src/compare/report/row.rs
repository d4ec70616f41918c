//! A line of the table as data: what scripts read.

use super::words;
use crate::compare::{Experiment, Standing};
use crate::measure::{self, Measured};
use crate::scene::Mode;
use serde::Serialize;

/// One view's numbers. What is not finite is written as null.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The estimator's id.
    pub estimator: String,
    /// A, B, C, …
    pub label: String,
    /// Samples per pixel.
    pub spp: u64,
    /// CPU seconds of path tracing, all workers together.
    pub seconds: f64,
    /// Seconds of rendering.
    pub wall_seconds: f64,
    /// Look-ups of the medium.
    pub lookups: u64,
    /// Look-ups per path.
    pub lookups_per_path: f64,
    /// Relative mean squared error, without what the reference's noise adds to it.
    pub relmse: Option<f64>,
    /// Variance of a pixel's mean, over pixels and channels.
    pub variance: f64,
    /// The part of it that is colour noise.
    pub chroma_variance: f64,
    /// 1 / (variance · CPU seconds).
    pub efficiency: f64,
    /// Efficiency over that of the baseline.
    pub speedup: f64,
    /// Its 95 % interval.
    pub speedup_ci: [f64; 2],
    /// z of the difference of the means over the region.
    pub bias_z: Option<f64>,
    /// The probability that chance alone makes some part of the picture differ as much.
    pub p: Option<f64>,
    /// `agrees`, `biased` or `undecided`.
    pub verdict: String,
    /// What it was held against, in words.
    pub against: String,
    /// Why it is biased by a choice of its document, if it is.
    pub declared_bias: Option<&'static str>,
    /// Selects its random numbers.
    pub seed: u64,
    /// What a path's components stand for.
    pub mode: Mode,
    /// Pixels without a finite value.
    pub excluded: u64,
}

/// The lines of a comparison's table, in the order of the views.
#[must_use]
pub fn rows(experiment: &Experiment) -> Vec<Row> {
    let standings = experiment.rank(measure::find("relmse").into_iter().collect());
    of_standings(experiment, &standings)
}

/// The lines of a table that was computed already.
pub(crate) fn of_standings(experiment: &Experiment, standings: &[Standing]) -> Vec<Row> {
    let row = |s: &Standing| {
        let doc = &experiment.views.iter().find(|(_, v)| v.label == s.label)?.1.doc;
        Some(Row {
            estimator: s.estimator.clone(),
            label: s.label.clone(),
            spp: s.spp,
            seconds: s.cpu_seconds,
            wall_seconds: s.seconds,
            lookups: s.lookups,
            lookups_per_path: s.lookups_per_path,
            relmse: s.error("relmse").map(Measured::corrected),
            variance: s.variance,
            chroma_variance: s.chroma_variance,
            efficiency: s.efficiency,
            speedup: s.speedup,
            speedup_ci: s.speedup_interval,
            bias_z: s.agreement.map(|a| a.z),
            p: s.agreement.map(|a| a.p),
            verdict: s.verdict().to_string(),
            against: words::against(&s.against),
            declared_bias: s.declared_bias,
            seed: doc.render.seed,
            mode: doc.estimator.mode,
            excluded: s.excluded,
        })
    };
    standings.iter().filter_map(row).collect()
}
