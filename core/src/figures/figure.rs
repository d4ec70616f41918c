//! What a figure is made of.

use super::options::Stage;

/// What all panels of the report have in common, and this program's scenes do not: absorption is an event, the
/// hero's wavelength is uniform, one majorant bounds the whole medium.
pub(super) const REPORT: &[&str] =
    &["estimator.absorption=analogue", "estimator.wavelengths=uniform", "medium.majorant.resolution=1"];

/// A figure of the report.
#[derive(Clone, Copy, Debug)]
pub struct Figure {
    /// Its number there.
    pub id: &'static str,
    /// What it is about, in a few words.
    pub title: &'static str,
    /// What to see in it.
    pub shows: &'static str,
    /// Its rows, from the top.
    pub strips: &'static [Strip],
}

/// A row of pictures of one scene.
#[derive(Clone, Copy, Debug)]
pub struct Strip {
    /// How it is called in files and tables.
    pub name: &'static str,
    /// The embedded scene.
    pub scene: &'static str,
    /// The scene in a few words.
    pub about: &'static str,
    /// Whose volume stands in it, where a person's own can take its place.
    pub stage: Option<Stage>,
    /// Columns and rows of every picture, unless another size is asked for: in the proportion of the scene, small
    /// enough that all figures and the study take minutes.
    pub size: [u32; 2],
    /// What is rendered with few samples and has numbers.
    pub panels: &'static [Panel],
    /// What they are held against, rendered with many samples.
    pub reference: Panel,
    /// What is shown, from the left.
    pub cells: &'static [Cell],
}

/// One picture.
#[derive(Clone, Copy, Debug)]
pub struct Panel {
    /// What stands above it.
    pub label: &'static str,
    /// The estimator's id.
    pub estimator: &'static str,
    /// Settings that differ from the report's; for a reference from the scene's.
    pub set: &'static [&'static str],
}

/// A place in the layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cell {
    /// A panel, by its number from 0.
    Panel(usize),
    /// The reference.
    Reference,
}
