//! A line of the ranking as data for scripts.

use super::words;
use crate::compare::{Experiment, Standing};
use crate::measure::{self, Measured};
use crate::scene::Mode;
use serde::Serialize;

/// Statistics of one view. Non-finite values are written as null.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Estimator id.
    pub estimator: String,
    /// A, B, C, …
    pub label: String,
    /// Samples per pixel.
    pub spp: u64,
    /// CPU seconds of path tracing, summed over all worker threads.
    pub seconds: f64,
    /// Wall-clock seconds of rendering.
    pub wall_seconds: f64,
    /// Look-ups of the medium.
    pub lookups: u64,
    /// Look-ups per path.
    pub lookups_per_path: f64,
    /// Relative mean squared error, corrected for the noise of the reference.
    pub relmse: Option<f64>,
    /// Variance of the mean of a pixel, averaged over pixels and channels.
    pub variance: f64,
    /// Component of `variance` that is colour noise.
    pub chroma_variance: f64,
    /// 1 / (variance · CPU seconds).
    pub efficiency: f64,
    /// Efficiency relative to the baseline.
    pub speedup: f64,
    /// 95 % interval of `speedup`.
    pub speedup_ci: [f64; 2],
    /// z of the difference of the means over the region.
    pub bias_z: Option<f64>,
    /// Probability that some block of the image differs as much by chance.
    pub p: Option<f64>,
    /// `agrees`, `biased` or `undecided`.
    pub verdict: String,
    /// Display text for the image that it was compared with.
    pub against: String,
    /// Reason why a setting of its document biases it, if so.
    pub declared_bias: Option<&'static str>,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Spectral or RGB mode.
    pub mode: Mode,
    /// Pixels without a finite value.
    pub excluded: u64,
}

/// Lines of the ranking of a comparison, in the order of the views.
#[must_use]
pub fn rows(experiment: &Experiment) -> Vec<Row> {
    let standings = experiment.rank(measure::find("relmse").into_iter().collect());
    of_standings(experiment, &standings)
}

/// Converts existing standings to lines.
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
