//! Measurements of a panel.

use super::render::Rendered;
use crate::compare::{self, Standing, report};
use serde::Serialize;

/// Measurements of a panel: a row of the ranking with additional fields. Every field is a key of the JSON
/// output; non-finite values are null.
#[derive(Clone, Debug, Serialize)]
pub struct PanelNumbers {
    /// Row of the figure.
    pub strip: &'static str,
    /// Label above the image.
    pub panel: &'static str,
    /// Settings that differ from those of the figure.
    pub set: &'static [&'static str],
    /// Cost, noise, error and verdict.
    #[serde(flatten)]
    pub row: report::Row,
    /// Standard error of the relative mean squared error.
    pub relmse_error: f64,
    /// Root mean squared error, corrected for the noise of the reference.
    pub rmse: f64,
    /// Standard error of `rmse`.
    pub rmse_error: f64,
    /// Standard error of the variance.
    pub variance_error: f64,
    /// File of the tone-mapped image.
    pub png: String,
    /// File of the linear image, with standard errors and the scene that reproduces it.
    pub exr: String,
}

impl Rendered {
    /// Measurements of every panel.
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

    /// Name of the files of a panel, without extension.
    pub(super) fn file(&self, panel: usize) -> String {
        let letter = compare::label(panel).to_lowercase();
        let estimator = self.strip.panels.get(panel).map_or("", |p| p.estimator);
        format!("{}-{letter}-{estimator}", self.strip.name)
    }
}

/// An error, corrected for the noise of the reference, with its standard error.
fn measured(standing: &Standing, id: &str) -> (f64, f64) {
    standing.error(id).map_or((f64::NAN, f64::NAN), |m| (m.corrected(), m.error))
}
