//! What is told of a panel.

use super::render::Rendered;
use crate::compare::{self, Standing, report};
use serde::Serialize;

/// A panel's numbers: the line of a comparison's table, and what a figure adds to it. As JSON every field is a key;
/// what is not finite is null.
#[derive(Clone, Debug, Serialize)]
pub struct PanelNumbers {
    /// The row of the figure.
    pub strip: &'static str,
    /// What stands above the picture.
    pub panel: &'static str,
    /// Settings that make it differ from the figure's others.
    pub set: &'static [&'static str],
    /// Cost, noise, error, verdict.
    #[serde(flatten)]
    pub row: report::Row,
    /// Standard error of the relative mean squared error.
    pub relmse_error: f64,
    /// Root mean squared error, without what the reference's noise adds to it.
    pub rmse: f64,
    /// Its standard error.
    pub rmse_error: f64,
    /// Standard error of the variance.
    pub variance_error: f64,
    /// Its picture as shown.
    pub png: String,
    /// Its picture in linear radiance, with standard errors and the scene that repeats it.
    pub exr: String,
}

impl Rendered {
    /// The numbers of every panel.
    #[must_use]
    pub fn numbers(&self) -> Vec<PanelNumbers> {
        let rows = report::of_standings(&self.experiment, &self.standings);
        let panels = self.strip.panels.iter().zip(&self.standings).zip(rows);
        panels
            .enumerate()
            .map(|(i, ((panel, standing), row))| {
                let (_, relmse_error) = measured(standing, "relmse");
                let (rmse, rmse_error) = measured(standing, "rmse");
                PanelNumbers {
                    strip: self.strip.name,
                    panel: panel.label,
                    set: panel.set,
                    row,
                    relmse_error,
                    rmse,
                    rmse_error,
                    variance_error: standing.variance_error,
                    png: format!("{}.png", self.file(i)),
                    exr: format!("{}.exr", self.file(i)),
                }
            })
            .collect()
    }

    /// The name of a panel's files, without their ending.
    pub(super) fn file(&self, panel: usize) -> String {
        let letter = compare::label(panel).to_lowercase();
        let estimator = self.strip.panels.get(panel).map_or("", |p| p.estimator);
        format!("{}-{letter}-{estimator}", self.strip.name)
    }
}

/// A measure with its standard error, without what the reference adds.
fn measured(standing: &Standing, id: &str) -> (f64, f64) {
    standing.error(id).map_or((f64::NAN, f64::NAN), |m| (m.corrected(), m.error))
}
