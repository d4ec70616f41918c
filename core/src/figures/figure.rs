//! Definition of a figure: strips, panels and layout.

use super::options::Stage;

/// Settings that all panels of the report share and that differ from this program's scenes: analogue
/// absorption, uniform hero wavelengths, and one majorant for the whole medium.
pub(super) const REPORT: &[&str] =
    &["estimator.absorption=analogue", "estimator.wavelengths=uniform", "medium.majorant.resolution=1"];

/// A figure of the report.
#[derive(Clone, Copy, Debug)]
pub struct Figure {
    /// Number in the report.
    pub id: &'static str,
    /// Subject in a few words.
    pub title: &'static str,
    /// Description of the result.
    pub shows: &'static str,
    /// Rows, from the top.
    pub strips: &'static [Strip],
}

/// A row of images of one scene.
#[derive(Clone, Copy, Debug)]
pub struct Strip {
    /// Name in files and tables.
    pub name: &'static str,
    /// Name of the embedded scene.
    pub scene: &'static str,
    /// Description of the scene in a few words.
    pub about: &'static str,
    /// Kind of volume in the scene, if the user's own can replace it.
    pub stage: Option<Stage>,
    /// Default columns and rows of every image, in the aspect ratio of the scene and small enough that all
    /// figures and the study take minutes.
    pub size: [u32; 2],
    /// Panels, rendered with few samples and measured.
    pub panels: &'static [Panel],
    /// Reference for the panels, rendered with many samples.
    pub reference: Panel,
    /// Cells in display order, from the left.
    pub cells: &'static [Cell],
}

/// One image.
#[derive(Clone, Copy, Debug)]
pub struct Panel {
    /// Label above the image.
    pub label: &'static str,
    /// Estimator id.
    pub estimator: &'static str,
    /// Settings that differ from those of the report; for a reference, from those of the scene.
    pub set: &'static [&'static str],
}

/// A position in the layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cell {
    /// A panel, by index from 0.
    Panel(usize),
    /// The reference.
    Reference,
}
